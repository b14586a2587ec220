// What is suspicious in a lens, ghosts through a range, and ghosts named by words.

#include "tests/app/program.h"

namespace ghostlight::test {
namespace {

TEST(CommandLineCheck, NamesRowAndCell) {
    const Csv csv = cli_csv({"check", "cooke_triplet_50_f5", "--csv"});
    EXPECT_EQ(csv.columns,
              (std::vector<std::string>{"severity", "surface", "cell", "finding", "proposal"}));
    const Csv odd = cli_csv({"check", "cooke_triplet_50_f5", "--coating", "qw:5500", "--csv"});
    const std::size_t row = odd.find("cell", "coating");
    EXPECT_EQ(odd.text(row, "severity"), "warning");
    EXPECT_NE(odd.text(row, "finding").find("5500"), std::string::npos);
}

TEST(CommandLineSweepOfANumber, HasTheRowsOfTheTable) {
    const Csv csv = cli_csv({"sweep", "cooke_triplet_50_f5", "--parameter", "field", "--values",
                             "0:8:4", "--tolerance", "0.1", "--csv"});
    EXPECT_EQ(csv.columns.front(), "field_deg");
    EXPECT_EQ(csv.rows.size(), 3U * 15U);
    const Csv alone =
        cli_csv({"ghosts", "cooke_triplet_50_f5", "--field", "8", "--tolerance", "0.1", "--csv"});
    for (std::size_t r = 0; r < csv.rows.size(); ++r) {
        if (csv.text(r, "field_deg") != "8") continue;
        EXPECT_EQ(csv.text(r, "flux_mm2"),
                  alone.text(alone.find("ghost", csv.text(r, "ghost")), "flux_mm2"));
    }
}

TEST(CommandLineSweepOfANumber, SaysWhatCannotBeSwept) {
    const Outcome outcome =
        cli({"sweep", "cooke_triplet_50_f5", "--parameter", "radius 99", "--values", "1"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("--parameter"), std::string::npos);
}

TEST(CommandLineWhere, KeepsTheGhostsThatWordsName) {
    const auto rows = [](const std::string& words) {
        return cli_csv({"ghosts", "cooke_triplet_50_f5", "--field", "5", "--tolerance", "0.1",
                        "--where", words, "--csv"});
    };
    EXPECT_EQ(rows("touches 1").rows.size(), 1U + 5U);  // and the direct path
    EXPECT_EQ(rows("not touches 1").rows.size(), 1U + 10U);
    const Outcome outcome =
        cli({"ghosts", "cooke_triplet_50_f5", "--field", "5", "--where", "bright ones"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("--where"), std::string::npos);
    EXPECT_NE(outcome.err.find("'bright'"), std::string::npos);
}

}  // namespace
}  // namespace ghostlight::test
