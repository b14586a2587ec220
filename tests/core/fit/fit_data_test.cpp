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

TEST(FitSpline, PixelsAreSharpenedByWhatTheyBlur) {
    // ∫ t² under the spline is 1/4; a pixel of breadth p adds p²/12 to the mean of t² over it.
    const double p = 0.4;
    double sharp = 0.0, plain = 0.0, weight = 0.0, all = 0.0;
    // Averaged over where the pixels lie.
    for (double phase = -0.5 * p; phase < 0.5 * p; phase += 0.001)
        for (int k = -8; k <= 8; ++k) {
            const double t = phase + k * p, mean = t * t + p * p / 12.0;
            sharp += pixel_weight(t, p) * mean;
            weight += pixel_weight(t, p);
            plain += spline(t) * mean;
            all += spline(t);
        }
    EXPECT_NEAR(sharp / weight, 0.25, 2e-4);
    EXPECT_NEAR(plain / all, 0.25 + p * p / 12.0, 2e-4);  // what there would be otherwise
}

TEST(FitData, RimsHaveContrastAndEvenPicturesNone) {
    Photo photo = even_photo(360, 240, 0.25F);
    for (std::size_t i = 0; i < photo.pixels(); ++i)
        if (i % 360 >= 180)
            for (std::size_t c = 0; c < 3; ++c) photo.rgb[3 * i + c] = 0.5F;
    const FitData data = fit_data(photo, whole_frame(photo), 36.0, 24.0, 60);
    EXPECT_NEAR(relative_contrast(data, 20 * 60 + 10, 0.0), 0.0, 1e-6);
    // The step lies between samples 29 and 30; the spline takes 2/3 of it between the two.
    EXPECT_NEAR(relative_contrast(data, 20 * 60 + 29, 0.0), 0.25 * 2.0 / 3.0 / (0.25 + 0.25 / 6.0),
                0.01);
}

TEST(FitData, DarknessCountsNotLessThanAPhoton) {
    Photo photo = even_photo(360, 240, 0.0F);
    photo.noise = {.shot = 1e-4, .read = 0.0, .estimated = false};
    const FitData data = fit_data(photo, whole_frame(photo), 36.0, 24.0, 60);
    const double photon = 1e-4 * data.inverse_count[20 * 60 + 30];
    const StableScale scale = stable_scale(data, 20 * 60 + 30, 0.003, 0.0);
    EXPECT_NEAR(scale.sigma(0.0), photon, 1e-12);
    // Of the model's error at a level of 0.1.
    EXPECT_NEAR(stable_scale(data, 20 * 60 + 30, 0.003, 0.1).sigma(-1.0), 3e-4, 1e-9);
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
