// The reference and rays at random share only the trace of one ray: they must agree on every
// bundled lens, block by block, within the rays' scatter and the reference's stated error.
#include "core/flare/random_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/flare/reference_image.h"
#include "core/io/lens_file.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

/// One in two thousand of sound comparisons lies beyond; with eleven of them, one in 200 runs with
/// other seeds would fail. The seed is fixed.
constexpr double farthest_deviation = 3.3;

struct Compared {
    RandomRays rays;
    ReferenceImage reference;
};

Compared compared(const Prescription& lens, LightDirection light, std::size_t rays_per_ghost,
                  double tolerance) {
    constexpr int width_px = 160;
    RandomRaysRequest rays;
    rays.light = light;
    rays.width_px = width_px;
    rays.rays_per_ghost = rays_per_ghost;
    ReferenceRequest reference;
    reference.light = light;
    reference.width_px = width_px;
    reference.tolerance = tolerance;
    return {random_rays(lens, rays).value(), render_reference(lens, reference).value()};
}

RayAgreement agreement(const Compared& both, float scale = 1.0F) {
    std::vector<float> irradiance = both.reference.image.irradiance;
    for (float& value : irradiance) value *= scale;
    return agreement(both.rays, irradiance, both.reference.error);
}

TEST(RandomRays, AgreeWithTheReference) {
    const Compared both = compared(bundled("tessar_brendel_100_f2.8"), {8.0, 70.0}, 60'000, 0.005);
    const RayAgreement found = agreement(both);
    EXPECT_GT(found.blocks, 40U);
    EXPECT_LE(std::abs(found.deviation), farthest_deviation) << "chi² " << found.chi2;
    EXPECT_NEAR(found.flux_ratio, 1.0, 3.0 * found.flux_ratio_sigma + 0.005);
    EXPECT_LE(found.share_of_picture_error, 0.5) << "the rays have to be what decides";
}

TEST(RandomRays, DisagreeWithAWrongPicture) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    Compared both = compared(lens, {8.0, 70.0}, 60'000, 0.005);
    EXPECT_GT(agreement(both, 1.05F).deviation, farthest_deviation) << "5 % too bright";
    ReferenceRequest lesser;
    lesser.light = {8.0, 70.0};
    lesser.width_px = 160;
    lesser.weights = WeightModel::reflections_only;
    both.reference = render_reference(lens, lesser).value();
    EXPECT_GT(agreement(both).deviation, farthest_deviation) << "transmissions left out";
}

TEST(RandomRays, AreTheSameForAnyNumberOfThreads) {
    RandomRaysRequest request;
    request.light = {5.0, 90.0};
    request.rays_per_ghost = 3000;
    request.threads = 1;
    const RandomRays one = random_rays(bundled("cooke_triplet_50_f5"), request).value();
    request.threads = 3;
    const RandomRays many = random_rays(bundled("cooke_triplet_50_f5"), request).value();
    EXPECT_EQ(one.flux_mm2, many.flux_mm2);
    EXPECT_EQ(one.variance_mm4, many.variance_mm4);
}

TEST(RandomRaysSlow, AgreeWithTheReferenceOnEveryBundledLens) {
    for (const BundledLens& each : bundled_lenses()) {
        const Prescription lens = read_lens(each.file).lens;
        const std::size_t ghosts = two_reflection_ghosts(compile(lens, d_line_nm)).size();
        const double field_deg =
            0.4 * deg_from_rad(std::atan(0.5 * lens.sensor.width_mm /
                                         lens.published.efl_mm.value_or(lens.sensor.width_mm)));
        const Compared both = compared(lens, {field_deg, 90.0}, 800'000 / ghosts, 0.04);
        const RayAgreement found = agreement(both);
        EXPECT_GT(found.blocks, 5U) << lens.name;
        EXPECT_LE(found.deviation, farthest_deviation)
            << lens.name << ": chi² " << found.chi2 << " of " << found.blocks << " blocks";
        EXPECT_NEAR(found.flux_ratio, 1.0, 3.5 * found.flux_ratio_sigma + 0.04) << lens.name;
    }
}

}  // namespace
}  // namespace ghostlight
