#include "core/flare/reference_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/flare/picture_errors.h"
#include "core/ghosts/ghost_table.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

ReferenceRequest request_of(LightDirection light, double tolerance, int width_px = 160) {
    ReferenceRequest request;
    request.light = light;
    request.tolerance = tolerance;
    request.width_px = width_px;
    return request;
}

ReferenceImage reference(const Prescription& lens, const ReferenceRequest& request) {
    auto image = render_reference(lens, request);
    EXPECT_TRUE(image.has_value());
    return std::move(image).value_or(ReferenceImage{});
}

double relative_l1(const ReferenceImage& a, const ReferenceImage& truth) {
    return picture_errors(a.image.irradiance, truth.image.irradiance).relative_l1;
}

/// A plate in air across the beam: its ghost is the round opening itself, displaced, with an
/// irradiance R² T² that is even to the last digit.
TEST(ReferenceImage, OfAPlateIsADiscOfKnownPlaceAndLight) {
    constexpr double n = 1.5, thickness_mm = 4.0, gap_mm = 30.0, radius_mm = 3.0, field_deg = 8.0;
    Prescription lens = lens_of({row(0.0, 1.0, 1.0, radius_mm), row(0.0, thickness_mm, n, 50.0),
                                 row(0.0, gap_mm, 1.0, 50.0)},
                                0);
    lens.stop.semi_diameter_mm = radius_mm;
    const ReferenceImage image = reference(lens, request_of({field_deg, 90.0}, 0.003, 240));
    ASSERT_EQ(image.ghosts.size(), 1U);
    EXPECT_TRUE(image.converged);

    const double theta = rad_from_deg(field_deg), inside = std::asin(std::sin(theta) / n);
    const double y_mm = (1.0 + gap_mm) * std::tan(theta) + 3.0 * thickness_mm * std::tan(inside);
    auto fresnel = [&](double sign) {
        const double ratio = sign < 0.0 ? std::sin(theta - inside) / std::sin(theta + inside)
                                        : std::tan(theta - inside) / std::tan(theta + inside);
        return ratio * ratio;
    };
    double weight = 0.0;
    for (const double sign : {-1.0, 1.0})
        weight += 0.5 * std::pow(fresnel(sign) * (1.0 - fresnel(sign)), 2);
    const double flux_mm2 = weight * std::numbers::pi * radius_mm * radius_mm * std::cos(theta);
    EXPECT_NEAR(image.image.flux_on_sensor_mm2 / flux_mm2, 1.0, 0.003);
    const PixelFrame pixels = pixel_frame(36.0, 24.0, 240);
    // The exact coverage of a pixel, by 16 × 16 points: good to a hundredth of a pixel at the rim.
    std::vector<float> exact(image.image.irradiance.size());
    constexpr int points = 16;
    for (int j = 0; j < pixels.height_px; ++j)
        for (int i = 0; i < pixels.width_px; ++i) {
            int covered = 0;
            for (int k = 0; k < points * points; ++k) {
                const double x =
                    pixels.left_mm + pixels.pitch_mm * (i + (k % points + 0.5) / points);
                const double y =
                    pixels.bottom_mm +
                    pixels.pitch_mm * (j + (static_cast<double>(k / points) + 0.5) / points);
                covered += std::hypot(x, y - y_mm) <= radius_mm ? 1 : 0;
            }
            // The opening lies across the axis: its light is spread over its own area.
            exact[static_cast<std::size_t>(j * pixels.width_px + i)] =
                static_cast<float>(weight * std::cos(theta) * covered / (points * points));
        }
    constexpr double counting_error = 0.004;  // of the light, of the points along the rim
    EXPECT_LE(picture_errors(image.image.irradiance, exact).relative_l1, 0.003 + counting_error);
}

TEST(ReferenceImage, ErrsByLessThanItSays) {
    for (const char* file : {"tessar_brendel_100_f2.8", "double_gauss_tronnier_100_f2"}) {
        const Prescription lens = bundled(file);
        const LightDirection light{7.0, 90.0};
        const ReferenceImage fine = reference(lens, request_of(light, 0.002, 200));
        const ReferenceImage coarse = reference(lens, request_of(light, 0.05, 200));
        EXPECT_LE(fine.relative_error(), 0.002) << file;
        EXPECT_LE(coarse.relative_error(), 0.05) << file;
        EXPECT_GT(coarse.relative_error(), fine.relative_error()) << file;
        EXPECT_LE(relative_l1(coarse, fine), coarse.relative_error() + fine.relative_error())
            << file;
        EXPECT_LE(coarse.disagreement_mm2, coarse.error_mm2 * (1.0 + 1e-9)) << file;
    }
}

