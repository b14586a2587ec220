// accuracy and stability: what they write is whole, and says what it must.
#include <set>

#include "tests/app/program.h"

namespace ghostlight::test {
namespace {

class CommandLineAccuracy : public InTemporaryFolder {};

TEST_F(CommandLineAccuracy, WritesTidyTablesChartsAndPages) {
    const std::string out = (folder / "out").string();
    cli_output({"accuracy", tessar(), "--quick", "--field", "6", "--closed", "0,2", "--width", "48",
                "--budget", "0.5", "--out", out});
    const Csv points = read_csv(folder / "out" / "accuracy.csv");
    std::set<std::string> methods, closings;
    int planned = 0;
    for (std::size_t r = 0; r < points.rows.size(); ++r) {
        methods.insert(points.text(r, "method"));
        closings.insert(points.text(r, "closed_stops"));
        EXPECT_GE(points.number(r, "relative_l1"), 0.0);
        EXPECT_GT(points.number(r, "median_ms"), 0.0);
        // An error's three kinds are of one picture: light lost is never more than what differs.
        EXPECT_LE(std::abs(points.number(r, "energy")), points.number(r, "relative_l1") + 1e-6);
        const bool resolved =
            points.text(r, "shortcut") == "yes" ||
            points.number(r, "relative_l1") >= 3.0 * points.number(r, "reference_error");
        EXPECT_EQ(points.text(r, "resolved"), resolved ? "yes" : "no");
        planned += points.text(r, "method") == "planned" ? 1 : 0;
    }
    EXPECT_EQ(closings.size(), 2U);
    EXPECT_GE(planned, 2) << "the budget may cut off all but the first of each case";
    for (const char* method :
         {"paraxial", "uniform", "averaged polarisation", "reflections only", "single precision",
          "planned, hullin-2011 coating", "planned, all at full size", "planned, nothing left out",
          "planned, faint ghosts folded"})
        EXPECT_TRUE(methods.contains(method)) << method;
    EXPECT_GT(read_csv(folder / "out" / "ghosts.csv").rows.size(), 3U);
    const std::string page = read_file(folder / "out" / "accuracy.html");
    EXPECT_EQ(page.find("src=\"http"), std::string::npos) << "nothing from elsewhere";
    for (const char* words :
         {"<svg", "Error against run time", "ghostlight-cli accuracy", "--closed 0,2", "</html>"})
        EXPECT_NE(page.find(words), std::string::npos) << words;
    const std::string summary = read_file(folder / "out" / "accuracy.md");
    for (const char* words : {"# Accuracy", "## What to choose", "## Promised and achieved",
                              "## What the eye sees", "## What each economy is worth"})
        EXPECT_NE(summary.find(words), std::string::npos) << words;
    int charts = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out"))
        charts += entry.path().extension() == ".svg" ? 1 : 0;
    EXPECT_EQ(charts, 3) << "two cases, and asked against achieved";
}

TEST_F(CommandLineAccuracy, SaysWhatIsWrong) {
    const std::string out = (folder / "out").string();
    for (const auto& [option, value] : {std::pair{"--budget", "-1"}, std::pair{"--reference", "7"},
                                        std::pair{"--closed", "99"}}) {
        const Outcome outcome = cli({"accuracy", tessar(), "--out", out, option, value});
        EXPECT_EQ(outcome.status, 2) << option;
        EXPECT_NE(outcome.err.find(option), std::string::npos) << outcome.err;
    }
}

TEST_F(CommandLineAccuracy, StabilityListsEveryGhostThatPassesLight) {
    const std::string summary = (folder / "stability.md").string();
    const Csv rows = parse_csv(
        cli_output({"stability", tessar(), "--field", "0,12", "--markdown", summary, "--csv"}));
    ASSERT_GT(rows.rows.size(), 20U);
    for (std::size_t r = 0; r < rows.rows.size(); ++r) {
        EXPECT_GE(rows.number(r, "position_px"), rows.number(r, "position_rms_px"));
        EXPECT_GT(rows.number(r, "predicted_px"), 0.0);
        EXPECT_LE(rows.number(r, "averaging_error"), 1.0);
        EXPECT_EQ(rows.text(r, "ill_conditioned"), "no") << rows.text(r, "ghost");
    }
    EXPECT_NE(read_file(summary).find("## What averaging the polarisation costs"),
              std::string::npos);
}

}  // namespace
}  // namespace ghostlight::test
