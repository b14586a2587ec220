#include "core/flare/extended_flare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/flare/light.h"
#include "core/flare/planned_flare.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

/// Σ|a − b| / Σ b of the irradiance.
double relative_l1(const FlareImage& a, const FlareImage& b) {
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < a.irradiance.size(); ++i) {
        difference += std::abs(static_cast<double>(a.irradiance[i] - b.irradiance[i]));
        sum += static_cast<double>(b.irradiance[i]);
    }
    return difference / sum;
}

/// Closed to f/16, ghosts are small and show the light's shape.
Prescription closed(const std::string& lens) {
    Prescription at = bundled(lens);
    at.stop.semi_diameter_mm.reset();
    at.stop.f_number = 16.0;
    return at;
}

FlareRequest request_at(double field_deg, double azimuth_deg, int width_px = 320) {
    FlareRequest request;
    request.light = {field_deg, azimuth_deg};
    request.spectrum = Monochromatic{};
    request.tolerance = 0.01;
    request.width_px = width_px;
    return request;
}

/// The mean of point lights' pictures over a disc, on rings of equal areas.
FlareImage mean_over_disc(const FlareScene& scene, const FlareRequest& request, double radius_rad,
                          int rings, int around) {
    std::optional<FlareImage> mean;
    const double share = 1.0 / (rings * around);
    for (int ring = 0; ring < rings; ++ring)
        for (int k = 0; k < around; ++k) {
            const double r = radius_rad * std::sqrt((ring + 0.5) / rings);
            const double angle = 2.0 * std::numbers::pi * (k + 0.5 * (ring % 2)) / around;
            FlareRequest one = request;
            one.light = offset_light(request.light, r * std::cos(angle), r * std::sin(angle));
            const FlareImage image = *render_planned(scene, one);
            if (!mean) {
                mean = image;
                std::ranges::fill(mean->rgb, 0.0F);
                std::ranges::fill(mean->irradiance, 0.0F);
                mean->flux_mm2 = mean->flux_on_sensor_mm2 = 0.0;
            }
            add_image(*mean, image, {share, share, share, share});
        }
    return *mean;
}

TEST(ExtendedFlareSlow, ASunIsTheMeanOfPointsOverItsDisc) {
    // Points leave dots that the disc has not; both pictures' own errors; folding's second order.
    constexpr double tolerance = 0.06;
    // A lens whose ghosts move far against their size.
    const FlareScene scene = flare_scene(closed("double_gauss_tronnier_100_f2"), Monochromatic{});
    const FlareRequest request = request_at(6.0, 30.0, 200);
    const FlareImage points =
        mean_over_disc(scene, request, 0.5 * sun_diameter_deg * std::numbers::pi / 180.0, 6, 14);
    const FlareImage point = *render_planned(scene, request);
    const FlareImage sun = *render_extended(scene, request, disc_pattern(sun_diameter_deg), {});
    EXPECT_LT(relative_l1(sun, points), tolerance);
    // The test can fail: a point's flare is not the sun's.
    EXPECT_GT(relative_l1(point, points), 2.0 * tolerance);
    EXPECT_NEAR(sun.flux_on_sensor_mm2 / points.flux_on_sensor_mm2, 1.0, 0.02);
}

TEST(ExtendedFlareSlow, ABroadLightIsSampledWhereFoldingWouldNotServe) {
    const FlareScene scene = flare_scene(bundled("tessar_brendel_100_f2.8"), Monochromatic{});
    const FlareRequest request = request_at(6.0, 60.0, 160);
    constexpr double diameter_deg = 6.0;
    const FlareImage points =
        mean_over_disc(scene, request, 0.5 * diameter_deg * std::numbers::pi / 180.0, 7, 14);
    const FlareImage disc = *render_extended(scene, request, disc_pattern(diameter_deg), {});
    EXPECT_LT(relative_l1(disc, points), 0.12);
    EXPECT_NEAR(disc.flux_on_sensor_mm2 / points.flux_on_sensor_mm2, 1.0, 0.03);
}

TEST(ExtendedFlare, APointWithoutChangesIsThePlannedPicture) {
    const FlareScene scene = flare_scene(bundled("cooke_triplet_50_f5"), Monochromatic{});
    const FlareRequest request = request_at(8.0, 70.0);
    const FlareImage planned = *render_planned(scene, request);
    const FlareImage same = *render_extended(scene, request, {}, {});
    // The same meshes and levels; sums in another order.
    EXPECT_LT(relative_l1(same, planned), 1e-5);
}

