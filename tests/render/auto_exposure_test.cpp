#include "render/auto_exposure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ghostlight {
namespace {

FlareImage flat(float value) {
    FlareImage image;
    image.width_px = 40;
    image.height_px = 25;
    image.rgb.assign(3000, value);
    image.irradiance.assign(1000, value);
    return image;
}

constexpr double third = 1.0 / 3.0;

TEST(AutoExposure, ShowsAnEvenVeilAsMiddleGrey) {
    const double ev = auto_exposure_ev(flat(1e-4F));
    const double shown = 1e-4 * std::exp2(ev);
    EXPECT_LE(shown, 0.18 * (1.0 + 1e-6));
    EXPECT_GT(shown, 0.18 / std::exp2(third) * (1.0 - 1e-6));
    EXPECT_NEAR(ev * 3.0, std::round(ev * 3.0), 1e-9) << "whole thirds of a stop";
}

TEST(AutoExposure, PutsBrightGhostsAtTheEndOfTheLinearRange) {
    FlareImage image = flat(1e-6F);
    for (std::size_t i = 0; i < 3 * 100; ++i) {
        image.rgb[i] = 1e-3F;  // a tenth of the picture
    }
    const double shown = 1e-3 * std::exp2(auto_exposure_ev(image));
    EXPECT_LE(shown, 0.8 * (1.0 + 1e-6));
    EXPECT_GT(shown, 0.8 / std::exp2(third) * (1.0 - 1e-6));
}

TEST(AutoExposure, DoesNotFollowAFewBrightPixels) {
    FlareImage image = flat(1e-4F);
    for (std::size_t i = 0; i < 3 * 8; ++i) {
        image.rgb[i] = 5.0F;  // eight of a thousand
    }
    EXPECT_DOUBLE_EQ(auto_exposure_ev(image), auto_exposure_ev(flat(1e-4F)));
}

TEST(AutoExposure, DoesNotCountTheDark) {
    FlareImage image = flat(0.0F);
    for (std::size_t i = 0; i < 3; ++i) {
        image.rgb[i] = 1e-3F;
    }
    EXPECT_DOUBLE_EQ(auto_exposure_ev(image), auto_exposure_ev(flat(1e-3F)));
}

TEST(AutoExposure, IsZeroWithoutLight) {
    EXPECT_EQ(auto_exposure_ev(flat(0.0F)), 0.0);
    EXPECT_EQ(auto_exposure_ev(FlareImage{}), 0.0);
}

}  // namespace
}  // namespace ghostlight
