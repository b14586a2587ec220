// Glasses and coatings by name on the command line.

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"
#include "tests/support/test_paths.h"

namespace ghostlight::test {
namespace {

const std::string data = test_data_folder().string();

class CommandLineCoatingFiles : public InTemporaryFolder {};

TEST(CommandLineGlasses, ByNameWithItsIndices) {
    const Csv glass = cli_csv({"glasses", "nbk7", "--index", "486.1327,587.5618,200"});
    ASSERT_EQ(glass.rows.size(), 1U);
    EXPECT_EQ(glass.text(0, "glass"), "N-BK7");
    EXPECT_EQ(glass.text(0, "catalog"), "SCHOTT");
    EXPECT_NEAR(glass.number(0, "nd"), 1.5168, 5e-6);  // as the maker prints it
    EXPECT_NEAR(glass.number(0, "n_486.1327"), 1.52238, 5e-6);
    EXPECT_EQ(glass.text(0, "n_200"), "");
    EXPECT_NEAR(glass.number(0, "min_nm"), 300.0, 1e-9);
}

TEST(CommandLineGlasses, NearestAndByCode) {
    const Csv nearest = cli_csv({"glasses", "--nd", "1.5168", "--vd", "64.17", "--count", "3"});
    ASSERT_EQ(nearest.rows.size(), 3U);
    EXPECT_EQ(nearest.text(0, "glass"), "N-BK7");
    EXPECT_LT(nearest.number(0, "distance"), nearest.number(1, "distance"));
    EXPECT_EQ(cli_csv({"glasses", "--code", "517.642"}).text(0, "glass"), "N-BK7");
    EXPECT_GT(cli_csv({"glasses"}).rows.size(), 100U);
    const auto json = nlohmann::json::parse(cli_output({"glasses", "N-BK7", "--json"}));
    EXPECT_EQ(json["rows"][0]["glass"], "N-BK7");
    EXPECT_TRUE(json["rows"][0]["status"].is_null());
}

TEST(CommandLineGlasses, AFolderOfTheEnvironmentComesFirst) {
    const RunOptions options{
        .input = {},
        .environment = {{"GHOSTLIGHT_GLASS_PATH", "/nowhere:" + data + "/agf"}},
        .directory = {}};
    const Outcome found = cli({"glasses", "WRONG", "--csv"}, options);
    EXPECT_EQ(found.status, 0);
    const Csv glass = parse_csv(found.out);
    EXPECT_EQ(glass.text(0, "catalog"), "SAMPLE");
    EXPECT_EQ(glass.text(0, "status"), "preferred");
    EXPECT_EQ(glass.number(0, "listed_nd"), 1.5178);
    // Its formula and its listed nd disagree, and a folder is not there.
    EXPECT_NE(found.err.find("WRONG"), std::string::npos) << found.err;
    EXPECT_NE(found.err.find("/nowhere"), std::string::npos) << found.err;
    EXPECT_EQ(cli({"glasses", "WRONG"}).status, 2);
}

TEST(CommandLineGlasses, FaultsAreNamed) {
    const Outcome unknown = cli({"glasses", "BK7"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.err.find("N-BK7"), std::string::npos) << unknown.err;
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"glasses", "--nd", "1.5"},
          {"glasses", "--code", "12"},
          {"glasses", "N-BK7", "--code", "517642"},
          {"glasses", "--nd", "x", "--vd", "60"}}) {
        const Outcome outcome = cli(arguments);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
}

TEST(CommandLineCoatings, ListNamesThatTheOtherCommandsTake) {
    const Csv list = cli_csv({"coatings"});
    ASSERT_GE(list.rows.size(), 8U);
    for (std::size_t i = 0; i < list.rows.size(); ++i) {
        EXPECT_FALSE(list.text(i, "source").empty());
        const Csv curve = cli_csv({"coating", "--library", list.text(i, "coating"), "--wavelengths",
                                   "550", "--angles", "0,40"});
        EXPECT_LT(curve.number(0, "r"), 0.05) << list.text(i, "coating");
    }
    // The V-coat's zero, on what it was designed for; not on another glass.
    auto v_coat = [](const std::string& substrate) {
        std::vector<std::string> all{"coating", "--library", "v-coat", "--wavelengths",
                                     "550",     "--angles",  "0"};
        if (!substrate.empty()) all.insert(all.end(), {"--substrate", substrate});
        return cli_csv(all).number(0, "r");
    };
    EXPECT_LT(v_coat(""), 1e-12);
    EXPECT_LT(v_coat("1.52"), 1e-12);
    EXPECT_GT(v_coat("1.9"), 1e-3);
    EXPECT_LT(v_coat("N-BK7"), 1e-5);
}

TEST(CommandLineCoatings, GoOnALensAndLookTheSameOnBothSidesOfAnElement) {
    auto r = [](const std::string& surface, const std::string& direction) {
        return cli_csv({"coating", tessar(), "--coating", "three-layer-quarter-half-quarter",
                        "--surface", surface, "--direction", direction, "--wavelengths", "500",
                        "--angles", "0"})
            .number(0, "r");
    };
    // Surface 1 goes from air to glass, surface 8 from the same glass to air.
    EXPECT_NEAR(r("1", "forward"), r("8", "backward"), 1e-12);
    EXPECT_NE(r("1", "forward"), r("5", "forward"));
}

TEST(CommandLineCoatings, AMeasuredTableGivesItsEntries) {
    const Csv curve = cli_csv({"coating", tessar(), "--coating", data + "/coatings/sheet.csv",
                               "--surface", "1", "--wavelengths", "450,550", "--angles", "0,45"});
    EXPECT_NEAR(curve.number(0, "r_s"), 0.010, 1e-12);
    EXPECT_NEAR(curve.number(3, "r_s"), 0.012, 1e-12);
    EXPECT_NEAR(curve.number(3, "r_p"), 0.003, 1e-12);
    EXPECT_NEAR(curve.number(3, "t_p"), 0.997, 1e-12);
    const Outcome missing = cli({"info", tessar(), "--coating", "/nowhere.csv"});
    EXPECT_EQ(missing.status, 2);
    EXPECT_NE(missing.err.find("/nowhere.csv"), std::string::npos);
}

TEST_F(CommandLineCoatingFiles, AConstantReflectanceMakesAGhostOfItsProduct) {
    // R = 0.5 % everywhere in place of 0.1 %: every ghost's flux is 25 times as much, but for the
    // transmittances, 1 − R, of the surfaces that it passes.
    auto weight = [&](const std::string& share) {
        const auto file = folder / (share + ".csv");
        write_file(file, "nm,r\n550," + share + "\n");
        const Csv ray = cli_csv({"trace", tessar(), "--ghost", "3-1", "--rays", "-", "--field", "0",
                                 "--coating", file.string()},
                                "px_mm,py_mm\n0,0\n");
        return ray.number(0, "weight");
    };
    // Ghost 3-1 on the axis: R² (1 − R)⁶ and what the cemented pair lets pass, the same for both.
    EXPECT_NEAR(weight("0.005") / weight("0.001"), 25.0 * std::pow(0.995 / 0.999, 6), 1e-9);
}

}  // namespace
}  // namespace ghostlight::test