TEST(ExtendedFlare, DoesNotDependOnThreads) {
    const FlareScene scene = flare_scene(bundled("cooke_triplet_50_f5"), StandardLight{});
    FlareRequest request = request_at(8.0, 70.0, 200);
    Artistic artistic;
    artistic.jitter_mm = 0.5;
    request.threads = 1;
    const FlareImage one = *render_extended(scene, request, disc_pattern(1.0), artistic);
    request.threads = 3;
    const FlareImage three = *render_extended(scene, request, disc_pattern(1.0), artistic);
    EXPECT_EQ(one.rgb, three.rgb);
    EXPECT_EQ(one.irradiance, three.irradiance);
}

TEST(ExtendedFlare, AnArtistsGainTintAndSwitch) {
    const FlareScene scene = flare_scene(bundled("cooke_triplet_50_f5"), Monochromatic{});
    FlareRequest request = request_at(8.0, 70.0);
    const FlareImage all = *render_planned(scene, request);
    // The brightest ghost on the sensor.
    const auto brightest =
        std::ranges::max_element(all.plan.ghosts, {}, &PlannedGhost::flux_mm2)->path;
    Artistic off;
    off.ghosts = {{.path = brightest, .on = false}};
    const FlareImage without = *render_extended(scene, request, {}, off);
    Artistic doubled;
    doubled.ghosts = {{.path = brightest, .gain_ev = 1.0, .tint = {1.0, 0.5, 0.0}}};
    const FlareImage tinted = *render_extended(scene, request, {}, doubled);
    double off_by = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < all.irradiance.size(); ++i) {
        const double own = static_cast<double>(all.irradiance[i] - without.irradiance[i]);
        sum += own;
        // Twice the light in red, as much in green, none in blue.
        for (std::size_t c = 0; c < 3; ++c)
            off_by += std::abs(static_cast<double>(tinted.rgb[3 * i + c] - without.rgb[3 * i + c]) -
                               (2.0 - static_cast<double>(c)) * own);
    }
    EXPECT_GT(sum, 0.0);
    // Allowances are shared out anew without it: the picture's own tolerance.
    EXPECT_LT(off_by / sum, 0.05);
}

TEST(ExtendedFlare, AnOffsetMovesAGhost) {
    const FlareScene scene = flare_scene(closed("cooke_triplet_50_f5"), Monochromatic{});
    FlareRequest request = request_at(2.0, 90.0);
    const auto moments = ghost_spots(scene, scene.ghosts, request);
    std::size_t inner = scene.ghosts.size();  // one that lies well inside
    for (std::size_t g = 0; g < moments->size(); ++g) {
        const GhostSpot& m = (*moments)[g];
        if (m.flux() > 0.0 && std::abs(m.y_mm) < 5.0 && m.sigmas_mm()[1] < 1.5) inner = g;
    }
    ASSERT_LT(inner, scene.ghosts.size());
    request.only = {scene.ghosts[inner]};
    const auto centroid = [](const FlareImage& image) {
        double x = 0.0, y = 0.0, sum = 0.0;
        const PixelFrame frame = pixel_frame(36.0, 24.0, image.width_px);
        for (int row = 0; row < image.height_px; ++row)
            for (int column = 0; column < image.width_px; ++column) {
                const double value = static_cast<double>(
                    image.irradiance[static_cast<std::size_t>(row * image.width_px + column)]);
                sum += value;
                x += value * (frame.left_mm + (column + 0.5) * frame.pitch_mm);
                y += value * (frame.bottom_mm + (row + 0.5) * frame.pitch_mm);
            }
        return std::array{x / sum, y / sum};
    };
    const auto before = centroid(*render_extended(scene, request, {}, {}));
    Artistic moved;
    moved.ghosts = {{.path = scene.ghosts[inner], .offset_x_mm = 2.5, .offset_y_mm = -1.25}};
    const auto after = centroid(*render_extended(scene, request, {}, moved));
    // Half a pixel of a picture that may be drawn small.
    EXPECT_NEAR(after[0] - before[0], 2.5, 0.06);
    EXPECT_NEAR(after[1] - before[1], -1.25, 0.06);
}

