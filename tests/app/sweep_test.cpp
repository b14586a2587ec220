// Several states of light and lens in one table.

#include <nlohmann/json.hpp>

#include <set>

#include "tests/app/program.h"

namespace ghostlight::test {
namespace {

using Names = std::vector<std::string>;

Names sweep(const Names& more) {
    Names all = {"ghosts", tessar(), "--tolerance", "0.1",
                 "--top",  "2",      "--columns",   "ghost,flux_mm2,on_sensor"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

TEST(CommandLineSweep, HasOneRowForEachGhostOfEachState) {
    const Csv csv = cli_csv(sweep({"--field", "0:10:5", "--azimuth", "0,90", "--f-number", "4,8",
                                   "--wavelength", "500,600"}));
    EXPECT_EQ(csv.columns,
              (Names{"configuration", "f_number", "spectrum", "wavelength_nm", "field_deg",
                     "azimuth_deg", "ghost", "flux_mm2", "on_sensor", "worst_field_deg"}));
    EXPECT_EQ(csv.rows.size(), 3U * 2 * 2 * 2 * 3);
    std::set<std::string> states;
    for (std::size_t r = 0; r < csv.rows.size(); ++r)
        states.insert(csv.text(r, "f_number") + " " + csv.text(r, "wavelength_nm") + " " +
                      csv.text(r, "field_deg") + " " + csv.text(r, "azimuth_deg"));
    EXPECT_EQ(states.size(), 24U);
    EXPECT_NEAR(csv.number(0, "f_number"), 4.0, 1e-9);
}

TEST(CommandLineSweep, EachStateIsTheTableOfThatState) {
    const Csv csv = cli_csv(sweep({"--field", "0,12"}));
    const Csv alone = cli_csv(sweep({"--field", "12"}));
    ASSERT_EQ(csv.rows.size(), 6U);
    for (std::size_t r = 0; r < 3; ++r) {
        EXPECT_EQ(csv.text(r + 3, "ghost"), alone.text(r, "ghost"));
        EXPECT_EQ(csv.text(r + 3, "flux_mm2"), alone.text(r, "flux_mm2"));
    }
    // The image is brightest on axis.
    EXPECT_EQ(csv.text(0, "worst_field_deg"), "0");
    EXPECT_EQ(csv.text(3, "worst_field_deg"), "0");
}

TEST(CommandLineSweep, WideHasOneColumnForEachState) {
    const Csv csv = cli_csv(sweep({"--field", "0,12", "--wide", "flux_mm2"}));
    EXPECT_EQ(csv.columns, (Names{"ghost", "flux_mm2 at field_deg=0", "flux_mm2 at field_deg=12"}));
    EXPECT_EQ(csv.text(0, "ghost"), "direct");
    EXPECT_GT(csv.number(0, "flux_mm2 at field_deg=0"), csv.number(0, "flux_mm2 at field_deg=12"));
}

TEST(CommandLineSweep, ConfigurationsOfAZoom) {
    const Csv csv = cli_csv({"ghosts", "canon_zoom_70_200_f2.8", "--field", "0", "--config", "all",
                             "--tolerance", "0.5", "--top", "1", "--columns", "ghost,flux_mm2"});
    std::set<std::string> names;
    for (std::size_t r = 0; r < csv.rows.size(); ++r) names.insert(csv.text(r, "configuration"));
    EXPECT_GE(names.size(), 2U);
    EXPECT_FALSE(names.contains(""));
}

TEST(CommandLineSweep, JsonSaysWhatWasAskedAndByWhichProgram) {
    Names arguments = sweep({"--field", "0,12"});
    arguments.emplace_back("--json");
    const auto json = nlohmann::json::parse(cli_output(arguments));
    EXPECT_NE(json["program"].get<std::string>().find("ghostlight-cli "), std::string::npos);
    EXPECT_EQ(json["request"]["field_deg"], nlohmann::json({0, 12}));
    EXPECT_EQ(json["request"]["tolerance"], 0.1);
}

TEST(CommandLineSums, BySurfaceNamesEachAndEndsWithAll) {
    const Csv csv = cli_csv({"ghosts", tessar(), "--field", "5", "--by", "surface"});
    EXPECT_EQ(csv.columns,
              (Names{"surface", "element", "media", "coating", "flux_mm2", "relative_flux", "share",
                     "on_sensor_mm2", "veiling_fraction", "ghosts"}));
    ASSERT_EQ(csv.rows.size(), 8U);  // seven surfaces that reflect
    EXPECT_EQ(csv.text(7, "surface"), "all");
    EXPECT_EQ(csv.number(7, "share"), 1.0);
    double twice = 0.0;
    for (std::size_t r = 0; r < 7; ++r) twice += csv.number(r, "flux_mm2");
    EXPECT_NEAR(twice, 2.0 * csv.number(7, "flux_mm2"), 1e-9);
}

TEST(CommandLineSums, SensitivitiesNameEachParameter) {
    const Csv csv = cli_csv({"ghosts", tessar(), "--field", "5", "--top", "2", "--coating",
                             "qw:550", "--sensitivities"});
    EXPECT_EQ(csv.columns, (Names{"ghost", "flux_mm2", "surface", "parameter", "unit", "value",
                                  "d_flux_mm2_per_unit", "d_ln_flux_per_unit"}));
    // Two ghosts, of six coated surfaces three numbers and of the cemented one its reflectance.
    EXPECT_EQ(csv.rows.size(), 2U * (6 * 3 + 1));
}

TEST(CommandLineSweep, BadListsAreNamed) {
    for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{
             {"--field", "0:x:1"}, {"--f-number", "0"}, {"--wavelength", "5"}}) {
        Names arguments = {"ghosts", tessar(), option, value};
        if (option != "--field") arguments.insert(arguments.end(), {"--field", "0"});
        const Outcome outcome = cli(arguments);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.err.find(option), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace ghostlight::test
