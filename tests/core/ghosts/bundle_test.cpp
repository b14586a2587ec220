// SIMD bundles against one ray at a time.
#include "core/ghosts/bundle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/ghosts/pupil.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr const char* lens_names[] = {"tessar_brendel_100_f2.8",  "double_gauss_tronnier_100_f2",
                                      "fisheye_nikkor_10.5_f2.8", "nikkor_z_14_30_f4_wide",
                                      "nikkor_z_58_f0.95_noct",   "canon_zoom_70_200_f2.8",
                                      "angenieux_1953_100_f1.1"};

template <class T>
Bundle<T> random_bundle(const PupilBox& box, std::size_t count, std::uint64_t seed) {
    Random random(seed);
    Bundle<T> bundle;
    for (std::size_t i = 0; i < count; ++i) {
        bundle.u_mm.push_back(static_cast<T>(random.between(box.u0_mm, box.u1_mm)));
        bundle.v_mm.push_back(static_cast<T>(random.between(box.v0_mm, box.v1_mm)));
    }
    return bundle;
}

std::vector<GhostPath> some_paths(const OpticalSystem& system) {
    const auto all = two_reflection_ghosts(system);
    std::vector<GhostPath> some{{}};
    for (std::size_t i = 0; i < all.size(); i += 1 + all.size() / 8) some.push_back(all[i]);
    return some;
}

template <class Check>
void for_each_case(Check check) {
    for (const char* file : lens_names) {
        const OpticalSystem system = compile(bundled(file), d_line_nm);
        for (const double field : {0.0, 14.0})
            for (const GhostPath& path : some_paths(system)) {
                const BeamFrame frame = beam_frame({field, 70.0});
                SCOPED_TRACE(std::string(file) + " " + name(path) + " at " + std::to_string(field));
                check(system, path, frame);
            }
    }
}

Ray ray_of(const BeamFrame& frame, double u, double v) {
    return {u * frame.e1 + v * frame.e2, frame.direction};
}

TEST(Bundle, DoubleLanesFollowSingleRays) {
    // Fused multiplications round otherwise; errors grow with the distance to the sensor.
    constexpr double tolerance_mm = 1e-9;      // times (1 + |x| + |y|)/dz²
    constexpr double weight_tolerance = 1e-9;  // relative
    constexpr double undecided = 1e-9;         // of a margin: either side of an edge
    int passed = 0, failed = 0;
    for_each_case([&](const OpticalSystem& system, const GhostPath& path, const BeamFrame& frame) {
        Bundle<double> bundle = random_bundle<double>(entrance_box(system, frame), 61, 41);
        trace_bundle(trace_path<double>(system, path), frame, Weights::polarised, bundle);
        for (std::size_t i = 0; i < bundle.size(); ++i) {
            const TracedRay ray =
                trace_ray(system, path, ray_of(frame, bundle.u_mm[i], bundle.v_mm[i]));
            if (std::abs(bundle.margin[i]) < undecided) continue;
            if (!ray.status.reaches_sensor()) {
                EXPECT_LT(bundle.margin[i], 0.0) << to_string(ray.status);
                ++failed;
                continue;
            }
            EXPECT_TRUE(ray.status.fate != RayFate::ok || bundle.margin[i] >= 0.0);
            if (bundle.margin[i] < 0.0) {
                EXPECT_EQ(ray.status.fate, RayFate::clipped) << "off the hemisphere";
                continue;
            }
            ++passed;
            const double scale =
                (1.0 + std::abs(ray.sensor_point.x) + std::abs(ray.sensor_point.y)) /
                (ray.direction.z * ray.direction.z);
            ASSERT_NEAR(bundle.x_mm[i], ray.sensor_point.x, tolerance_mm * scale);
            ASSERT_NEAR(bundle.y_mm[i], ray.sensor_point.y, tolerance_mm * scale);
            ASSERT_NEAR(bundle.r_rel[i], ray.r_rel, tolerance_mm * (1.0 + ray.r_rel));
            const std::size_t last = static_cast<std::size_t>(bundle.stop_crossings) - 1;
            ASSERT_NEAR(bundle.stop_u_mm[last][i], ray.stop_point.x, 1e-8);
            ASSERT_NEAR(bundle.stop_v_mm[last][i], ray.stop_point.y, 1e-8);
            if (ray.weight > 1e-12) {
                ASSERT_NEAR(bundle.weight[i], ray.weight, weight_tolerance * ray.weight);
                ASSERT_NEAR(bundle.weight_average[i], ray.weight_average,
                            weight_tolerance * ray.weight_average);
            }
        }
    });
    EXPECT_GT(passed, 1000);
    EXPECT_GT(failed, 200);
}

