// What changes the lens, the light or the choice of rows for one run.

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace ghostlight::test {
namespace {

using Arguments = std::vector<std::string>;

Csv info(const Arguments& more) {
    Arguments all = {"info", tessar()};
    all.insert(all.end(), more.begin(), more.end());
    return cli_csv(all);
}

Csv traced(const Arguments& more) {
    Arguments all = {"trace", tessar(), "--ghost", "5-3", "--rays", "-"};
    all.insert(all.end(), more.begin(), more.end());
    return cli_csv(all, "px_mm,py_mm\n3,4\n-2,7\n");
}

double reflectance(const Arguments& more) {
    Arguments all = {"coating", tessar(), "--wavelengths", "550", "--angles", "0"};
    all.insert(all.end(), more.begin(), more.end());
    return cli_csv(all).number(0, "r");
}

TEST(CommandLineOverrides, FNumberAndStop) {
    EXPECT_NEAR(info({"--f-number", "8"}).number(0, "f_number"), 8.0, 1e-12);
    EXPECT_EQ(info({"--f-number", "8"}).number(0, "efl_mm"), info({}).number(0, "efl_mm"));
    EXPECT_NEAR(info({"--stop-semi-diameter", "7.5"}).number(0, "entrance_pupil_radius_mm"),
                0.5 * info({}).number(0, "entrance_pupil_radius_mm"), 1e-12);
}

TEST(CommandLineOverrides, TheStopOpensNoFurtherThanTheLens) {
    const Outcome fast = cli({"info", tessar(), "--f-number", "1", "--csv"});
    EXPECT_EQ(fast.status, 0);
    EXPECT_EQ(parse_csv(fast.out).number(0, "f_number"), info({}).number(0, "f_number"));
    EXPECT_NE(fast.err.find("warning: --f-number"), std::string::npos) << fast.err;
    const Outcome wide = cli({"info", tessar(), "--stop-semi-diameter", "100", "--csv"});
    EXPECT_EQ(parse_csv(wide.out).number(0, "f_number"), info({}).number(0, "f_number"));
    EXPECT_NE(wide.err.find("warning: --stop-semi-diameter"), std::string::npos) << wide.err;
}

TEST(CommandLineOverrides, Coating) {
    const double bare = 0.691 / 2.691;  // (n - 1)/(n + 1) at d; 550 nm is close
    EXPECT_NEAR(reflectance({"--surface", "1", "--coating", "none"}), bare * bare, 1e-3);
    EXPECT_LT(reflectance({"--surface", "1", "--coating", "qw:550"}), 0.006);
    EXPECT_NEAR(reflectance({"--surface", "1", "--coating", "qw:550"}),
                reflectance({"--surface", "1", "--coating", "qw:550:1.38"}), 1e-3);
    EXPECT_NE(reflectance({"--surface", "1", "--coating", "qw:550"}),
              reflectance({"--surface", "1", "--coating", "qw:550:1.38"}));
    // Cemented: air on neither side, so no layer. The stop: air on both.
    EXPECT_EQ(reflectance({"--surface", "2", "--coating", "qw:550"}),
              reflectance({"--surface", "2", "--coating", "none"}));
    EXPECT_EQ(reflectance({"--surface", "4", "--coating", "qw:550"}), 0.0);
}

TEST(CommandLineOverrides, DirectionOfACoating) {
    const Arguments row = {"coating",  tessar(), "--surface",     "1",  "--coating", "qw:550:1.38",
                           "--angles", "40",     "--wavelengths", "550"};
    Arguments backward = row;
    backward.insert(backward.end(), {"--direction", "backward"});
    const Csv from_air = cli_csv(row), from_glass = cli_csv(backward);
    EXPECT_LT(from_air.number(0, "r"), 0.1);
    EXPECT_EQ(from_glass.number(0, "r"), 1.0);  // beyond total reflection
    EXPECT_NEAR(
        reflectance({"--surface", "1", "--coating", "qw:550:1.38"}),
        reflectance({"--surface", "1", "--coating", "qw:550:1.38", "--direction", "backward"}),
        1e-15);
}

TEST(CommandLineOverrides, Azimuth) {
    const Csv up = traced({"--field", "15"});
    EXPECT_EQ(up.rows, traced({"--field", "15", "--azimuth", "90"}).rows);
    // Backwards twice: the same light.
    const Csv down = traced({"--field", "-15", "--azimuth", "-90"});
    for (std::size_t row = 0; row < up.rows.size(); ++row)
        for (const char* name : {"x_mm", "y_mm", "weight"})
            EXPECT_NEAR(up.number(row, name), down.number(row, name), 1e-11);
    // Turned by a quarter: (x, y) becomes (y, -x).
    const Csv right = cli_csv(
        {"trace", tessar(), "--ghost", "5-3", "--rays", "-", "--field", "15", "--azimuth", "0"},
        "px_mm,py_mm\n4,-3\n7,2\n");
    for (std::size_t row = 0; row < up.rows.size(); ++row) {
        EXPECT_NEAR(right.number(row, "x_mm"), up.number(row, "y_mm"), 1e-11);
        EXPECT_NEAR(right.number(row, "y_mm"), -up.number(row, "x_mm"), 1e-11);
        EXPECT_NEAR(right.number(row, "weight"), up.number(row, "weight"), 1e-13);
    }
}

TEST(CommandLineOverrides, AzimuthOfAGhostTable) {
    const Csv up = cli_csv({"ghosts", tessar(), "--field", "15", "--sensor", "30x30"});
    const Csv right =
        cli_csv({"ghosts", tessar(), "--field", "15", "--sensor", "30x30", "--azimuth", "0"});
    for (std::size_t row = 0; row < up.rows.size(); ++row) {
        const std::string ghost = up.text(row, "ghost");
        const std::size_t i = right.find("ghost", ghost);
        const double scale = up.number(row, "rms_radius_mm");
        EXPECT_NEAR(right.number(i, "flux_mm2") / up.number(row, "flux_mm2"), 1.0, 0.01) << ghost;
        EXPECT_NEAR(right.number(i, "centroid_x_mm"), up.number(row, "centroid_y_mm"), 0.02 * scale)
            << ghost;
        EXPECT_NEAR(right.number(i, "on_sensor"), up.number(row, "on_sensor"), 0.02) << ghost;
    }
}

TEST(CommandLineOverrides, Sensor) {
    const Arguments ghosts = {"ghosts", tessar(), "--field", "0", "--tolerance", "1", "--sensor"};
    Arguments huge = ghosts, tiny = ghosts;
    huge.emplace_back("1e5x1e5");
    tiny.emplace_back("0.5x0.5");
    EXPECT_NEAR(cli_csv(huge).number(1, "on_sensor"), 1.0, 1e-9);
    EXPECT_LT(cli_csv(tiny).number(1, "on_sensor"), 0.01);
}

TEST(CommandLineOverrides, TopKeepsTheStrongest) {
    const Csv all = cli_csv({"ghosts", tessar(), "--field", "0"});
    const Csv top = cli_csv({"ghosts", tessar(), "--field", "0", "--top", "3"});
    ASSERT_EQ(all.rows.size(), 22U);
    ASSERT_EQ(top.rows.size(), 4U);
    for (std::size_t row = 0; row < top.rows.size(); ++row) EXPECT_EQ(top.rows[row], all.rows[row]);
    for (std::size_t row = 2; row < all.rows.size(); ++row)
        EXPECT_GE(all.number(row - 1, "flux_mm2"), all.number(row, "flux_mm2"));
    EXPECT_EQ(cli_csv({"ghosts", tessar(), "--field", "0", "--top", "1000"}).rows, all.rows);
}

TEST(CommandLineOverrides, SpectrumOfOneLineIsThatLine) {
    const Arguments ghosts = {"ghosts", tessar(), "--field",     "0",
                              "--top",  "2",      "--tolerance", "0.5"};
    Arguments line = ghosts, named = ghosts, wide = ghosts;
    line.insert(line.end(), {"--wavelength", "486.1327"});
    named.insert(named.end(), {"--spectrum", "486.1327 nm"});
    wide.insert(wide.end(), {"--spectrum", "D65"});
    EXPECT_EQ(cli_csv(line).rows, cli_csv(named).rows);
    EXPECT_NE(cli_csv(line).rows, cli_csv(wide).rows);
}

class CommandLineConfigurations : public InTemporaryFolder {};

TEST_F(CommandLineConfigurations, AreFoundByName) {
    // Any bundled lens that has two positions.
    const auto lenses = nlohmann::json::parse(cli_output({"lenses", "--json"}))["rows"];
    for (const auto& lens : lenses) {
        const std::string names = lens["configurations"];
        const auto space = names.find(' ');
        if (space == std::string::npos) continue;
        const std::string lens_name = lens["lens"], first = names.substr(0, space);
        const std::string last = names.substr(names.rfind(' ') + 1);
        const Csv wide = parse_csv(cli({"info", lens_name, "--config", first, "--csv"}).out);
        const Csv tele = parse_csv(cli({"info", lens_name, "--config", last, "--csv"}).out);
        EXPECT_NE(wide.number(0, "efl_mm"), tele.number(0, "efl_mm"));
        const Outcome wrong = cli({"info", lens_name, "--config", "no-such"});
        EXPECT_EQ(wrong.status, 2);
        EXPECT_NE(wrong.err.find(first), std::string::npos) << wrong.err;
        return;
    }
    GTEST_SKIP() << "no bundled lens has configurations";
}

TEST_F(CommandLineConfigurations, AFileWinsOverABundledName) {
    const auto lenses = nlohmann::json::parse(cli_output({"lenses", "--json"}))["rows"];
    ASSERT_FALSE(lenses.empty());
    const std::string name = lenses[0]["lens"];
    auto lens = nlohmann::json::parse(read_file(tessar()));
    lens["name"] = "not the bundled one";
    write_file(folder / name, lens.dump());
    const auto in_folder = RunOptions{.input = {}, .environment = {}, .directory = folder};
    EXPECT_NE(cli({"info", name}, in_folder).out.find("not the bundled one"), std::string::npos);
    EXPECT_EQ(cli({"info", name}).out.find("not the bundled one"), std::string::npos);
}

}  // namespace
}  // namespace ghostlight::test