TEST(ReferenceImage, HoldsTheFluxesOfTheTable) {
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    lens.sensor.reflectance = UniformReflectance{0.05};
    const LightDirection light{5.0, 35.0};
    const auto table = ghost_table(lens, {.light = light, .tolerance = 0.002, .peaks = false});
    const ReferenceImage image = reference(lens, request_of(light, 0.003));
    ASSERT_EQ(image.ghosts.size(), table->ghosts.size());
    const double floor_mm2 = 2e-3 * table->ghosts.front().flux_mm2;
    for (const GhostRow& row : table->ghosts) {
        const auto ghost = std::ranges::find(image.ghosts, row.path, &ReferenceGhost::path);
        ASSERT_NE(ghost, image.ghosts.end());
        EXPECT_NEAR(ghost->flux_mm2, row.flux_mm2,
                    row.flux_error_mm2 + ghost->flux_error_mm2 + 0.002 * row.flux_mm2 + floor_mm2)
            << name(row.path, table->surface_count);
    }
}

TEST(ReferenceImage, IsBitIdenticalForAnyNumberOfThreads) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    ReferenceRequest request = request_of({9.0, 20.0}, 0.02, 120);
    request.spectrum = Blackbody{4000.0};
    request.tolerance = 0.2;
    request.highlighted = {{{3, 1}}};
    request.threads = 1;
    const ReferenceImage one = reference(lens, request);
    for (const unsigned threads : {2U, 5U}) {
        request.threads = threads;
        const ReferenceImage many = reference(lens, request);
        EXPECT_EQ(one.image.irradiance, many.image.irradiance);
        EXPECT_EQ(one.image.rgb, many.image.rgb);
        EXPECT_EQ(one.image.highlight, many.image.highlight);
        EXPECT_EQ(one.error, many.error);
        EXPECT_EQ(one.error_mm2, many.error_mm2);
        EXPECT_EQ(one.disagreement_mm2, many.disagreement_mm2);
    }
}

TEST(ReferenceImage, LayersAddUpToThePicture) {
    ReferenceRequest request = request_of({6.0, 90.0}, 0.02, 120);
    request.layers = true;
    const ReferenceImage image = reference(bundled("cooke_triplet_50_f5"), request);
    std::vector<double> sum(image.image.irradiance.size(), 0.0);
    for (const ReferenceGhost& ghost : image.ghosts)
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<double>(ghost.layer[i]);
    const double brightest = static_cast<double>(*std::ranges::max_element(image.image.irradiance));
    for (std::size_t i = 0; i < sum.size(); ++i)
        ASSERT_NEAR(sum[i], static_cast<double>(image.image.irradiance[i]), 2e-6 * brightest);
}

TEST(ReferenceImage, OfASmallDiscIsThatOfAPoint) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    ReferenceRequest request = request_of({8.0, 90.0}, 0.02, 90);
    const ReferenceImage point = reference(lens, request);
    request.disc_diameter_deg = 1e-5;
    request.tolerance = 0.05;
    const ReferenceImage disc = reference(lens, request);
    EXPECT_LE(relative_l1(disc, point), disc.relative_error() + point.relative_error());
}

