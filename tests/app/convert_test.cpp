// ghostlight-cli convert: files, reports, refusals.

#include <filesystem>

#include "tests/app/program.h"
#include "tests/support/test_paths.h"

namespace ghostlight::test {
namespace {

std::string sample(const std::string& name) { return (test_data_folder() / name).string(); }

class Convert : public InTemporaryFolder {};

TEST_F(Convert, GoesThroughEveryFormatAndKeepsTheLens) {
    const double wanted = cli_csv({"info", tessar(), "--csv"}).number(0, "efl_mm");
    std::string from = tessar();
    for (const char* name : {"a.zmx", "b.seq", "c.json", "d.lens"}) {
        const std::string to = (folder / name).string();
        const Outcome outcome = cli({"convert", from, to});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const Outcome info = cli({"info", to, "--csv"});
        ASSERT_EQ(info.status, 0) << info.err;
        constexpr double rounding_mm = 1e-9;
        EXPECT_NEAR(parse_csv(info.out).number(0, "efl_mm"), wanted, rounding_mm) << name;
        from = to;
    }
}

TEST_F(Convert, ReportSaysWhatBecameOfEachThing) {
    const Csv report = cli_csv({"convert", sample("zmx/tricky.zmx"), "--report", "--csv"});
    const std::vector<std::string> columns = {
        "step", "where", "fate", "severity", "matters_for_flare", "text", "proposal"};
    EXPECT_EQ(report.columns, columns);
    const std::size_t glass = report.find("where", "line 18");
    EXPECT_EQ(report.text(glass, "severity"), "error");
    EXPECT_EQ(report.text(glass, "matters_for_flare"), "yes");
    EXPECT_NE(report.text(glass, "proposal"), "");
    const std::string readable = cli_output({"convert", sample("zmx/tricky.zmx"), "--report"});
    EXPECT_NE(readable.find("! line 18: "), std::string::npos) << readable;
    EXPECT_NE(readable.find("      -> name a glass"), std::string::npos) << readable;
    const std::string json =
        cli_output({"convert", sample("seq/triplet.seq"), "--report", "--json"});
    EXPECT_NE(json.find("\"format\": \"CODE V\""), std::string::npos) << json;
}

TEST_F(Convert, ExportReportNamesWhatIsLost) {
    const std::string to = (folder / "x.zmx").string();
    const Csv report = cli_csv({"convert", "tessar_brendel_100_f2.8", to, "--report", "--csv"});
    bool coating = false;
    for (std::size_t row = 0; row < report.rows.size(); ++row)
        coating = coating ||
                  (report.text(row, "step") == "export" && report.text(row, "fate") == "left out" &&
                   report.text(row, "matters_for_flare") == "yes" &&
                   report.text(row, "text").find("MgF2") != std::string::npos);
    EXPECT_TRUE(coating);
}

TEST_F(Convert, MendsWhatAReportProposes) {
    const std::string to = (folder / "x.json").string();
    EXPECT_EQ(cli({"convert", tessar(), to, "--scale", "10"}).status, 0);
    const double efl = cli_csv({"info", tessar(), "--csv"}).number(0, "efl_mm");
    EXPECT_NEAR(cli_csv({"info", to, "--csv"}).number(0, "efl_mm"), 10.0 * efl, 1e-9 * efl);
    EXPECT_EQ(cli({"convert", to, to, "--scale", "0.1", "--halve-semi-diameters"}).status, 0);
    const double f_number = cli_csv({"info", tessar(), "--csv"}).number(0, "f_number");
    EXPECT_NEAR(cli_csv({"info", to, "--csv"}).number(0, "f_number"), 2.0 * f_number, 1e-9);
}

TEST_F(Convert, RefusesInOneLine) {
    const std::string ghost = (folder / "ghost.zmx").string();
    ASSERT_EQ(cli({"convert", tessar(), ghost, "--ghost", "5-3"}).status, 0);
    const struct {
        std::vector<std::string> arguments;
        std::string words;
    } cases[] = {
        {{"convert", ghost, "--report"}, "mirror"},
        {{"convert", tessar()}, "--report alone"},
        {{"convert", tessar(), "x.docx"}, ".docx"},
        {{"convert", tessar(), "x.seq", "--ghost", "5-3"}, ".zmx"},
        {{"convert", tessar(), "x.zmx", "--ghost", "4-4"}, "--ghost"},
        {{"convert", tessar(), "x.zmx", "--scale", "-1"}, "--scale"},
        {{"convert", tessar(), "x.zmx", "--config", "tele"}, "--config"},
        {{"convert", "nothing.zmx", "--report"}, "no such lens file"},
    };
    for (const auto& each : cases) {
        const Outcome outcome =
            cli(each.arguments, {.input = {}, .environment = {}, .directory = folder});
        EXPECT_EQ(outcome.status, 2) << each.words;
        EXPECT_NE(outcome.err.find(each.words), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << "one line: " << outcome.err;
        EXPECT_EQ(outcome.out, "") << each.words;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "x.zmx")) << "nothing half written";
}

TEST(Unfinished, InfoShowsWhatThereIsAndOthersSayWhatToMend) {
    const std::string file = sample("zmx/unknown_glass.zmx");
    const Outcome info = cli({"info", file});
    EXPECT_EQ(info.status, 2);
    EXPECT_NE(info.out.find("Triplet with a glass that nobody knows"), std::string::npos);
    EXPECT_NE(info.out.find("! line 55"), std::string::npos) << info.out;
    for (const auto& command : {std::vector<std::string>{"info", file, "--json"},
                                {"ghosts", file, "--field", "5"},
                                {"render", file, "--field", "5", "-o", "never.exr"}}) {
        const Outcome outcome = cli(command);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(outcome.out, "");
        for (const char* word : {"unknown_glass.zmx", "line 55", "SF2X", "similar names: SF2"})
            EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace ghostlight::test
