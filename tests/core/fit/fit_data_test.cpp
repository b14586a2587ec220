// A photograph on the fit's scale: the spline, the noise its samples share, and the stable scale.

#include "core/fit/fit_data.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

Photo even_photo(int width_px, int height_px, float value) {
    Photo photo;
    photo.width_px = width_px;
    photo.height_px = height_px;
    photo.rgb.assign(3 * photo.pixels(), value);
    photo.masked.assign(photo.pixels(), 0);
    photo.noise = {.shot = 1e-4, .read = 1e-6, .estimated = false};
    return photo;
}

PhotoPlace whole_frame(const Photo& photo) {
    return {.sensor_width_mm = 36.0,
            .axis_column = 0.5 * photo.width_px,
            .axis_row = 0.5 * photo.height_px,
            .rotation_rad = 0.0};
}

TEST(FitSpline, SumsToOneAndHasItsSlope) {
    for (double t = -0.5; t <= 0.5; t += 0.01) {
        double sum = 0.0;
        for (int k = -2; k <= 2; ++k) sum += spline(t - k);
        EXPECT_NEAR(sum, 1.0, 1e-14) << t;
        for (const double at : {t, t + 0.999, t - 1.2}) {
            const double step = 1e-5;
            EXPECT_NEAR((spline(at + step) - spline(at - step)) / (2.0 * step), spline_slope(at),
                        2e-5)
                << at;
        }
    }
}

TEST(FitSpline, CorrelationIsItsOwn) {
    // The definition: ∫ b(t) b(t − lag) dt over ∫ b².
    double whole = 0.0;
    for (int lag = 0; lag <= 3; ++lag) {
        double sum = 0.0;
        const double step = 1e-4;
        for (double t = -4.0; t < 4.0; t += step) sum += spline(t) * spline(t - lag) * step;
        if (lag == 0) whole = sum;
        EXPECT_NEAR(sum / whole, spline_correlation(lag), 1e-6) << lag;
    }
}

TEST(FitData, AnEvenPhotographStaysEven) {
    const Photo photo = even_photo(360, 240, 0.25F);
    const FitData data = fit_data(photo, whole_frame(photo), 36.0, 24.0, 60);
    ASSERT_EQ(data.frame.width_px, 60);
    // All but the outermost ring, whose splines reach beyond the picture.
    EXPECT_EQ(data.count, 58U * 38U);
    for (std::size_t s = 0; s < data.samples(); ++s) {
        if (!data.used[s]) continue;
        EXPECT_NEAR(data.value[3 * s], 0.25, 1e-6);
        // Six pixels a sample each way: Σ w² / (Σ w)² is (∫ b²)² / 36, ∫ b² = 66/120.
        EXPECT_NEAR(data.inverse_count[s], std::pow(66.0 / 120.0, 2) / 36.0, 1e-4);
    }
}

TEST(FitData, WhatIsMaskedIsLeftOutWithItsNeighbours) {
    Photo photo = even_photo(360, 240, 0.25F);
    mask_disc(photo, 180.0, 120.0, 9.0);
    for (std::size_t i = 0; i < photo.pixels(); ++i)
        if (photo.masked[i]) photo.rgb[3 * i] = 1000.0F;
    const FitData data = fit_data(photo, whole_frame(photo), 36.0, 24.0, 60);
    EXPECT_LT(data.count, 58U * 38U);
    EXPECT_GT(data.count, 58U * 38U - 60U);
    for (std::size_t s = 0; s < data.samples(); ++s)
        if (data.used[s]) {
            EXPECT_NEAR(data.value[3 * s], 0.25, 1e-6);
        }
}

TEST(FitData, RefusesPhotographsThatSayNothing) {
    Photo photo = even_photo(360, 240, 0.25F);
    photo.masked.assign(photo.pixels(), 1);
    EXPECT_NE(error_of([&] {
                  fit_data(photo, whole_frame(photo), 36.0, 24.0, 60);
              }).problem.find("too little of the photograph"),
              std::string::npos);
    const Photo tiny = even_photo(24, 16, 0.25F);
    EXPECT_NE(error_of([&] {
                  fit_data(tiny, whole_frame(tiny), 36.0, 24.0, 60);
              }).problem.find("too small"),
              std::string::npos);
}

TEST(StableScale, ItsSlopeIsOneOverSigma) {
    const StableScale scale{.shot = 1e-5, .read = 1e-8, .error = 0.01};
    EXPECT_EQ(scale.at(0.0), 0.0);
    for (const double y : {-0.01, 1e-6, 1e-4, 0.01, 0.3, 2.0}) {
        const double step = 1e-4 * std::abs(y);
        EXPECT_NEAR((scale.at(y + step) - scale.at(y - step)) / (2.0 * step) * scale.sigma(y), 1.0,
                    1e-6)
            << y;
    }
}

}  // namespace
}  // namespace ghostlight