TEST(Bundle, FloatLanesStayWithinATenthOfAPixel) {
    constexpr double tolerance_mm = 0.1 * 36.0 / 1280.0;
    constexpr double weight_tolerance = 1e-3;  // of the picture's; relative
    constexpr float clear_margin = 1e-3F;      // roots near 0 lose half of float's digits
    int compared = 0, far = 0;
    for_each_case([&](const OpticalSystem& system, const GhostPath& path, const BeamFrame& frame) {
        const Pupil pupil =
            find_pupil(system, trace_path<double>(system, path), frame, PupilSearch::quick);
        if (pupil.empty()) return;
        Bundle<float> single = random_bundle<float>(pupil.box, 64, 42);
        trace_bundle(trace_path<float>(system, path), frame, Weights::polarised, single);
        Bundle<double> precise;
        precise.u_mm.assign(single.u_mm.begin(), single.u_mm.end());
        precise.v_mm.assign(single.v_mm.begin(), single.v_mm.end());
        trace_bundle(trace_path<double>(system, path), frame, Weights::polarised, precise);
        for (std::size_t i = 0; i < single.size(); ++i) {
            if (precise.margin[i] < static_cast<double>(clear_margin) || precise.r_rel[i] > 1.0)
                continue;
            if (std::abs(precise.x_mm[i]) > 18.0 || std::abs(precise.y_mm[i]) > 12.0) continue;
            ++compared;
            EXPECT_GE(single.margin[i], 0.0F);
            far += std::abs(static_cast<double>(single.x_mm[i]) - precise.x_mm[i]) > tolerance_mm ||
                           std::abs(static_cast<double>(single.y_mm[i]) - precise.y_mm[i]) >
                               tolerance_mm
                       ? 1
                       : 0;
            // A weight near a zero of a reflectance is a difference: judged by the onset's scale.
            EXPECT_NEAR(static_cast<double>(single.weight[i]), precise.weight[i],
                        weight_tolerance * precise.weight[i] + 1e-8);
        }
    });
    EXPECT_GT(compared, 500);
    EXPECT_EQ(far, 0);
}

TEST(Bundle, EveryLengthOfBundleGivesTheSameRays) {
    // Rays are traced several packets at a time, the last ones alone, with other roundings.
    constexpr double rounding = 1e-12;
    const OpticalSystem system = compile(bundled("nikkor_z_14_30_f4_wide"), d_line_nm);
    const BeamFrame frame = beam_frame({9.0, 90.0});
    const TracePath<double> path = trace_path<double>(system, {{9, 3}});
    const PupilBox box{-6.0, 6.0, -6.0, 6.0};
    Bundle<double> whole = random_bundle<double>(box, 100, 43);
    trace_bundle(path, frame, Weights::polarised, whole);
    for (const std::size_t count :
         {std::size_t{1}, std::size_t{3}, std::size_t{16}, std::size_t{17}, std::size_t{63}}) {
        Bundle<double> part = random_bundle<double>(box, count, 43);
        trace_bundle(path, frame, Weights::polarised, part);
        ASSERT_EQ(part.size(), count);
        ASSERT_EQ(part.x_mm.size(), count);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_NEAR(part.x_mm[i], whole.x_mm[i], rounding * (1.0 + std::abs(whole.x_mm[i])));
            EXPECT_NEAR(part.weight[i], whole.weight[i], rounding);
            EXPECT_NEAR(part.margin[i], whole.margin[i], rounding);
        }
    }
    Bundle<double> none;
    trace_bundle(path, frame, Weights::polarised, none);
    EXPECT_EQ(none.size(), 0U);
}

