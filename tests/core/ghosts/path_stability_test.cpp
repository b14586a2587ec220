#include "core/ghosts/path_stability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/ghosts/bundle.h"
#include "core/ghosts/pupil.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

glm::dvec2 landing(const OpticalSystem& system, const GhostPath& path, const BeamFrame& frame,
                   double u_mm, double v_mm) {
    const TracedRay ray =
        trace_ray(system, path, {u_mm * frame.e1 + v_mm * frame.e2, frame.direction});
    return {ray.sensor_point.x, ray.sensor_point.y};
}

TEST(RayCondition, HasTheDerivativesOfFiniteDifferences) {
    constexpr double step_mm = 1e-4;
    for (const char* file : {"tessar_brendel_100_f2.8", "nikkor_z_58_f0.95_noct"}) {
        const OpticalSystem system = compile(bundled(file), d_line_nm);
        const BeamFrame frame = beam_frame({6.0, 65.0});
        for (const GhostPath& path : {GhostPath{}, GhostPath{{3, 1}}, GhostPath{{6, 2}}}) {
            const double u = 0.3, v = -0.2;
            const RayCondition found = ray_condition(system, path, frame, u, v);
            ASSERT_TRUE(found.valid);
            const glm::dvec2 by_u = (landing(system, path, frame, u + step_mm, v) -
                                     landing(system, path, frame, u - step_mm, v)) /
                                    (2.0 * step_mm);
            const glm::dvec2 by_v = (landing(system, path, frame, u, v + step_mm) -
                                     landing(system, path, frame, u, v - step_mm)) /
                                    (2.0 * step_mm);
            // Rounding over the step, and the third derivative times its square.
            const double tolerance = 1e-6 * (1.0 + std::abs(by_u.x) + std::abs(by_v.y));
            EXPECT_NEAR(found.by_entrance[0], by_u.x, tolerance) << file << name(path);
            EXPECT_NEAR(found.by_entrance[1], by_v.x, tolerance) << file << name(path);
            EXPECT_NEAR(found.by_entrance[2], by_u.y, tolerance) << file << name(path);
            EXPECT_NEAR(found.by_entrance[3], by_v.y, tolerance) << file << name(path);
        }
    }
}

/// A plane of gaps alone: rounding of a direction moves the ray by the way it has still to go.
TEST(RayCondition, OfFreeFlightIsTheWayThatIsLeft) {
    constexpr double gap_mm = 1000.0;
    const OpticalSystem system = compile(lens_of({row(0.0, gap_mm, 1.0)}), d_line_nm);
    const RayCondition found = ray_condition(system, {}, beam_frame({0.0, 90.0}), 0.0, 0.0);
    ASSERT_TRUE(found.valid);
    // Two directions of size 1, each by the gap; the sensor point itself is 0.
    EXPECT_NEAR(found.amplification_mm, std::sqrt(2.0) * gap_mm, 1e-9 * gap_mm);
}

TEST(PathStability, PredictsWhatSinglePrecisionLoses) {
    // The prediction is for independent roundings of size 1/2 ulp at one place each; a meeting
    // makes some ten. Worst over a thousand rays is a few deviations.
    constexpr double most = 12.0, least = 0.02;
    for (const char* file : {"tessar_brendel_100_f2.8", "canon_zoom_70_200_f2.8"}) {
        const Prescription lens = bundled(file);
        const OpticalSystem system = compile(lens, d_line_nm);
        std::vector<GhostPath> paths = two_reflection_ghosts(system);
        if (paths.size() > 60) paths.resize(60);
        const auto found = stability_of(system, {5.0, 90.0}, paths);
        ASSERT_TRUE(found.has_value());
        std::size_t compared = 0;
        for (const PathStability& ghost : *found) {
            if (ghost.landed < 20) continue;  // too few for a worst one
            ++compared;
            const double predicted_mm = float_rounding * ghost.amplification_mm;
            EXPECT_LE(ghost.position_worst_mm, most * predicted_mm) << file << name(ghost.path);
            EXPECT_GE(ghost.position_worst_mm, least * predicted_mm) << file << name(ghost.path);
            EXPECT_LE(ghost.weight_rms, 1e-4) << file << name(ghost.path);
        }
        EXPECT_GT(compared, 10U);
    }
}

TEST(PathStability, FindsAnIllConditionedGhost) {
    // The plate's ghost after ten metres: a direction's last digit is a tenth of a pixel there.
    Prescription lens = lens_of({row(0.0, 5.0, 1.5, 5.0), row(0.0, 1e5, 1.0, 5.0)}, 0);
    lens.sensor.width_mm = 36.0;
    const OpticalSystem system = compile(lens, d_line_nm);
    const auto found = stability_of(system, {0.0, 90.0}, two_reflection_ghosts(system));
    ASSERT_EQ(found->size(), 1U);
    EXPECT_TRUE(is_ill_conditioned(found->front(), 36.0));
    lens.surfaces.back().thickness_mm = 50.0;
    const OpticalSystem near = compile(lens, d_line_nm);
    EXPECT_FALSE(is_ill_conditioned(
        stability_of(near, {0.0, 90.0}, two_reflection_ghosts(near))->front(), 36.0));
}

TEST(PathStability, AveragingCostsWhatFresnelSays) {
    constexpr double n = 1.6, field_deg = 45.0;
    const Prescription lens = lens_of({row(0.0, 2.0, n, 30.0), row(0.0, 5.0, 1.0, 30.0)}, 0);
    const OpticalSystem system = compile(lens, d_line_nm);
    const auto found = stability_of(system, {field_deg, 20.0}, two_reflection_ghosts(system));
    const double theta = rad_from_deg(field_deg), inside = std::asin(std::sin(theta) / n);
    const double rs = std::pow(std::sin(theta - inside) / std::sin(theta + inside), 2);
    const double rp = std::pow(std::tan(theta - inside) / std::tan(theta + inside), 2);
    const double r = 0.5 * (rs + rp);
    const double carried = 0.5 * (std::pow(rs * (1.0 - rs), 2) + std::pow(rp * (1.0 - rp), 2));
    EXPECT_NEAR(found->front().averaging_error, std::pow(r * (1.0 - r), 2) / carried - 1.0, 1e-12);
}

}  // namespace
}  // namespace ghostlight
