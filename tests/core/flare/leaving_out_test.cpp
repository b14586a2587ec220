// Ghosts that are left out by a bound, and searches that begin with a plan for a light nearby:
// against the ghost table, whose quadrature knows nothing of either.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "core/flare/planned_flare.h"
#include "core/flare/planned_ghost.h"
#include "core/ghosts/ghost_table.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double table_tolerance = 0.05;

/// Rows of the table by the path's name.
std::map<std::string, GhostRow> rows_of(const Prescription& lens, const LightDirection& light) {
    GhostTableRequest request{
        .light = light, .tolerance = table_tolerance, .peaks = false, .threads = 0};
    std::map<std::string, GhostRow> rows;
    const GhostTable table = ghost_table(lens, request).value();
    for (const GhostRow& row : table.ghosts) rows[name(row.path, table.surface_count)] = row;
    return rows;
}

TEST(LeavingOut, ABoundIsAboveTheGhostsFlux) {
    for (const auto& [file, field_deg] : {std::pair{"tessar_brendel_100_f2.8", 12.0},
                                          {"double_gauss_tronnier_100_f2", 0.0},
                                          {"heliar_tronnier_100", 9.0}}) {
        const Prescription lens = bundled(file);
        const LightDirection light{field_deg, 90.0};
        const auto rows = rows_of(lens, light);
        const FlareScene scene = flare_scene(lens, Monochromatic{});
        const PixelFrame pixels =
            pixel_frame(scene.system().sensor_width_mm, scene.system().sensor_height_mm, 320);
        const GhostPlanner planner(scene, light, pixels);
        for (const GhostPath& path : scene.ghosts) {
            const std::string ghost = name(path, lens.surfaces.size());
            const PlannedGhost planned = planner.find(path).planned;
            EXPECT_GE(planned.bound_mm2, (1.0 - table_tolerance) * rows.at(ghost).flux_mm2)
                << file << " " << ghost;
        }
    }
}

TEST(LeavingOut, StaysUnderItsShareOfTheTolerance) {
    const Prescription lens = bundled("nikon_zoom_80_200_f2.8");
    FlareRequest request;
    request.light = {4.0, 90.0};
    request.tolerance = 0.2;
    request.width_px = 320;
    const FlareScene scene = flare_scene(lens, request.spectrum);
    const FlarePlan plan = render_planned(scene, request).value().plan;
    ASSERT_GT(plan.count(GhostFate::left_out), 0U);
    EXPECT_LE(plan.left_out_mm2, 0.1 * request.tolerance * plan.flux_mm2);
    const auto rows = rows_of(lens, request.light);
    double bounds_mm2 = 0.0, fluxes_mm2 = 0.0;
    GhostPath one;
    for (const PlannedGhost& ghost : plan.ghosts) {
        if (ghost.fate != GhostFate::left_out) continue;
        one = ghost.path;
        bounds_mm2 += ghost.bound_mm2;
        fluxes_mm2 += rows.at(name(ghost.path, lens.surfaces.size())).flux_mm2;
    }
    EXPECT_DOUBLE_EQ(bounds_mm2, plan.left_out_mm2);
    EXPECT_LE((1.0 - table_tolerance) * fluxes_mm2, plan.left_out_mm2);
    EXPECT_GE(plan.estimated_error(), plan.left_out_share());

    request.highlighted = {one};  // what is chosen is drawn
    const FlarePlan chosen = render_planned(scene, request).value().plan;
    for (const PlannedGhost& ghost : chosen.ghosts) {
        if (ghost.path != one) continue;
        EXPECT_NE(ghost.fate, GhostFate::left_out);
    }
}

TEST(LeavingOut, MomentsAreThoseOfTheTable) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    const LightDirection light{10.0, 40.0};
    const auto rows = rows_of(lens, light);
    const FlareScene scene = flare_scene(lens, Monochromatic{});
    const PixelFrame pixels = pixel_frame(36.0, 24.0, 320);
    const GhostPlanner planner(scene, light, pixels);
    // Nodes of 12 × 12 cells inside or outside of the rim: a tenth of the radius.
    constexpr double share = 0.1;
    int compared = 0;
    for (const GhostPath& path : scene.ghosts) {
        const PlannedGhost planned = planner.probe(path).planned;
        const GhostRow& row = rows.at(name(path, lens.surfaces.size()));
        if (planned.fate == GhostFate::nothing_passes) continue;
        const GhostSpot& moments = planned.spot;
        const double radius = std::sqrt(moments.xx_mm2 + moments.yy_mm2);
        EXPECT_NEAR(radius, row.rms_radius_mm, share * row.rms_radius_mm) << name(path, 99);
        EXPECT_NEAR(moments.x_mm, row.centroid_x_mm, share * row.rms_radius_mm);
        EXPECT_NEAR(moments.y_mm, row.centroid_y_mm, share * row.rms_radius_mm);
        ++compared;
    }
    EXPECT_GT(compared, 10);
}

struct NearbyPlan : testing::Test {
    Prescription lens = bundled("nikon_zoom_80_200_f2.8");
    FlareScene scene = flare_scene(lens, Monochromatic{});
    FlareRequest request;
    NearbyPlan() {
        request.light = {4.0, 90.0};
        request.tolerance = 0.04;
        request.width_px = 320;
        request.search = ProbeSearch::quick;
    }
    FlareImage drawn() const { return render_planned(scene, request).value(); }
};

TEST_F(NearbyPlan, FindsTheLightWithFewerRays) {
    request.nearby = std::make_shared<const FlarePlan>(drawn().plan);
    for (int k = 1; k <= 8; ++k) {  // a light that is dragged
        request.light.field_deg = 4.0 + 0.1 * k;
        request.turn = k;
        const FlareImage after = drawn();
        request.nearby = std::make_shared<const FlarePlan>(after.plan);
        FlareRequest alone = request;
        alone.nearby = nullptr;
        const FlareImage truth = render_planned(scene, alone).value();
        EXPECT_LT(after.rays, truth.rays);
        // Probes differ by their boxes, by what a tolerance of 4 % lets them.
        EXPECT_NEAR(after.flux_on_sensor_mm2, truth.flux_on_sensor_mm2,
                    0.01 * truth.flux_on_sensor_mm2);
    }
}

TEST_F(NearbyPlan, APlanThatIsWrongIsNotFollowed) {
    const FlareImage truth = drawn();
    FlarePlan wrong = truth.plan;
    for (PlannedGhost& ghost : wrong.ghosts) {
        if (ghost.fate == GhostFate::nothing_passes) continue;
        PupilBox& box = ghost.look.box;  // only a corner of it
        box.u1_mm *= 0.2;
        box.u0_mm = -box.u1_mm;
        box.v1_mm = box.v0_mm + 0.2 * (box.v1_mm - box.v0_mm);
    }
    request.nearby = std::make_shared<const FlarePlan>(wrong);
    const FlareImage found = drawn();
    EXPECT_NEAR(found.flux_on_sensor_mm2, truth.flux_on_sensor_mm2,
                0.01 * truth.flux_on_sensor_mm2);
    wrong.ghosts.pop_back();  // of another lens
    for (PlannedGhost& ghost : wrong.ghosts) ghost.path.reflections.clear();
    request.nearby = std::make_shared<const FlarePlan>(wrong);
    EXPECT_EQ(drawn().irradiance, truth.irradiance);
}

}  // namespace
}  // namespace ghostlight
