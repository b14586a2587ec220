#include "core/flare/masked_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/flare/fourier_2d.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;

StopMask stop_of(int blades, double rotation_rad = 0.0) {
    StopMask mask;
    mask.semi_diameter_mm = 5.0;
    mask.blades = blades;
    mask.rotation_rad = rotation_rad;
    return mask;
}

TEST(Fourier2d, IsTheDefiningSumAndItsInverse) {
    constexpr int n = 16;
    std::vector<std::complex<float>> field(n * n);
    Random random(3);
    for (auto& value : field)
        value = {static_cast<float>(random.between(-1.0, 1.0)),
                 static_cast<float>(random.between(-1.0, 1.0))};
    auto transformed = field;
    ASSERT_TRUE(transform_2d(transformed, n, false, 2));
    for (const auto& [p, q] : {std::pair{0, 0}, {1, 0}, {0, 3}, {15, 7}}) {
        std::complex<double> sum = 0.0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                sum += std::complex<double>(field[static_cast<std::size_t>(j * n + i)]) *
                       std::polar(1.0, -2.0 * pi * (i * p + j * q) / n);
        // Single precision: 256 terms of order one.
        EXPECT_NEAR(
            std::abs(sum - std::complex<double>(transformed[static_cast<std::size_t>(q * n + p)])),
            0.0, 2e-5);
    }
    ASSERT_TRUE(transform_2d(transformed, n, true, 1));
    for (std::size_t k = 0; k < field.size(); ++k)
        EXPECT_NEAR(std::abs(transformed[k] / static_cast<float>(n * n) - field[k]), 0.0F, 1e-6F);
}

TEST(MaskedPattern, TransformOfARasterIsThePolygonsClosedForm) {
    // Up to a quarter of the Nyquist frequency; coverage at edges is off by its second order.
    for (const int blades : {4, 5, 6, 9}) {
        const StopMask mask = stop_of(blades, 0.2);
        const PowerGrid grid(mask_raster(mask, {}, 512), 1024, 0.0, 2);
        const auto corners = outline_of(mask).corners;
        const double middle = std::norm(polygon_transform(corners, {0.0, 0.0}));
        for (int j = -60; j <= 60; j += 7)
            for (int i = -60; i <= 60; i += 5) {
                const double exact =
                    std::norm(polygon_transform(corners, {i * grid.step(), j * grid.step()}));
                EXPECT_NEAR(grid.at(i, j), exact, 1e-3 * std::sqrt(exact * middle) + 1e-7 * middle)
                    << blades << " blades at " << i << ", " << j;
            }
    }
}

TEST(MaskedPattern, TwoRastersByOneTransformAreThoseByTwo) {
    const StopMask mask = stop_of(6, 0.2);
    StopDirt dirt;
    dirt.dust_coverage = 0.05;
    const MaskRaster coarse = mask_raster(mask, dirt, 64), fine = mask_raster(mask, dirt, 256);
    const auto both = PowerGrid::of_two(coarse, fine, 512, 2);
    const PowerGrid first(coarse, 512, 0.0, 1), second(fine, 512, 0.0, 1);
    for (int j = -200; j <= 200; j += 23)
        for (int i = -200; i <= 200; i += 17) {
            // Rounding of single precision, of the largest value's amplitude.
            EXPECT_NEAR(std::sqrt(both[0].at(i, j)), std::sqrt(first.at(i, j)),
                        2e-6 * std::sqrt(first.at(0, 0)));
            EXPECT_NEAR(std::sqrt(both[1].at(i, j)), std::sqrt(second.at(i, j)),
                        2e-6 * std::sqrt(second.at(0, 0)));
        }
}

