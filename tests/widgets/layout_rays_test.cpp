#include "widgets/ray_fan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "core/io/lens_file.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

constexpr double lead_mm = 10.0;

OpticalSystem bundled_system(const std::string& file) {
    return compile(read_lens(lens_folder() / file).lens, 587.5618);
}

OpticalSystem tessar() { return bundled_system("tessar_brendel_100_f2.8.json"); }

TEST(LayoutRays, TheDirectFanEndsOnTheSensorNearTheImage) {
    const OpticalSystem system = tessar();
    const RayFan fan = ray_fan(system, {}, 10.0, 9, lead_mm);
    EXPECT_EQ(fan.rays, 9);
    ASSERT_EQ(fan.stretches.size(), 9U);
    const double image_mm = first_order(system).efl_mm * std::tan(rad_from_deg(10.0));
    for (const RayStretch& ray : fan.stretches) {
        EXPECT_EQ(ray.leg, RayLeg::direct);
        EXPECT_DOUBLE_EQ(ray.points.back().x, system.sensor_z_mm);
        EXPECT_NEAR(ray.points.back().y, image_mm, 0.5);  // mm, this Tessar's aberrations
        EXPECT_LT(ray.points.front().x, 0.0);
    }
}

TEST(LayoutRays, TheDirectFanFillsTheStop) {
    OpticalSystem system = tessar();
    system.stop_mask.semi_diameter_mm *= 0.4;  // then nothing else limits
    const RayFan fan = ray_fan(system, {}, 5.0, 9, lead_mm);
    const double stop_z = system.surfaces[system.stop].vertex_z_mm;
    double low = 1e9, high = -1e9;
    for (const RayStretch& ray : fan.stretches) {
        for (const DrawingPoint& point : ray.points) {
            if (std::abs(point.x - stop_z) < 1e-9) {
                low = std::min(low, point.y);
                high = std::max(high, point.y);
            }
        }
    }
    const double opening = system.stop_mask.semi_diameter_mm;
    EXPECT_NEAR(high, opening, 1e-3 * opening);
    EXPECT_NEAR(low, -opening, 1e-3 * opening);
}

TEST(LayoutRays, AGhostHasThreeLegsThatMeetAtItsReflections) {
    const OpticalSystem system = tessar();
    const GhostPath path = parse_ghost("5-3", system);
    const RayFan fan = ray_fan(system, path, 10.0, 7, lead_mm);
    ASSERT_EQ(fan.rays, 7);
    ASSERT_EQ(fan.stretches.size(), 21U);
    for (std::size_t i = 0; i < fan.stretches.size(); i += 3) {
        const RayStretch& in = fan.stretches[i];
        const RayStretch& between = fan.stretches[i + 1];
        const RayStretch& out = fan.stretches[i + 2];
        EXPECT_EQ(in.leg, RayLeg::in);
        EXPECT_EQ(between.leg, RayLeg::between);
        EXPECT_EQ(out.leg, RayLeg::out);
        EXPECT_EQ(in.points.back(), between.points.front());
        EXPECT_EQ(between.points.back(), out.points.front());
        EXPECT_GT(between.points.front().x, between.points.back().x) << "it goes back";
        EXPECT_DOUBLE_EQ(out.points.back().x, system.sensor_z_mm);
    }
    ASSERT_EQ(fan.marks.size(), 2U);
    EXPECT_EQ(fan.marks[0].number, 1);
    EXPECT_EQ(fan.marks[0].row, 4U);
    EXPECT_EQ(fan.marks[1].row, 2U);
    EXPECT_LT(fan.marks[1].at.x, fan.marks[0].at.x);
}

TEST(LayoutRays, SpansEndWhereTheRaysDo) {
    const OpticalSystem system = tessar();
    const BeamFrame frame = beam_frame({10.0, 90.0});
    const auto fate = [&](const GhostPath& path, double v_mm) {
        return trace_ray(system, path, {v_mm * frame.e2, frame.direction}).status.fate;
    };
    for (const char* text : {"direct", "5-3", "8-6"}) {
        const GhostPath path = parse_ghost(text, system);
        for (const PupilSpan& span : surviving_spans(system, path, 10.0)) {
            EXPECT_EQ(fate(path, span.low_mm), RayFate::ok);
            EXPECT_EQ(fate(path, span.high_mm), RayFate::ok);
            EXPECT_NE(fate(path, span.low_mm - 1e-4), RayFate::ok);
            EXPECT_NE(fate(path, span.high_mm + 1e-4), RayFate::ok);
        }
    }
}

TEST(LayoutRays, ATinyStopIsStillFound) {
    OpticalSystem system = tessar();
    system.stop_mask.semi_diameter_mm = 0.05;
    const RayFan fan = ray_fan(system, {}, 12.0, 5, lead_mm);
    EXPECT_EQ(fan.rays, 5);
    EXPECT_LT(fan.v_high_mm - fan.v_low_mm, 0.3);
}

TEST(LayoutRays, WhereNothingSurvivesTheRaysEndWhereTheyAreStopped) {
    const OpticalSystem system = tessar();
    const RayFan fan = ray_fan(system, {}, 60.0, 7, lead_mm);
    EXPECT_EQ(fan.rays, 0);
    EXPECT_TRUE(fan.sensor_y_mm.empty());
    EXPECT_FALSE(fan.stretches.empty());
    for (const RayStretch& ray : fan.stretches) {
        EXPECT_EQ(ray.leg, RayLeg::lost);
        EXPECT_LT(ray.points.back().x, system.sensor_z_mm);
    }
}

TEST(LayoutRays, AFisheyesRaysBeginOutsideTheLens) {
    const OpticalSystem system = bundled_system("fisheye_nikkor_10.5_f2.8.json");
    const RayFan fan = ray_fan(system, {}, 85.0, 9, lead_mm);
    EXPECT_EQ(fan.rays, 9);
    const BeamFrame frame = beam_frame({85.0, 90.0});
    for (const RayStretch& ray : fan.stretches) {
        const DrawingPoint step = ray.points[1] - ray.points[0];
        // From the start to the first surface it goes forward, by at least the lead-in.
        EXPECT_GE(step.x * frame.direction.z + step.y * frame.direction.y, lead_mm * (1.0 - 1e-9));
    }
}

TEST(LayoutRays, EveryBundledLensHasADirectImageOnTheAxis) {
    for (const auto& entry : bundled_lenses()) {
        const OpticalSystem system = compile(read_lens(entry.file).lens, 587.5618);
        const RayFan fan = ray_fan(system, {}, 0.0, 9, lead_mm);
        EXPECT_EQ(fan.rays, 9) << entry.name;
        // Symmetrical about the axis.
        for (std::size_t i = 0; i < fan.sensor_y_mm.size(); ++i) {
            EXPECT_NEAR(fan.sensor_y_mm[i], -fan.sensor_y_mm[fan.sensor_y_mm.size() - 1 - i], 1e-3)
                << entry.name;
        }
    }
}

}  // namespace
}  // namespace ghostlight
