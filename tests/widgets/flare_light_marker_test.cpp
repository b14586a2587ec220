#include "widgets/light_marker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ghostlight {
namespace {

TEST(FlareLightMarker, IsAtTheFocalLengthTimesTheTangent) {
    const glm::dvec2 up = light_on_sensor_mm({10.0, 90.0}, 100.0);
    EXPECT_NEAR(up.x, 0.0, 1e-12);
    EXPECT_NEAR(up.y, 17.6326980708, 1e-9);
    const glm::dvec2 left = light_on_sensor_mm({45.0, 180.0}, 50.0);
    EXPECT_NEAR(left.x, -50.0, 1e-9);
    EXPECT_NEAR(left.y, 0.0, 1e-9);
}

TEST(FlareLightMarker, GoesThereAndBack) {
    for (const double efl_mm : {100.0, 10.5, -80.0}) {
        for (const double field_deg : {0.01, 3.0, 40.0, 88.0}) {
            for (const double azimuth_deg : {-170.0, -90.0, 0.0, 30.0, 179.0}) {
                const LightDirection light{field_deg, azimuth_deg};
                const LightDirection back =
                    light_at_sensor_mm(light_on_sensor_mm(light, efl_mm), efl_mm, 0.0);
                EXPECT_NEAR(back.field_deg, field_deg, 1e-9);
                EXPECT_NEAR(back.azimuth_deg, azimuth_deg, 1e-7);
            }
        }
    }
}

TEST(FlareLightMarker, OnTheAxisKeepsItsAzimuth) {
    const LightDirection light = light_at_sensor_mm({0.0, 0.0}, 100.0, 37.0);
    EXPECT_EQ(light.field_deg, 0.0);
    EXPECT_EQ(light.azimuth_deg, 37.0);
}

TEST(FlareLightMarker, StopsShortOfTheHorizon) {
    EXPECT_EQ(light_at_sensor_mm({1e7, 0.0}, 100.0, 0.0).field_deg, most_dragged_field_deg);
}

}  // namespace
}  // namespace ghostlight