TEST(Bundle, GeometryDoesNotDependOnTheWeights) {
    constexpr double rounding = 1e-12;  // mm, relative: the compiler may fuse differently
    const OpticalSystem system = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    const BeamFrame frame = beam_frame({9.0, 90.0});
    const TracePath<double> path = trace_path<double>(system, {{4, 2}});
    Bundle<double> none = random_bundle<double>({-9.0, 9.0, -9.0, 9.0}, 50, 44);
    Bundle<double> average = none, polarised = none;
    trace_bundle(path, frame, Weights::none, none);
    trace_bundle(path, frame, Weights::average, average);
    trace_bundle(path, frame, Weights::polarised, polarised);
    for (std::size_t i = 0; i < none.size(); ++i) {
        EXPECT_NEAR(none.x_mm[i], average.x_mm[i], rounding * (1 + std::abs(none.x_mm[i])));
        EXPECT_NEAR(none.y_mm[i], polarised.y_mm[i], rounding * (1 + std::abs(none.y_mm[i])));
        EXPECT_EQ(none.weight[i], 0.0);
        EXPECT_NEAR(average.weight[i], polarised.weight_average[i], rounding);
        for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
            EXPECT_GT(polarised.reflectance[k][i], 0.0);
            EXPECT_LE(polarised.reflectance[k][i], 1.0 + rounding);
        }
    }
}

TEST(Bundle, NothingIsEverNotANumber) {
    for (const char* file : lens_names) {
        const OpticalSystem system = compile(bundled(file), d_line_nm);
        for (const double field : {0.0, 60.0, 89.0, 90.0})
            for (const GhostPath& path : some_paths(system)) {
                const BeamFrame frame = beam_frame({field, 90.0});
                Bundle<float> bundle = random_bundle<float>({-60.0, 60.0, -60.0, 60.0}, 64, 46);
                trace_bundle(trace_path<float>(system, path), frame, Weights::polarised, bundle);
                for (std::size_t i = 0; i < bundle.size(); ++i)
                    ASSERT_TRUE(std::isfinite(bundle.x_mm[i]) && std::isfinite(bundle.y_mm[i]) &&
                                std::isfinite(bundle.weight[i]) &&
                                std::isfinite(bundle.margin[i]) && std::isfinite(bundle.r_rel[i]))
                        << file << name(path);
            }
    }
}

TEST(Bundle, FourReflectionsCrossTheStopUpToFiveTimes) {
    const OpticalSystem system = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    const GhostPath ghost{{7, 0, 6, 1}};
    const TracePath<double> path = trace_path<double>(system, ghost);
    ASSERT_EQ(path.stop_crossings, 5);
    const BeamFrame frame = beam_frame({0.0, 90.0});
    Bundle<double> bundle = random_bundle<double>({-0.5, 0.5, -0.5, 0.5}, 20, 47);
    trace_bundle(path, frame, Weights::polarised, bundle);
    for (std::size_t i = 0; i < bundle.size(); ++i) {
        const TracedRay ray =
            trace_ray(system, ghost, ray_of(frame, bundle.u_mm[i], bundle.v_mm[i]));
        if (!ray.status.reaches_sensor()) continue;
        EXPECT_NEAR(bundle.stop_u_mm[4][i], ray.stop_point.x, 1e-9);
        EXPECT_NEAR(bundle.weight[i], ray.weight, 1e-9 * ray.weight);
    }
}

}  // namespace
}  // namespace ghostlight
