#include "core/io/sensor_json.h"

#include <gtest/gtest.h>

#include "core/io/lens_file.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

Prescription lens_with(const std::string& reflectance) {
    const std::string text =
        R"({"ghostlight_lens": 1, "name": "x", "stop": {"surface": 1},
            "sensor": {"distance_mm": 10, "reflectance": )" +
        reflectance + R"(}, "surfaces": [{"radius_mm": 20, "index": 1.5, "semi_diameter_mm": 5}]})";
    return lens_from_json(text, "x.json").lens;
}

TEST(SensorJson, EachKindComesBackAsItWas) {
    for (const char* text :
         {"0.06", R"({"table": [[400, 0.04], [700, 0.1]]})",
          R"({"layers": [{"index": 1.46, "thickness_nm": 90}, {"index": 2, "k": 0.1,
              "thickness_nm": 40}], "substrate": {"index": 4.1}})"}) {
        const Prescription lens = lens_with(text);
        ASSERT_TRUE(lens.sensor.reflectance.has_value()) << text;
        EXPECT_EQ(lens_from_json(lens_to_json(lens), "x.json").lens, lens) << text;
    }
    EXPECT_EQ(lens_with("0.06").sensor.reflectance, SensorReflectance{UniformReflectance{0.06}});
}

TEST(SensorJson, WhatIsWrongIsNamed) {
    struct Case {
        const char *text, *where;
    };
    for (const Case& each :
         {Case{"1.5", "sensor.reflectance"}, Case{"-0.1", "sensor.reflectance"},
          Case{"\"shiny\"", "sensor.reflectance"}, Case{"{}", "sensor.reflectance"},
          Case{R"({"table": []})", "sensor.reflectance.table"},
          Case{R"({"table": [[500, 0.1], [400, 0.1]]})", "sensor.reflectance.table[2]"},
          Case{R"({"table": [[500]]})", "sensor.reflectance.table[1]"},
          Case{R"({"layers": []})", "sensor.reflectance.substrate"}}) {
        const auto parts = error_of([&] { lens_with(each.text); });
        EXPECT_EQ(parts.where, each.where) << each.text << ": " << parts.problem;
    }
}

}  // namespace
}  // namespace ghostlight
