#include "widgets/palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace ghostlight {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

/// Machado, Oliveira, Fernandes (2009), severity 1, on linear RGB: protanopia, deuteranopia,
/// tritanopia.
constexpr std::array<Matrix, 3> dichromats = {{{{{0.152286, 1.052583, -0.204868},
                                                 {0.114503, 0.786281, 0.099216},
                                                 {-0.003882, -0.048116, 1.051998}}},
                                               {{{0.367322, 0.860646, -0.227968},
                                                 {0.280085, 0.672501, 0.047413},
                                                 {-0.011820, 0.042940, 0.968881}}},
                                               {{{1.255528, -0.076749, -0.178779},
                                                 {-0.078411, 0.930809, 0.147602},
                                                 {0.004733, 0.691367, 0.303900}}}}};
constexpr Matrix xyz_of_srgb = {
    {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};

Triple times(const Matrix& matrix, const Triple& v) {
    Triple out{};
    for (std::size_t r = 0; r < 3; ++r) {
        out[r] = matrix[r][0] * v[0] + matrix[r][1] * v[1] + matrix[r][2] * v[2];
    }
    return out;
}

Triple linear(const QColor& color) {
    const auto decode = [](double c) {
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return {decode(color.redF()), decode(color.greenF()), decode(color.blueF())};
}

Triple lab(const Triple& rgb) {
    const Triple xyz = times(xyz_of_srgb, rgb);
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
    const double x = f(xyz[0] / 0.9505), y = f(xyz[1]), z = f(xyz[2] / 1.089);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double distance(const QColor& a, const QColor& b, const Matrix& eye) {
    const auto seen = [&](const QColor& color) {
        Triple rgb = times(eye, linear(color));
        for (double& c : rgb) {
            c = std::clamp(c, 0.0, 1.0);
        }
        return lab(rgb);
    };
    const Triple p = seen(a), q = seen(b);
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

double contrast(const QColor& a, const QColor& b) {
    const double y = times(xyz_of_srgb, linear(a))[1], z = times(xyz_of_srgb, linear(b))[1];
    return (std::max(y, z) + 0.05) / (std::min(y, z) + 0.05);
}

TEST(Palette, SafeColorsAreToldApartByEveryEye) {
    // Lab, ΔE 1976: 2.3 is just noticed, side by side; thin lines apart from each other need ten
    // times that.
    constexpr double told_apart = 23.0;
    for (const Palette& colors : {safe_palette(dark_palette()), safe_palette(light_palette())}) {
        for (const Matrix& eye : dichromats) {
            EXPECT_GT(distance(colors.amber, colors.teal, eye), told_apart);
            EXPECT_GT(distance(colors.amber, colors.red_orange, eye), told_apart);
            EXPECT_GT(distance(colors.teal, colors.red_orange, eye), told_apart);
        }
    }
}

TEST(Palette, TextAndLinesStandOutFromTheirGround) {
    // WCAG 2.1: 4.5 for text, 3 for graphics.
    for (const Palette& colors : {dark_palette(), light_palette(), safe_palette(dark_palette()),
                                  safe_palette(light_palette())}) {
        for (const QColor& ground : {colors.panel, colors.ground}) {
            EXPECT_GE(contrast(colors.text, ground), 4.5);
            EXPECT_GE(contrast(colors.dim, ground), 4.5);
            EXPECT_GE(contrast(colors.red_orange, ground), 4.0);  // a warning, with a box around it
            for (const QColor& line : {colors.amber, colors.teal, colors.red_orange}) {
                EXPECT_GE(contrast(line, ground), 3.0);
            }
        }
    }
}

}  // namespace
}  // namespace ghostlight
