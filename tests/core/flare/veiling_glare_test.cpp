#include "core/flare/veiling_glare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/flare/ghost_mesh.h"
#include "core/flare/veil_picture.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double width_mm = 36.0, height_mm = 24.0;

GhostSpot spot(double x, double y, double sx, double sy, double correlation, double flux) {
    GhostSpot made;
    made.flux_mm2 = {0.9 * flux, flux, 1.2 * flux, flux};
    made.x_mm = x;
    made.y_mm = y;
    made.xx_mm2 = sx * sx;
    made.yy_mm2 = sy * sy;
    made.xy_mm2 = correlation * sx * sy;
    return made;
}

/// The normal distribution itself.
double gaussian(const GhostSpot& m, double x, double y) {
    const double det = m.xx_mm2 * m.yy_mm2 - m.xy_mm2 * m.xy_mm2;
    const double dx = x - m.x_mm, dy = y - m.y_mm;
    const double square =
        (m.yy_mm2 * dx * dx - 2.0 * m.xy_mm2 * dx * dy + m.xx_mm2 * dy * dy) / det;
    return m.flux() * std::exp(-0.5 * square) / (2.0 * std::numbers::pi * std::sqrt(det));
}

VeilSeries series_of(const std::vector<GhostSpot>& ghosts, VeilKernel kernel, int orders = 0) {
    const VeilSize size = veil_size(ghosts, width_mm, height_mm);
    VeilSeries series(size.period_mm, orders > 0 ? orders : size.orders);
    for (const GhostSpot& ghost : ghosts) series.add(ghost, kernel);
    return series;
}

/// Largest difference from the closed form over the sensor, over the peak.
double worst(const VeilSeries& series, const GhostSpot& ghost) {
    double most = 0.0;
    for (double y = -0.5 * height_mm; y <= 0.5 * height_mm; y += 1.5)
        for (double x = -0.5 * width_mm; x <= 0.5 * width_mm; x += 1.5)
            most = std::max(most, std::abs(series.at(x, y)[3] - gaussian(ghost, x, y)));
    return most / gaussian(ghost, ghost.x_mm, ghost.y_mm);
}

TEST(VeilingGlare, TheSeriesOfOneGaussianIsTheGaussian) {
    // What the orders and the period leave out is below 4e-5 of the peak each way.
    constexpr double tolerance = 2e-4;
    for (const GhostSpot& ghost : {spot(0, 0, 3, 3, 0, 1), spot(5, -7, 2, 4, 0, 2),
                                   spot(-9, 3, 3, 2, 0.6, 1), spot(20, 10, 8, 5, -0.8, 5)})
        EXPECT_LT(worst(series_of({ghost}, VeilKernel::gaussian), ghost), tolerance);
}

TEST(VeilingGlare, ErrorFallsWithTheOrdersAsTheGaussianItself) {
    // What orders above N hold: about exp(−(Nωσ)²/2) of the peak.
    const GhostSpot ghost = spot(2, 1, 2.5, 2.5, 0, 1);
    const double period = veil_size(std::vector{ghost}, width_mm, height_mm).period_mm;
    double before = 1.0;
    for (const int orders : {4, 8, 12}) {
        const double error = worst(series_of({ghost}, VeilKernel::gaussian, orders), ghost);
        const double x = 2.0 * std::numbers::pi * orders / period * 2.5;
        RecordProperty("orders_" + std::to_string(orders), std::to_string(error));
        EXPECT_LT(error, before);
        EXPECT_LT(error, 4.0 * std::exp(-0.5 * x * x) + 1e-4) << orders;
        EXPECT_GT(error, 0.01 * std::exp(-0.5 * (x + 1) * (x + 1))) << orders;
        before = error;
    }
}

TEST(VeilingGlare, ManyGhostsAreTheirSum) {
    Random random(5);
    std::vector<GhostSpot> ghosts;
    for (int k = 0; k < 40; ++k)
        ghosts.push_back(spot(random.between(-15, 15), random.between(-10, 10),
                              random.between(2, 6), random.between(2, 6), random.between(-0.7, 0.7),
                              random.between(0, 1)));
    const VeilSeries series = series_of(ghosts, VeilKernel::gaussian);
    double peak = 0.0;
    for (const GhostSpot& ghost : ghosts) peak += gaussian(ghost, ghost.x_mm, ghost.y_mm);
    for (double y = -12; y <= 12; y += 3)
        for (double x = -18; x <= 18; x += 3) {
            double sum = 0.0;
            for (const GhostSpot& ghost : ghosts) sum += gaussian(ghost, x, y);
            EXPECT_NEAR(series.at(x, y)[3], sum, 1e-4 * peak) << x << ' ' << y;
        }
}

