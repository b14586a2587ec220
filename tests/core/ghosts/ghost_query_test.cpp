#include "core/ghosts/ghost_query.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

constexpr std::size_t surfaces = 9;

GhostRow ghost(std::size_t first, std::size_t second, double flux_mm2, double focus_mm,
               double on_sensor, double rms_mm) {
    GhostRow row;
    row.path.reflections = {first - 1, second - 1};
    row.flux_mm2 = flux_mm2;
    row.paraxial.focus_from_sensor_mm = focus_mm;
    row.on_sensor = on_sensor;
    row.rms_radius_mm = rms_mm;
    row.turns[0].reflectance = 0.04;
    return row;
}

GhostTable table() {
    GhostTable all;
    all.surface_count = surfaces;
    all.ghosts = {ghost(7, 3, 1e-2, -4.0, 1.0, 1.0), ghost(7, 5, 1e-4, 40.0, 0.25, 8.0),
                  ghost(4, 2, 1e-5, 4.9, 0.0, 30.0), ghost(10, 7, 1e-8, -200.0, 0.6, 3.0)};
    return all;
}

/// The wanted ghosts of the table by name.
std::string wanted(const std::string& words) {
    const GhostQuery query = parse_ghost_query(words, surfaces);
    const GhostTable all = table();
    std::string names;
    for (const GhostRow& row : all.ghosts)
        if (passes(query, row, all)) names += name(row.path, surfaces) + " ";
    return names;
}

TEST(GhostQuery, TakesTheWordsOfPeople) {
    EXPECT_EQ(wanted(""), "7-3 7-5 4-2 sensor-7 ");
    EXPECT_EQ(wanted("touches surface 7"), "7-3 7-5 sensor-7 ");
    EXPECT_EQ(wanted("Touches 7"), "7-3 7-5 sensor-7 ");
    EXPECT_EQ(wanted("touches sensor"), "sensor-7 ");
    EXPECT_EQ(wanted("focus within 5 mm of the sensor"), "7-3 4-2 ");
    EXPECT_EQ(wanted("above 1e-6"), "7-3 7-5 4-2 ");
    EXPECT_EQ(wanted("flux below 1e-4 mm2"), "7-5 4-2 sensor-7 ");
    EXPECT_EQ(wanted("above 1 % of the strongest"), "7-3 7-5 ");
    EXPECT_EQ(wanted("below 1 % of the strongest"), "4-2 sensor-7 ");
    EXPECT_EQ(wanted("on sensor above 50 %"), "7-3 sensor-7 ");
    EXPECT_EQ(wanted("on the sensor"), "7-3 7-5 sensor-7 ");
    EXPECT_EQ(wanted("RMS < 5 mm"), "7-3 sensor-7 ");
    EXPECT_EQ(wanted("R1 >= 4 %"), "7-3 7-5 4-2 sensor-7 ");
    EXPECT_EQ(wanted("focus below -100"), "sensor-7 ");
    EXPECT_EQ(wanted("4-2"), "4-2 ");
    EXPECT_EQ(wanted("sensor-7"), "sensor-7 ");
}

TEST(GhostQuery, JoinsConditions) {
    EXPECT_EQ(wanted("touches 7 and above 1e-6"), "7-3 7-5 ");
    EXPECT_EQ(wanted("touches 7, above 1e-6, and RMS below 2"), "7-3 ");
    EXPECT_EQ(wanted("touches 5 or 2"), "7-5 4-2 ");
    EXPECT_EQ(wanted("touches 5 or 2 and above 5e-5"), "7-5 ");
    EXPECT_EQ(wanted("4-2 or sensor-7"), "4-2 sensor-7 ");
    EXPECT_EQ(wanted("touches 4 or above 1e-3"), "7-3 4-2 ");
    EXPECT_EQ(wanted("not touches 7"), "4-2 ");
    EXPECT_EQ(wanted("touches 7 and not below 1e-6"), "7-3 7-5 ");
}

TEST(GhostQuery, SaysWhatItDoesNotUnderstand) {
    const auto refused = [](const std::string& words) {
        return error_of([&] { parse_ghost_query(words, surfaces); });
    };
    EXPECT_EQ(refused("touches 12").found, "'12'");
    EXPECT_NE(refused("touches 12").expected.find("1 to 9"), std::string::npos);
    EXPECT_EQ(refused("touches").found, "the end");
    EXPECT_EQ(refused("above bright").found, "'bright'");
    EXPECT_EQ(refused("touches 7 above 1").found, "'above'");
    EXPECT_EQ(refused("pretty ones").found, "'pretty'");
    EXPECT_EQ(refused("focus within 5 mm of the lens").found, "'lens'");
    EXPECT_EQ(refused("touches 3 and 4").found, "'and'");
    EXPECT_EQ(refused("above 1e999").found, "'1e999'");
    EXPECT_EQ(refused("above 5 %").found, "'%'");
    EXPECT_EQ(refused("20-3").found, "'20-3'");
    EXPECT_EQ(refused("touches 7 or").found, "the end");
}

}  // namespace
}  // namespace ghostlight