TEST(MaskedPattern, SharesAreThoseOfTheClosedForm) {
    for (const int blades : {0, 5, 6}) {
        const StopMask mask = stop_of(blades, 0.2);
        const auto by_transform = masked_pattern({mask, {}, std::nullopt}, 0.0, 1e4, 2);
        const PolarPattern by_sum = pattern_of(outline_of(mask), 1e4, 2);
        ASSERT_TRUE(by_transform);
        EXPECT_NEAR(by_transform->total(), 1.0, 1e-5);
        // Bilinear between steps of 0.39, an eighth of a fringe: 1e-3 of the light. Beyond the
        // transform's grid the outermost octave is continued: 5 % of the little that is left.
        for (const double k : {3.8317, 20.0, 90.0, 300.0})
            EXPECT_NEAR(by_transform->encircled(k), by_sum.encircled(k), 1.5e-3) << blades;
        EXPECT_NEAR((1.0 - by_transform->encircled(3000.0)) / (1.0 - by_sum.encircled(3000.0)), 1.0,
                    0.1);
    }
}

TEST(MaskedPattern, DirtScattersWhatBabinetSays) {
    // Small specks of one size d scatter as so many discs do: a share of about their coverage,
    // 84 % of it within 3.83 · a/(d/2) of the middle.
    PatternMask mask{stop_of(0), {}, std::nullopt};
    mask.dirt.dust_coverage = 0.02;
    mask.dirt.dust_smallest_mm = mask.dirt.dust_largest_mm = 0.2;
    const auto pattern = masked_pattern(mask, 0.0, 1e4, 2);
    const double outside_without = 1.0 - airy_encircled(12.0);
    const double scattered = 1.0 - pattern->encircled(12.0) - outside_without;
    // Of a beam (1 − c)² is left and c(1 − c) scattered, of 1 − c that passes: c. Scattered light
    // falls on the core's and the rings' too, a few per cent; 300 specks' speckle is as much.
    EXPECT_NEAR(scattered / 0.02, 1.0, 0.15);
    const double within = pattern->encircled(3.8317 * 50.0) - pattern->encircled(12.0) -
                          (airy_encircled(3.8317 * 50.0) - airy_encircled(12.0));
    EXPECT_NEAR(within / scattered, 0.84, 0.06);
}

TEST(MaskedPattern, FarOutOfFocusItIsTheStopItself) {
    // What is open at ρ lands at 2π N ρ, but for the fringes at the rim: at most 0.37 of the light
    // in a ring 0.86/√N wide takes another place.
    for (const double number : {30.0, -30.0, 80.0}) {
        const auto pattern = masked_pattern({stop_of(0), {}, std::nullopt}, number, 2e3, 2);
        const double edge = 2.0 * pi * std::abs(number);
        const double fringes = 0.37 * 2.0 * 0.86 / std::sqrt(std::abs(number));
        EXPECT_NEAR(pattern->encircled(0.5 * edge), 0.25, 0.5 * fringes) << number;
        EXPECT_NEAR(pattern->encircled(0.9 * edge), 0.81, fringes) << number;
        EXPECT_GT(pattern->encircled(1.2 * edge), 0.985) << number;
    }
    // A triangle is upright on one side of the focus and upside down on the other.
    auto light_towards = [](const PolarPattern& pattern, double turn) {
        const int middle = static_cast<int>(turn / (2.0 * pi) * PolarPattern::sectors);
        double sum = 0.0;
        for (int ring = 0; ring < pattern.rings; ++ring)
            for (int s = middle - 40; s <= middle + 40; ++s)
                sum += static_cast<double>(
                    pattern.share[static_cast<std::size_t>(ring * PolarPattern::sectors + s)]);
        return sum;
    };
    const StopMask triangle = stop_of(3, 0.5 * pi);  // a corner towards +y
    const auto before = masked_pattern({triangle, {}, std::nullopt}, 20.0, 2e3, 2);
    const auto behind = masked_pattern({triangle, {}, std::nullopt}, -20.0, 2e3, 2);
    EXPECT_GT(light_towards(*before, 0.5 * pi), 1.5 * light_towards(*before, 1.5 * pi));
    EXPECT_GT(light_towards(*behind, 1.5 * pi), 1.5 * light_towards(*behind, 0.5 * pi));
}

TEST(MaskedPattern, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    EXPECT_FALSE(masked_pattern({stop_of(6), {}, std::nullopt}, 0.0, 100.0, 1, source.get_token()));
}

}  // namespace
}  // namespace ghostlight