TEST(ReferenceImage, OfADiscIsWiderByTheDisc) {
    // The plate's ghost moves with the tangent of the field: each direction shifts the disc by
    // l = (1 + gap) / cos² θ, and the spread of an even disc about its middle is R² / 4 a side.
    constexpr double gap_mm = 60.0, thickness_mm = 1e-3, radius_mm = 2.0, disc_deg = 4.0;
    Prescription lens = lens_of({row(0.0, 1e-3, 1.0, radius_mm), row(0.0, thickness_mm, 1.5, 50.0),
                                 row(0.0, gap_mm, 1.0, 50.0)},
                                0);
    lens.stop.semi_diameter_mm = radius_mm;
    ReferenceRequest request = request_of({0.0, 90.0}, 0.1, 120);
    request.disc_diameter_deg = disc_deg;
    const ReferenceImage image = reference(lens, request);
    const double pitch_mm = 36.0 / 120;
    const PictureMoments moments = picture_moments(image.image.irradiance, 120, pitch_mm);
    const double spread_mm = gap_mm * std::tan(rad_from_deg(0.5 * disc_deg));
    const double rms_mm =
        std::sqrt(0.5 * (radius_mm * radius_mm + spread_mm * spread_mm) + pitch_mm * pitch_mm / 6);
    EXPECT_NEAR(moments.rms_radius_mm, rms_mm, 0.01 * rms_mm);
    // Some tens of directions are even about the middle to a few hundredths of the spread.
    EXPECT_NEAR(std::hypot(moments.x_mm, moments.y_mm), 0.0, 0.03 * spread_mm);
}

TEST(ReferenceImage, OfASpectrumIsTheSumOverItsWavelengths) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    ReferenceRequest request = request_of({8.0, 90.0}, 0.06, 60);
    request.spectrum = StandardLight{Illuminant::d65};
    const ReferenceImage image = reference(lens, request);
    std::vector<float> sum(image.image.irradiance.size(), 0.0F);
    for (const SpectralSample& sample : nested_samples(request.spectrum, 17)) {
        ReferenceRequest one = request_of({8.0, 90.0}, 0.03, 60);
        one.spectrum = Monochromatic{sample.wavelength_nm};
        const ReferenceImage part = reference(lens, one);
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += static_cast<float>(sample.weight) * part.image.irradiance[i];
    }
    EXPECT_LE(picture_errors(image.image.irradiance, sum).relative_l1,
              image.relative_error() + 0.03);
}

TEST(ReferenceImage, LighterWeightsAreThoseThatTheyClaim) {
    // A steep plate, by Fresnel's formulas: two reflections and two transmissions in one plane.
    constexpr double n = 1.7, field_deg = 50.0, tolerance = 1e-9;
    Prescription lens =
        lens_of({row(0.0, 1.0, 1.0, 2.0), row(0.0, 2.0, n, 80.0), row(0.0, 4.0, 1.0, 80.0)}, 0);
    lens.stop.semi_diameter_mm = 2.0;
    lens.sensor.width_mm = lens.sensor.height_mm = 60.0;
    const double theta = rad_from_deg(field_deg), inside = std::asin(std::sin(theta) / n);
    const double rs = std::pow(std::sin(theta - inside) / std::sin(theta + inside), 2);
    const double rp = std::pow(std::tan(theta - inside) / std::tan(theta + inside), 2);
    const double r = 0.5 * (rs + rp);
    ReferenceRequest request = request_of({field_deg, 90.0}, 0.02, 60);
    const double carried = reference(lens, request).image.flux_mm2;
    request.weights = WeightModel::averaged;
    const double averaged = reference(lens, request).image.flux_mm2;
    request.weights = WeightModel::reflections_only;
    const double reflections = reference(lens, request).image.flux_mm2;
    const double truth = 0.5 * (std::pow(rs * (1.0 - rs), 2) + std::pow(rp * (1.0 - rp), 2));
    EXPECT_NEAR(averaged / carried, std::pow(r * (1.0 - r), 2) / truth, tolerance);
    EXPECT_NEAR(reflections / carried, r * r / truth, tolerance);
}

TEST(ReferenceImage, StopsWhenAskedAndSaysHowFarItIs) {
    std::stop_source source;
    source.request_stop();
    EXPECT_FALSE(
        render_reference(bundled("cooke_triplet_50_f5"), {}, source.get_token()).has_value());
    std::vector<double> shares;
    ReferenceRequest request = request_of({3.0, 90.0}, 0.05, 60);
    request.threads = 1;
    ASSERT_TRUE(render_reference(bundled("cooke_triplet_50_f5"), request, {}, [&](double share) {
                    shares.push_back(share);
                }).has_value());
    ASSERT_FALSE(shares.empty());
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_NEAR(shares.back(), 1.0, 1e-12);
}

}  // namespace
}  // namespace ghostlight
