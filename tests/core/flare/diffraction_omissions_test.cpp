#include "core/flare/diffraction_omissions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/flare/fresnel.h"
#include "core/flare/planned_flare.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(DiffractionOmissions, AShadowTakesWhatAStraightEdgeGives) {
    // Light in the geometric shadow of a straight edge, integrated: what fringes_change() is made
    // of. Beyond w it falls as 1/(2π² w²), which leaves 1/(2π² w).
    constexpr double far = 30.0, step = 1e-3;
    double shadow = 1.0 / (2.0 * std::numbers::pi * std::numbers::pi * far);
    for (double w = 0.5 * step; w < far; w += step) {
        const auto f = fresnel_integrals(w);
        shadow += step * 0.5 * (std::pow(0.5 - f.c, 2) + std::pow(0.5 - f.s, 2));
    }
    GhostSpot disc;  // of radius 2, whose rim is 1 of its area
    disc.xx_mm2 = disc.yy_mm2 = 1.0;
    constexpr double width_mm = 0.01;
    // In the shadow, and missing from the lit side.
    EXPECT_NEAR(fringes_change(disc, width_mm), 2.0 * shadow * width_mm, 1e-4 * width_mm);
}

TEST(DiffractionOmissions, AnAiryDiscHoldsItsPublishedShares) {
    // Born and Wolf, table 8.2: 83.8 and 91.0 % within the first two dark rings.
    EXPECT_NEAR(beyond_airy(3.8317), 1.0 - 0.838, 5e-4);
    EXPECT_NEAR(beyond_airy(7.0156), 1.0 - 0.910, 5e-4);
    EXPECT_DOUBLE_EQ(beyond_airy(0.0), 1.0);
}

TEST(DiffractionOmissions, TheStarburstIsSizedByTheFNumber) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    const FlareScene scene = flare_scene(lens, Monochromatic{});
    FlareRequest request;
    request.width_px = 320;
    auto starburst = [&] {
        const auto rows =
            diffraction_omissions(scene, request, render_planned(scene, request)->plan);
        EXPECT_EQ(rows.back().what, "the starburst");
        return rows.back().why;
    };
    request.light = {5.0, 90.0};
    EXPECT_NE(starburst().find("pixels out"), std::string::npos) << starburst();
    request.light = {30.0, 90.0};
    EXPECT_NE(starburst().find("beside the sensor"), std::string::npos) << starburst();
}

TEST(DiffractionOmissions, RingingLeavesOutOnlyWhatAPixelHides) {
    const Prescription lens = bundled("nikon_zoom_80_200_f2.8");
    const FlareScene scene = flare_scene(lens, Monochromatic{});
    FlareRequest request;
    request.light = {5.0, 90.0};
    request.width_px = 320;
    const FlarePlan plan = render_planned(scene, request)->plan;
    const auto without = diffraction_omissions(scene, request, plan);
    request.ringing = true;
    const auto with = diffraction_omissions(scene, request, plan);
    ASSERT_EQ(without.size(), 2u);
    EXPECT_EQ(without.front().ghosts, plan.count(GhostFate::drawn));
    ASSERT_EQ(with.size(), 2u);
    EXPECT_LT(with.front().ghosts, without.front().ghosts) << "broad ones are drawn";
    EXPECT_LT(*with.front().bound_mm2, *without.front().bound_mm2);
}

}  // namespace
}  // namespace ghostlight
