// FLIP against closed forms on uniform pictures, and against the papers' own two-dimensional
// kernels summed pixel by pixel.

#include "core/flare/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ghostlight {
namespace {

using Picture = std::vector<float>;

Picture uniform(int width, int height, float r, float g, float b) {
    Picture picture;
    for (int i = 0; i < width * height; ++i) picture.insert(picture.end(), {r, g, b});
    return picture;
}

double lightness(double y) {
    const double delta = 6.0 / 29.0;
    return y > delta * delta * delta ? 116.0 * std::cbrt(y) - 16.0
                                     : 116.0 * y / (3.0 * delta * delta);
}

/// Largest difference of the scale: green against blue, L*a*b* of the primaries by hand from their
/// published values (L*, a*, b*): (87.737, −86.185, 83.181) and (32.297, 79.188, −107.860), the
/// chromatic parts times L*/100.
double largest() {
    const double a0 = -86.185 * 0.87737, b0 = 83.181 * 0.87737;
    const double a1 = 79.188 * 0.32297, b1 = -107.860 * 0.32297;
    return std::pow(87.737 - 32.297 + std::hypot(a0 - a1, b0 - b1), 0.7);
}

double on_scale(double difference) {
    const double most = largest(), knee = 0.4 * most, raised = std::pow(difference, 0.7);
    return raised < knee ? 0.95 * raised / knee : 0.95 + 0.05 * (raised - knee) / (most - knee);
}

// Single precision and the primaries' five digits.
constexpr double rounding = 2e-4;

TEST(Flip, NothingDiffersFromItself) {
    Picture picture = uniform(24, 16, 0.2F, 0.5F, 0.1F);
    for (std::size_t i = 0; i < picture.size(); i += 7) picture[i] = 0.9F;
    for (const float error : ldr_flip(picture, picture, 24)) EXPECT_EQ(error, 0.0F);
    EXPECT_EQ(hdr_flip(picture, picture, 24), 0.0);
    EXPECT_EQ(hdr_flip(picture, uniform(24, 16, 0, 0, 0), 24), 0.0) << "a black truth";
}

TEST(Flip, UniformGraysDifferByTheirLightness) {
    for (const auto& [one, other] : {std::pair{0.0, 1.0}, {0.2, 0.25}, {0.001, 0.5}}) {
        const auto error = ldr_flip(uniform(12, 8, float(one), float(one), float(one)),
                                    uniform(12, 8, float(other), float(other), float(other)), 12);
        const double expected = on_scale(std::abs(lightness(one) - lightness(other)));
        for (const float e : error) EXPECT_NEAR(e, expected, rounding) << one << " " << other;
    }
}

TEST(Flip, GreenAgainstBlueIsTheMost) {
    const auto error = ldr_flip(uniform(8, 8, 0, 1, 0), uniform(8, 8, 0, 0, 1), 8);
    // Features differ not at all on uniform pictures.
    for (const float e : error) EXPECT_NEAR(e, 1.0, rounding);
}

/// A dot on gray: colour and features at every pixel by the kernels in two dimensions.
TEST(Flip, ADotMatchesTheKernelsSummedDirectly) {
    constexpr int width = 33, height = 31, at_x = 14, at_y = 17;
    constexpr double gray = 0.18, dot = 0.9, ppd = 30.0, pi = std::numbers::pi;
    Picture truth = uniform(width, height, float(gray), float(gray), float(gray));
    Picture picture = truth;
    for (int c = 0; c < 3; ++c) picture[3 * (at_y * width + at_x) + c] = float(dot);
    const auto error = ldr_flip(picture, truth, width, ppd);

    const int reach = static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * pi * pi)) * ppd));
    double volume = 0.0;
    auto seen = [&](int x, int y) {
        return std::exp(-pi * pi * (x * x + y * y) / (ppd * ppd) / 0.0047);
    };
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) volume += seen(x, y);
    const double sigma = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    auto bell = [&](int x, int y) { return std::exp(-(x * x + y * y) / (2.0 * sigma * sigma)); };
    auto slope = [&](int x, int y) { return -x * bell(x, y); };
    auto bend = [&](int x, int y) { return (x * x / (sigma * sigma) - 1.0) * bell(x, y); };
    double slope_up = 0.0, bend_up = 0.0, bend_down = 0.0;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            slope_up += std::max(0.0, slope(x, y));
            bend_up += std::max(0.0, bend(x, y));
            bend_down -= std::min(0.0, bend(x, y));
        }
    auto bend_scaled = [&](int x, int y) {
        const double value = bend(x, y);
        return value / (value > 0.0 ? bend_up : bend_down);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int dx = at_x - x, dy = at_y - y;
            const bool is_seen = std::abs(dx) <= reach && std::abs(dy) <= reach;
            const double level = gray + (is_seen ? (dot - gray) * seen(dx, dy) / volume : 0.0);
            const double color = on_scale(std::abs(lightness(level) - lightness(gray)));
            double feature = 0.0;
            if (std::abs(dx) <= radius && std::abs(dy) <= radius)
                feature =
                    (dot - gray) * std::max(std::hypot(slope(dx, dy), slope(dy, dx)) / slope_up,
                                            std::hypot(bend_scaled(dx, dy), bend_scaled(dy, dx)));
            const double expected =
                color > 0.0 ? std::pow(color, 1.0 - std::sqrt(feature / std::sqrt(2.0))) : 0.0;
            // L* of nearly equal grays in single precision, to the power 0.7.
            EXPECT_NEAR(error[static_cast<std::size_t>(y * width + x)], expected, 2e-3)
                << x << ", " << y;
        }
}

/// Of a uniform picture twice as bright as its truth, which is exposed to 0.85 on the curve.
double of_twice_the_light() {
    auto curve = [](double x) {
        const double v = 0.6 * x;
        return v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14);
    };
    double low = 0.0, high = 10.0;
    for (int i = 0; i < 60; ++i)
        (curve(0.5 * (low + high)) < 0.85 ? low : high) = 0.5 * (low + high);
    return on_scale(lightness(curve(2.0 * low)) - lightness(0.85));
}

TEST(Flip, ExposuresFollowTheTruth) {
    for (const float scale : {1e-6F, 1.0F, 300.0F})
        EXPECT_NEAR(hdr_flip(uniform(8, 8, 2 * scale, 2 * scale, 2 * scale),
                             uniform(8, 8, scale, scale, scale), 8),
                    of_twice_the_light(), rounding);
}

TEST(Flip, DimPartsCountAtTheirOwnExposure) {
    // Most of the picture a thousandth as bright, and there twice as bright as it should be.
    constexpr int width = 256, bright = 56;
    Picture truth = uniform(width, 4, 1, 1, 1), picture = truth;
    for (std::size_t i = 0; i < truth.size(); ++i)
        if (i / 3 % width >= bright) {
            truth[i] = 1e-3F;
            picture[i] = 2e-3F;
        }
    const double found = hdr_flip(picture, truth, width);
    // The filters reach 10 pixels (3 √(0.04/2π²) × 67) to either side of the edge.
    const double share = static_cast<double>(width - bright - 10) / width;
    EXPECT_GT(found, share * of_twice_the_light());
    EXPECT_EQ(found, hdr_flip(picture, truth, width, 1)) << "one thread";
}

}  // namespace
}  // namespace ghostlight