TEST(GhostSpot, AreThoseOfThePicture) {
    const FlareScene scene = flare_scene(closed("cooke_triplet_50_f5"), Monochromatic{});
    FlareRequest request = request_at(3.0, 40.0, 640);
    const auto moments = ghost_spots(scene, scene.ghosts, request);
    int compared = 0;
    for (std::size_t g = 0; g < scene.ghosts.size(); ++g) {
        const GhostSpot& m = (*moments)[g];
        // Wholly on the sensor.
        const double reach = 3.0 * m.sigmas_mm()[1];
        if (!(m.flux() > 0.0) || std::abs(m.x_mm) + reach > 18.0 || std::abs(m.y_mm) + reach > 12.0)
            continue;
        request.only = {scene.ghosts[g]};
        request.tolerance = 0.002;
        const FlareImage image = *render_planned(scene, request);
        const PixelFrame frame = pixel_frame(36.0, 24.0, 640);
        double sum = 0.0, x = 0.0, xx = 0.0;
        for (int row = 0; row < image.height_px; ++row)
            for (int column = 0; column < image.width_px; ++column) {
                const double value = static_cast<double>(
                    image.irradiance[static_cast<std::size_t>(row * image.width_px + column)]);
                const double at = frame.left_mm + (column + 0.5) * frame.pitch_mm;
                sum += value;
                x += value * at;
                xx += value * at * at;
            }
        // A probe of 12 × 12 cells: a few per cent.
        EXPECT_NEAR(m.flux() / (sum * frame.pixel_area_mm2()), 1.0, 0.05) << name(scene.ghosts[g]);
        EXPECT_NEAR(m.x_mm, x / sum, 0.05 * std::sqrt(m.xx_mm2) + 0.02) << name(scene.ghosts[g]);
        EXPECT_NEAR(m.xx_mm2, xx / sum - x / sum * (x / sum), 0.1 * m.xx_mm2 + 0.01)
            << name(scene.ghosts[g]);
        ++compared;
    }
    EXPECT_GE(compared, 2);
}

TEST(LightPattern, ADiscHasItsSecondMoment) {
    const LightPattern disc = disc_pattern(2.0);
    double sum = 0.0, square = 0.0;
    for (int j = 0; j < disc.height; ++j)
        for (int i = 0; i < disc.width; ++i) {
            const double share =
                static_cast<double>(disc.shares[static_cast<std::size_t>(j * disc.width + i)]);
            const double x = (i + 0.5 - 0.5 * disc.width) * disc.cell_rad;
            sum += share;
            square += share * x * x;
        }
    const double radius = std::numbers::pi / 180.0;
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_NEAR(square, 0.25 * radius * radius, 0.002 * radius * radius);  // r²/4
}

TEST(LightPattern, OffsetsAgreeWithTheLightsOwnFrame) {
    for (const LightDirection light :
         {LightDirection{10.0, 90.0}, LightDirection{-20.0, 30.0}, LightDirection{35.0, 200.0}}) {
        constexpr double step = 1e-5;
        const LightDirection right = offset_light(light, step, 0.0);
        const FieldOffset offset = field_offset(light, step, 0.0);
        const double to_rad = std::numbers::pi / 180.0;
        EXPECT_NEAR((right.field_deg - light.field_deg) * to_rad, offset.along_rad, 1e-9);
        const double turned = std::remainder(right.azimuth_deg - light.azimuth_deg, 360.0);
        EXPECT_NEAR(turned * to_rad * std::sin(light.field_deg * to_rad), offset.across_rad, 1e-9);
        // What is seen to the right comes from +x and travels to −x.
        EXPECT_LT(beam_frame(right).direction.x, beam_frame(light).direction.x);
    }
}

TEST(LightPattern, PatchesAreThePattern) {
    const LightPattern disc = disc_pattern(4.0);
    double share = 0.0;
    for (const PatternPatch& patch : patches(disc, {10.0, 90.0}, 3)) share += patch.share;
    EXPECT_NEAR(share, 1.0, 1e-6);
}

TEST(LightSize, ReadsItsOwnNames) {
    for (const LightSize& size : {LightSize(PointSize{}), LightSize(DiscSize{}),
                                  LightSize(DiscSize{2.5}), LightSize(PictureSize{"a b.exr", 3.0})})
        EXPECT_EQ(parse_light_size(name(size)), size);
    for (const char* text : {"", "disc", "disc -1", "disc 21", "picture a.exr", "moon", "disc 1 2"})
        EXPECT_THROW(parse_light_size(text), Error) << text;
}

}  // namespace
}  // namespace ghostlight
