// Where the answer goes, and what form its numbers have.

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"
#include "tests/support/test_paths.h"

namespace ghostlight::test {
namespace {

class CommandLineOutput : public InTemporaryFolder {
   protected:
    // Runs a shell command in which "$cli" is the program and "$lens" the Tessar.
    Outcome shell(const std::string& command) const {
        return run_program({"sh", "-c", command},
                           {.input = {},
                            .environment = {{"cli", cli_program()}, {"lens", tessar()}},
                            .directory = folder});
    }
};

TEST_F(CommandLineOutput, GoesToAFileOnRequest) {
    for (const char* form : {"", "--csv", "--json"}) {
        const Outcome outcome =
            shell(std::string("\"$cli\" info \"$lens\" --output out.txt ") + form);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        std::vector<std::string> arguments = {"info", tessar()};
        if (*form != '\0') arguments.emplace_back(form);
        EXPECT_EQ(read_file(folder / "out.txt"), cli_output(arguments));
    }
}

TEST_F(CommandLineOutput, FailsWhenItCannotBeWritten) {
    for (const char* command :
         {"\"$cli\" info \"$lens\" > /dev/full", "\"$cli\" info \"$lens\" --csv --output /dev/full",
          "\"$cli\" info \"$lens\" >&-",
          "\"$cli\" info \"$lens\" --output no/such/folder/out.txt"}) {
        const Outcome outcome = shell(command);
        EXPECT_EQ(outcome.status, 2) << command;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1)
            << command << outcome.err;
    }
}

TEST_F(CommandLineOutput, SurvivesAReaderThatStopsReading) {
    const Outcome outcome = shell(
        "{ \"$cli\" coating --stack '1 | 1.5' --wavelengths 400:700:0.1 --angles 0:90:1; "
        "echo $? > status; } | head -n 1 > first");
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(read_file(folder / "status"), "0\n");
    EXPECT_NE(read_file(folder / "first"), "");
}

TEST_F(CommandLineOutput, SurvivesWithoutStandardStreams) {
    EXPECT_EQ(shell("\"$cli\" info \"$lens\" 2>&-").status, 0);
    EXPECT_EQ(shell("\"$cli\" info no-such-lens 2>&-").status, 2);
    // Closed streams must not be replaced by the files of the run.
    EXPECT_EQ(shell("\"$cli\" info \"$lens\" --csv --output out.csv <&- >&- 2>&-").status, 0);
    EXPECT_EQ(read_file(folder / "out.csv"), cli_output({"info", tessar(), "--csv"}));
    EXPECT_EQ(shell("\"$cli\" trace \"$lens\" --ghost direct --field 0 --rays - <&-").status, 2);
}

TEST_F(CommandLineOutput, DoesNotDependOnTheLocale) {
    const std::vector<std::string> arguments = {"info", tessar()};
    const std::string expected = cli_output(arguments);
    // Whatever of these the machine has.
    for (const char* locale : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "C.UTF-8", "nonsense"}) {
        const Outcome outcome =
            cli(arguments, {.input = {}, .environment = {{"LC_ALL", locale}}, .directory = {}});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.out, expected) << locale;
    }
}

TEST_F(CommandLineOutput, ReadsBackExactly) {
    // 17 digits of a value that needs them, through trace's own echo.
    const std::string ray = "0.30000000000000004,-1.2345678901234568e-05";
    const std::string text =
        cli_output({"trace", tessar(), "--ghost", "direct", "--field", "0", "--rays", "-", "--csv"},
                   "px_mm,py_mm\n" + ray + "\n");
    EXPECT_NE(text.find("\n" + ray + ",ok,"), std::string::npos) << text;
}

TEST_F(CommandLineOutput, JsonHoldsAnyTextOfTheLens) {
    auto lens = nlohmann::json::parse(read_file(tessar()));
    lens["source"] = "quotes \" back\\slash\ttab\nline \u2014 \u00e9";
    write_file(folder / "odd, name.json", lens.dump());
    const std::string file = (folder / "odd, name.json").string();
    const auto json = nlohmann::json::parse(cli_output({"info", file, "--json"}));
    EXPECT_EQ(json["lens"]["source"], lens["source"]);
    EXPECT_EQ(json["lens"]["file"], file);
}

TEST_F(CommandLineOutput, RaysAreReadGenerously) {
    const std::string plain = "px_mm,py_mm\n1,2\n-3,+4.5\n";
    const std::string fancy =
        "\xEF\xBB\xBF# made by hand\r\n note, py_mm ,px_mm\r\n\r\na, 2 ,1\r\n  # more\r\nb,4.5, -3,"
        "left over";
    const std::vector<std::string> arguments = {"trace",   tessar(), "--ghost", "5-3",
                                                "--field", "5",      "--rays",  "-"};
    EXPECT_EQ(cli_csv(arguments, fancy).rows, cli_csv(arguments, plain).rows);
    EXPECT_TRUE(cli_csv(arguments, "px_mm,py_mm\n").rows.empty());
}

TEST_F(CommandLineOutput, RangesIncludeTheirEnd) {
    const auto angles = [](const std::string& text) {
        const Csv csv =
            cli_csv({"coating", "--stack", "1 | 1.5", "--wavelengths", "550", "--angles", text});
        std::vector<std::string> found;
        for (std::size_t row = 0; row < csv.rows.size(); ++row)
            found.push_back(csv.text(row, "angle_deg"));
        return found;
    };
    using List = std::vector<std::string>;
    EXPECT_EQ(angles("0:0.5:0.1"), (List{"0", "0.1", "0.2", "0.3", "0.4", "0.5"}));
    EXPECT_EQ(angles("0:80:30"), (List{"0", "30", "60"}));
    EXPECT_EQ(angles("90:0:-45"), (List{"90", "45", "0"}));
    EXPECT_EQ(angles("30:30:1"), (List{"30"}));
    EXPECT_EQ(angles("60"), (List{"60"}));
    EXPECT_EQ(angles("60,0:20:10, 5"), (List{"60", "0", "10", "20", "5"}));
    EXPECT_EQ(angles("0:90:0.1").size(), 901U);
    EXPECT_EQ(angles("0:90:0.1").back(), "90");
}

TEST_F(CommandLineOutput, GrazingLightIsReflected) {
    const Csv csv =
        cli_csv({"coating", "--stack", "1 | 1.5", "--wavelengths", "550", "--angles", "90"});
    EXPECT_DOUBLE_EQ(csv.number(0, "r_s"), 1.0);
    EXPECT_DOUBLE_EQ(csv.number(0, "r_p"), 1.0);
    EXPECT_NEAR(csv.number(0, "t"), 0.0, 1e-15);
}

TEST_F(CommandLineOutput, HelpNamesOptionsAndUnits) {
    const std::string help = cli_output({"--help"});
    for (const char* word : {"info", "trace", "coating", "ghosts", "render", "lenses", "Examples",
                             "mm", "nm", "degrees"})
        EXPECT_NE(help.find(word), std::string::npos) << word;
    for (const char* command : {"info", "trace", "coating", "ghosts", "render", "lenses"}) {
        const std::string text = cli_output({command, "--help"});
        EXPECT_NE(text.find(std::string("Usage: ghostlight-cli ") + command), std::string::npos)
            << text;
    }
    EXPECT_TRUE(cli_output({"--version"}).starts_with("ghostlight-cli "));
}

}  // namespace
}  // namespace ghostlight::test
