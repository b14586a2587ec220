// Photographs before a fit: noise, masks, merging, and where the light is.

#include "core/fit/photo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

/// A smooth gradient with Poisson-like and read noise of known size.
Photo noisy_photo(double shot, double read, std::uint64_t seed = 1) {
    Photo photo;
    photo.width_px = 400;
    photo.height_px = 300;
    photo.rgb.resize(3 * photo.pixels());
    photo.masked.assign(photo.pixels(), 0);
    photo.noise = {.shot = shot, .read = read, .estimated = false};
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (int y = 0; y < photo.height_px; ++y)
        for (int x = 0; x < photo.width_px; ++x)
            for (int c = 0; c < 3; ++c) {
                const double value = 0.02 + 0.5 * x / photo.width_px;
                photo.rgb[3 * static_cast<std::size_t>(y * photo.width_px + x) +
                          static_cast<std::size_t>(c)] =
                    static_cast<float>(value + std::sqrt(shot * value + read) * normal(random));
            }
    return photo;
}

TEST(Photo, NoiseIsEstimatedFromThePicture) {
    const PhotoNoise found = estimated_noise(noisy_photo(1e-4, 1e-6));
    EXPECT_TRUE(found.estimated);
    // 360 000 values: the medians of 24 bins are good to about a percent each.
    EXPECT_NEAR(found.shot, 1e-4, 0.08e-4);
    EXPECT_NEAR(found.read, 1e-6, 0.8e-6);
}

TEST(Photo, TheLightIsFoundThroughSaturation) {
    Photo photo = noisy_photo(1e-4, 1e-6);
    // Clipped to a flat disc, and a ghost that is large and bright but does not clip.
    for (int y = 0; y < photo.height_px; ++y)
        for (int x = 0; x < photo.width_px; ++x) {
            float* rgb = &photo.rgb[3 * static_cast<std::size_t>(y * photo.width_px + x)];
            if (std::hypot(x + 0.5 - 120.3, y + 0.5 - 80.6) < 12.0) rgb[0] = rgb[1] = rgb[2] = 1.0F;
            if (std::hypot(x + 0.5 - 300.0, y + 0.5 - 200.0) < 40.0) rgb[1] = 0.9F;
        }
    photo.saturation = 0.999;
    const LightSpot spot = find_light(photo);
    EXPECT_NEAR(spot.column, 120.3, 0.1);  // px
    EXPECT_NEAR(spot.row, 80.6, 0.1);
    EXPECT_NEAR(spot.radius_px, 12.0, 0.2);
}

TEST(Photo, NothingStandsOutOfAnEvenPicture) {
    EXPECT_NE(error_of([] { find_light(noisy_photo(0.0, 1e-8)); }).problem.find("no light"),
              std::string::npos);
}

TEST(Photo, UnusablePicturesAreRefused) {
    Photo photo = noisy_photo(0.0, 1e-8);
    photo.rgb.assign(photo.rgb.size(), 0.0F);
    EXPECT_NE(error_of([&] { mask_unusable(photo); }).problem.find("all black"), std::string::npos);
    photo.rgb.assign(photo.rgb.size(), 1.0F);
    photo.saturation = 0.99;
    EXPECT_NE(error_of([&] { mask_unusable(photo); }).problem.find("saturated"), std::string::npos);
    photo.rgb.assign(photo.rgb.size(), std::numeric_limits<float>::quiet_NaN());
    EXPECT_NE(error_of([&] { mask_unusable(photo); }).problem.find("number"), std::string::npos);
}

