#include "core/ghosts/ghost_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

/// Of all ghosts' light on the sensor, at any stop: what the boxes of a picture may leave out.
constexpr double missed_share = 1e-3;
constexpr int probe_cells = 12;

struct Light {
    double all_mm2 = 0.0, missed_mm2 = 0.0;
};

/// Light on the sensor by the thorough search's cells, four rays each, and what of it lies outside
/// the probe's box.
Light light_of(const OpticalSystem& system, const GhostPath& ghost, const BeamFrame& frame) {
    constexpr int rays_across = 2;
    const auto path = trace_path<double>(system, ghost);
    const Pupil pupil = find_pupil(system, path, frame, PupilSearch::thorough);
    Light light;
    if (pupil.empty()) return light;
    const PupilBox& whole = pupil.entrance;
    const double du = (whole.u1_mm - whole.u0_mm) / pupil.across;
    const double dv = (whole.v1_mm - whole.v0_mm) / pupil.across;
    Bundle<double> rays;
    for (const PupilCell& cell : pupil.cells)
        for (int k = 0; k < rays_across * rays_across; ++k) {
            const double i = cell.i + (k % rays_across + 0.5) / rays_across;
            const double j = cell.j + (k / rays_across + 0.5) / rays_across;
            rays.u_mm.push_back(whole.u0_mm + du * i);
            rays.v_mm.push_back(whole.v0_mm + dv * j);
        }
    trace_bundle(path, frame, Weights::average, rays);
    const GhostProbe probe = probe_ghost(system, trace_path<float>(system, ghost), frame,
                                         entrance_box(system, frame), probe_cells);
    const PupilBox& box = probe.grid.box;
    const double radius = system.stop_mask.semi_diameter_mm;
    for (std::size_t n = 0; n < rays.size(); ++n) {
        bool passes = rays.margin[n] >= 0.0 && rays.r_rel[n] <= 1.0 &&
                      std::abs(rays.x_mm[n]) <= 0.5 * system.sensor_width_mm &&
                      std::abs(rays.y_mm[n]) <= 0.5 * system.sensor_height_mm;
        for (std::size_t k = 0; k < static_cast<std::size_t>(rays.stop_crossings); ++k)
            passes = passes && std::hypot(rays.stop_u_mm[k][n], rays.stop_v_mm[k][n]) <= radius;
        if (!passes) continue;
        const double flux = rays.weight_average[n] * du * dv / (rays_across * rays_across);
        const bool inside = !probe.empty && std::abs(rays.u_mm[n]) <= box.u1_mm &&
                            rays.v_mm[n] >= box.v0_mm && rays.v_mm[n] <= box.v1_mm;
        light.all_mm2 += flux;
        light.missed_mm2 += inside ? 0.0 : flux;
    }
    return light;
}

struct Case {
    std::string lens;
    double field_deg, stop_share;
};

TEST(GhostProbe, BoxesHoldTheLightAtAnyStop) {
    // Where it was hardest: thin crescents between failing rays, islands, small stops.
    const std::vector<Case> cases = {
        {"fisheye_nikkor_10.5_f2.8", 40.0, 1.0}, {"fisheye_nikkor_10.5_f2.8", 40.0, 0.1},
        {"fisheye_nikkor_10.5_f2.8", 80.0, 0.5}, {"nikkor_z_14_30_f4_wide", 0.0, 0.1},
        {"nikkor_z_14_30_f4_wide", 50.0, 0.25},  {"double_gauss_tronnier_100_f2", 11.0, 0.1},
        {"tessar_brendel_100_f2.8", 22.0, 0.25}, {"heliar_tronnier_100", 0.0, 0.5}};
    for (const Case& c : cases) {
        OpticalSystem system = compile(bundled(c.lens), d_line_nm);
        system.stop_mask.semi_diameter_mm *= c.stop_share;
        const BeamFrame frame = beam_frame({c.field_deg, 90.0});
        Light light;
        for (const GhostPath& ghost : two_reflection_ghosts(system)) {
            const Light own = light_of(system, ghost, frame);
            light.all_mm2 += own.all_mm2;
            light.missed_mm2 += own.missed_mm2;
        }
        EXPECT_GT(light.all_mm2, 0.0) << c.lens;
        EXPECT_LE(light.missed_mm2, missed_share * light.all_mm2)
            << c.lens << " at " << c.field_deg << " deg, stop x " << c.stop_share;
    }
}

TEST(GhostProbe, HalfTheBeamsCellsFindWhatTheQuickSearchMisses) {
    // Ghost 11-5 of the fisheye at 40 degrees: a crescent 0.8 mm wide in an entrance of 52 mm.
    const OpticalSystem system = compile(bundled("fisheye_nikkor_10.5_f2.8"), d_line_nm);
    const BeamFrame frame = beam_frame({40.0, 90.0});
    const auto path = trace_path<float>(system, parse_ghost("11-5", system));
    EXPECT_TRUE(find_pupil(system, path, frame, PupilSearch::quick).empty());
    const Pupil half = find_pupil(system, path, frame, PupilSearch::beside_failing);
    const Pupil thorough = find_pupil(system, path, frame, PupilSearch::thorough);
    ASSERT_FALSE(half.empty());
    EXPECT_LT(half.rays, thorough.rays / 2);
    EXPECT_LE(half.box.v0_mm, -8.2);
    EXPECT_GE(half.box.v1_mm, -8.6);
}

}  // namespace
}  // namespace ghostlight
