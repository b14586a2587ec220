#include "core/io/table_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace ghostlight {
namespace {

GhostTable small_table() {
    GhostTable table;
    table.direct.flux_mm2 = 1000.0 / 3.0;
    table.direct.relative_flux = 1.0;
    table.direct.rays = 100;
    GhostRow ghost;
    ghost.path.reflections = {4, 2};
    ghost.flux_mm2 = 1e-7;
    ghost.turns[0].reflectance = 0.0125;
    ghost.rays = 400;
    table.ghosts.push_back(ghost);
    return table;
}

TEST(GhostTableFile, CsvHasTheDocumentedColumns) {
    std::istringstream csv(ghost_table_csv(small_table()));
    std::string header, direct, ghost, rest;
    std::getline(csv, header);
    std::getline(csv, direct);
    std::getline(csv, ghost);
    EXPECT_EQ(header,
              "ghost,surface_1,surface_2,flux_mm2,flux_error_mm2,relative_flux,peak_per_e0,"
              "centroid_x_mm,centroid_y_mm,rms_radius_mm,on_sensor,reflectance_1,reflectance_2,"
              "rays");
    EXPECT_EQ(direct, "direct,,,333.3333333333333,0,1,0,0,0,0,0,,,100");
    EXPECT_EQ(ghost, "5-3,5,3,1e-07,0,0,0,0,0,0,0,0.0125,0,400");
    EXPECT_FALSE(std::getline(csv, rest));
}

TEST(GhostTableFile, JsonHasTheSameRows) {
    const auto rows = nlohmann::json::parse(ghost_table_json(small_table()));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0]["ghost"], "direct");
    EXPECT_TRUE(rows[0]["surface_1"].is_null());
    EXPECT_TRUE(rows[0]["reflectance_2"].is_null());
    EXPECT_EQ(rows[0]["flux_mm2"], 1000.0 / 3.0);
    EXPECT_EQ(rows[1]["surface_1"], 5);
    EXPECT_EQ(rows[1]["rays"], 400);
}

}  // namespace
}  // namespace ghostlight