TEST(Photo, HotPixelsAndNaNsAreMasked) {
    Photo photo = noisy_photo(1e-6, 1e-8);
    photo.rgb[3 * 50'123] = 0.99F;
    photo.rgb[3 * 70'000 + 1] = std::numeric_limits<float>::quiet_NaN();
    const MaskCounts counts = mask_unusable(photo);
    EXPECT_EQ(counts.hot, 1U);
    EXPECT_EQ(counts.not_a_number, 1U);
    EXPECT_TRUE(photo.masked[50'123]);
    EXPECT_TRUE(photo.masked[70'000]);
    EXPECT_EQ(photo.rgb[3 * 70'000 + 1], 0.0F);
}

TEST(Photo, ExposuresMergeToTheirCommonLight) {
    Photo lengthy = noisy_photo(1e-4, 1e-6, 1), brief = noisy_photo(1e-4, 1e-6, 2);
    for (float& value : brief.rgb) value *= 0.25F;
    lengthy.exposure_s = 0.04;
    brief.exposure_s = 0.01;
    lengthy.masked[17] = 1;  // clipped in the long one
    const Photo one = merged({lengthy, brief});
    EXPECT_FALSE(one.masked[17]);
    EXPECT_FLOAT_EQ(one.rgb[3 * 17], 4.0F * brief.rgb[3 * 17]);
    double sum = 0.0, expected = 0.0;
    for (int x = 0; x < one.width_px; ++x) expected += 0.02 + 0.5 * x / one.width_px;
    for (const float value : one.rgb) sum += static_cast<double>(value);
    EXPECT_NEAR(sum / static_cast<double>(one.rgb.size()), expected / one.width_px, 1e-3);
    brief.exposure_s.reset();
    EXPECT_NE(error_of([&] {
                  merged({lengthy, brief});
              }).problem.find("exposure times"),
              std::string::npos);
}

TEST(Photo, NoiseOfMergedExposuresIsThatOfTheFewestPhotons) {
    Photo lengthy = noisy_photo(1e-4, 1e-6, 1), brief = noisy_photo(1e-4, 1e-6, 2);
    lengthy.exposure_s = 0.04;
    brief.exposure_s = 0.01;
    // In units of the longer one, a photon of the short one is worth four.
    EXPECT_NEAR(merged({lengthy, brief}).noise.shot, 1.0 / (1.0 / 1e-4 + 1.0 / 4e-4), 1e-12);
    // A twentieth clips in the long one: there the short one stands alone.
    std::fill_n(lengthy.masked.begin(), lengthy.pixels() / 20, mask_reason::saturated);
    EXPECT_NEAR(merged({lengthy, brief}).noise.shot, 4e-4, 1e-12);
}

TEST(Photo, MergingDoesNotPreferLowValues) {
    // Twenty photons a pixel in the long exposure, five in the short one, and no reading: weighted
    // by their own values they would come out a photon too low, 4 % of the light.
    constexpr double photon = 1e-4, level = 20 * photon;
    Photo lengthy = noisy_photo(photon, 0.0), brief = lengthy;
    std::mt19937_64 random(7);
    std::poisson_distribution<int> many(20), few(5);
    for (float& value : lengthy.rgb) value = static_cast<float>(photon * many(random));
    for (float& value : brief.rgb) value = static_cast<float>(photon * few(random));
    lengthy.exposure_s = 0.04;
    brief.exposure_s = 0.01;
    double sum = 0.0;
    const Photo one = merged({lengthy, brief});
    for (const float value : one.rgb) sum += static_cast<double>(value);
    // 360 000 values of 25 photons: the mean scatters by 1 in 3000; six of that.
    EXPECT_NEAR(sum / static_cast<double>(one.rgb.size()) / level, 1.0, 2e-3);
}

TEST(Photo, ALightThatClipsEveryExposureIsFoundInTheMergedOne) {
    Photo lengthy = noisy_photo(1e-4, 1e-6, 1), brief = noisy_photo(1e-4, 1e-6, 2);
    for (float& value : brief.rgb) value *= 0.25F;
    lengthy.exposure_s = 0.04;
    brief.exposure_s = 0.01;
    for (Photo* each : {&lengthy, &brief}) {
        for (int y = 200; y < 207; ++y)
            for (int x = 100; x < 107; ++x)
                for (std::size_t c = 0; c < 3; ++c)
                    each->rgb[3 * static_cast<std::size_t>(y * each->width_px + x) + c] = 1.0F;
        mask_unusable(*each);
    }
    const Photo one = merged({lengthy, brief});
    EXPECT_TRUE(one.masked[203 * 400 + 103]);
    const LightSpot spot = find_light(one);
    EXPECT_EQ(spot.pixels, 49U);
    EXPECT_DOUBLE_EQ(spot.column, 103.5);  // px, of a square of 7 from 100
    EXPECT_DOUBLE_EQ(spot.row, 203.5);
}

}  // namespace
}  // namespace ghostlight
