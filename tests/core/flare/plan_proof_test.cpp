#include "core/flare/plan_proof.h"

#include <gtest/gtest.h>

#include <atomic>

#include "core/flare/ghost_mesh.h"
#include "core/flare/planned_ghost.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

FlarePlan plan_of(const FlareScene& scene, const LightDirection& light) {
    const OpticalSystem& system = scene.system();
    const PixelFrame pixels = pixel_frame(system.sensor_width_mm, system.sensor_height_mm, 640);
    const GhostPlanner planner(scene, light, pixels);
    FlarePlan plan;
    for (const GhostPath& path : scene.ghosts) {
        plan.ghosts.push_back(planner.probe(path).planned);
        plan.flux_mm2 += plan.ghosts.back().flux_mm2;
    }
    return plan;
}

TEST(PlanProof, CertifiesATripletWhole) {
    const FlareScene scene =
        flare_scene(bundled("cooke_triplet_50_f5"), Monochromatic{d_line_nm}, 1, 1);
    const LightDirection light{8.0, 0.0};
    const FlarePlan plan = plan_of(scene, light);
    std::atomic<int> reports{0};
    const auto proof =
        certify(scene, light, plan, {.most_cells = 20000}, {}, [&](double) { ++reports; });
    ASSERT_TRUE(proof);
    EXPECT_EQ(reports, static_cast<int>(plan.ghosts.size()));
    EXPECT_EQ(proof->certified, plan.ghosts.size());
    EXPECT_LE(proof->missed_share(), 1e-3);
}

TEST(PlanProof, AClaimThatIsTooSmallIsNotCertified) {
    const FlareScene scene =
        flare_scene(bundled("cooke_triplet_50_f5"), Monochromatic{d_line_nm}, 1, 1);
    const LightDirection light{8.0, 90.0};
    FlarePlan plan = plan_of(scene, light);
    std::size_t brightest = 0;
    for (std::size_t g = 0; g < plan.ghosts.size(); ++g)
        if (plan.ghosts[g].flux_mm2 > plan.ghosts[brightest].flux_mm2) brightest = g;
    plan.ghosts[brightest].fate = GhostFate::nothing_passes;
    const auto proof = certify(scene, light, plan, {.most_cells = 2000});
    ASSERT_TRUE(proof);
    EXPECT_FALSE(proof->ghosts[brightest].certified);
    EXPECT_GE(proof->missed_flux_bound_mm2, plan.ghosts[brightest].flux_mm2);
}

TEST(PlanProof, IsTheSameForAnyNumberOfThreadsAndCanBeStopped) {
    const FlareScene scene =
        flare_scene(bundled("tessar_brendel_100_f2.8"), Monochromatic{d_line_nm}, 1, 1);
    const LightDirection light{10.0, 90.0};
    const FlarePlan plan = plan_of(scene, light);
    const auto one = certify(scene, light, plan, {.most_cells = 300, .threads = 1});
    const auto many = certify(scene, light, plan, {.most_cells = 300, .threads = 3});
    ASSERT_TRUE(one && many);
    EXPECT_EQ(one->missed_flux_bound_mm2, many->missed_flux_bound_mm2);
    EXPECT_EQ(one->certified, many->certified);
    std::stop_source source;
    source.request_stop();
    EXPECT_FALSE(certify(scene, light, plan, {}, source.get_token()));
}

}  // namespace
}  // namespace ghostlight