TEST(VeilingGlare, FluxOverThePeriodIsTheGhosts) {
    for (const VeilKernel kernel : {VeilKernel::gaussian, VeilKernel::ellipse}) {
        const std::vector ghosts = {spot(3, 2, 2, 4, 0.3, 1.5), spot(-6, 1, 5, 3, 0, 0.25)};
        const VeilSeries series = series_of(ghosts, kernel);
        // The mean over more points than twice the orders is exact for a Fourier series.
        const int points = 2 * series.orders() + 3;
        std::vector<double> places;
        for (int k = 0; k < points; ++k)
            places.push_back(series.period_mm() * ((k + 0.5) / points - 0.5));
        const std::vector<float> values = series.grid(places, places);
        std::array<double, 4> sums{};
        for (std::size_t i = 0; i < values.size(); ++i)
            sums[i % 4] += static_cast<double>(values[i]);
        const double cell = series.period_mm() * series.period_mm() / (points * points);
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_NEAR(sums[c] * cell, ghosts[0].flux_mm2[c] + ghosts[1].flux_mm2[c], 1e-5);
    }
}

TEST(VeilingGlare, AnEllipseIsFlatInsideAndDarkOutside) {
    const GhostSpot ghost = spot(0, 0, 4, 3, 0, 1);
    const VeilSeries series = series_of({ghost}, VeilKernel::ellipse, 40);
    const double level = ghost.flux() / (std::numbers::pi * 8.0 * 6.0);
    // The taper leaves ripples of a few per cent away from the rim.
    constexpr double ripple = 0.05;
    for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(4.0, 0.0), std::pair(-2.0, 3.0)})
        EXPECT_NEAR(series.at(x, y)[3], level, ripple * level) << x << ' ' << y;
    for (const auto& [x, y] : {std::pair(12.0, 0.0), std::pair(0.0, 10.0), std::pair(-17.0, 11.0)})
        EXPECT_NEAR(series.at(x, y)[3], 0.0, ripple * level) << x << ' ' << y;
}

TEST(VeilingGlare, NoRepeatIsSeenOnTheSensor) {
    // A ghost beside the sensor: its repeat must not come in from the other side.
    const GhostSpot ghost = spot(26, 0, 4, 4, 0, 1);
    const VeilSeries series = series_of({ghost}, VeilKernel::gaussian);
    EXPECT_LT(worst(series, ghost), 2e-4);
    EXPECT_LT(series.at(-18.0, 0.0)[3], 2e-4 * gaussian(ghost, 26, 0));
}

TEST(VeilingGlare, ThePictureIsTheSeries) {
    const std::vector ghosts = {spot(3, 2, 2, 3, 0.3, 1.5), spot(-6, 1, 5, 3, 0, 0.25)};
    const VeilSeries series = series_of(ghosts, VeilKernel::gaussian);
    // At full size, at a half and at an eighth; a width that no step divides.
    for (const int width_px : {60, 221, 1280}) {
        const PixelFrame frame = pixel_frame(width_mm, height_mm, width_px);
        const auto drawn = [&](unsigned threads) {
            FlareImage image;
            const auto count = static_cast<std::size_t>(frame.width_px * frame.height_px);
            image.rgb.assign(3 * count, -1.0F);
            image.irradiance.assign(count, -1.0F);
            draw_veil(series, 2.0, frame, threads, image);
            return image;
        };
        const FlareImage picture = drawn(1);
        double peak = 0.0, difference = 0.0;
        // Every pixel's series would be dear.
        const int step = 1 + width_px / 47;
        for (int row = 0; row < frame.height_px; row += step)
            for (int column = 0; column < frame.width_px; column += step) {
                const auto exact = series.at(frame.left_mm + (column + 0.5) * frame.pitch_mm,
                                             frame.bottom_mm + (row + 0.5) * frame.pitch_mm);
                const auto k = static_cast<std::size_t>(row * frame.width_px + column);
                peak = std::max(peak, exact[3]);
                for (std::size_t c = 0; c < 4; ++c) {
                    const float got = c < 3 ? picture.rgb[3 * k + c] : picture.irradiance[k];
                    difference =
                        std::max(difference, std::abs(static_cast<double>(got) - exact[c]));
                }
            }
        // Linear interpolation between points σ/6 apart.
        EXPECT_LT(difference, 0.01 * peak) << width_px;
        const FlareImage two = drawn(2);
        EXPECT_EQ(picture.rgb, two.rgb);
        EXPECT_EQ(picture.irradiance, two.irradiance);
    }
    EXPECT_EQ(veil_level(2.0, pixel_frame(width_mm, height_mm, 60)), 0);
    EXPECT_EQ(veil_level(2.0, pixel_frame(width_mm, height_mm, 1280)), 3);
}

}  // namespace
}  // namespace ghostlight
