#include "core/flare/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ghostlight {
namespace {

TEST(ToneMap, SrgbEncodingAtItsKnownPoints) {
    EXPECT_EQ(srgb_encoded(0.0f), 0.0f);
    EXPECT_EQ(srgb_encoded(1.0f), 1.0f);
    EXPECT_NEAR(srgb_encoded(0.5f), 0.735357f, 1e-5f);
    EXPECT_NEAR(srgb_encoded(0.0031308f), 0.04045f, 1e-6f);
    EXPECT_NEAR(srgb_encoded(0.0031309f), srgb_encoded(0.0031307f), 1e-5f);
    EXPECT_EQ(srgb_encoded(-1.0f), 0.0f);
    EXPECT_EQ(srgb_encoded(std::nanf("")), 0.0f);
}

TEST(ToneMap, BelowTheShoulderItIsTheEncodingAlone) {
    const auto shown = tone_mapped({0.1f, 0.2f, 0.4f}, 1.0);
    EXPECT_NEAR(shown[0], srgb_encoded(0.2f), 1e-6f);
    EXPECT_NEAR(shown[1], srgb_encoded(0.4f), 1e-6f);
    EXPECT_NEAR(shown[2], srgb_encoded(0.8f), 1e-6f);
}

float decoded(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

TEST(ToneMap, TheShoulderKeepsHueAndOrder) {
    float before = 0.0f;
    for (const float brightness : {0.5f, 0.79f, 0.81f, 1.0f, 1.5f, 2.5f}) {
        const auto shown = tone_mapped({brightness, 0.5f * brightness, 0.25f * brightness}, 0.0);
        EXPECT_GT(shown[0], before);
        EXPECT_LE(shown[0], 1.0f);
        EXPECT_NEAR(decoded(shown[1]) / decoded(shown[0]), 0.5f, 1e-4f);
        EXPECT_NEAR(decoded(shown[2]) / decoded(shown[0]), 0.25f, 1e-4f);
        before = shown[0];
    }
}

TEST(ToneMap, OddValuesStayWithinTheDisplay) {
    for (const float value : {-1.0f, 1e30f, std::numeric_limits<float>::infinity()}) {
        for (const float channel : tone_mapped({value, 0.1f, 0.0f}, 3.0)) {
            EXPECT_GE(channel, 0.0f);
            EXPECT_LE(channel, 1.0f);
        }
    }
}

TEST(ToneCurves, LinearIsCutOffAndLogIsEvenInStops) {
    const auto gray = [](float value, double ev, ToneCurve curve) {
        return tone_mapped({value, value, value}, ev, curve)[1];
    };
    // sRGB of 0.9, by the standard's formula, and nothing above white.
    EXPECT_NEAR(gray(0.45f, 1.0, ToneCurve::linear), 1.055 * std::pow(0.9, 1 / 2.4) - 0.055, 1e-5);
    EXPECT_EQ(gray(3.0f, 0.0, ToneCurve::linear), 1.0f);
    for (int stop = 0; stop <= 8; ++stop)
        EXPECT_NEAR(gray(std::exp2(-static_cast<float>(stop)), 0.0, ToneCurve::log),
                    1.0 - stop / 8.0, 1e-4);
    EXPECT_EQ(gray(0.0f, 0.0, ToneCurve::log), 0.0f);
    EXPECT_EQ(tone_mapped({0.3f, 2.0f, 0.1f}, 0.5, ToneCurve::soft),
              tone_mapped({0.3f, 2.0f, 0.1f}, 0.5));
}

}  // namespace
}  // namespace ghostlight
