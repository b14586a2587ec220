#include "core/flare/false_color.h"

#include <gtest/gtest.h>

namespace ghostlight {
namespace {

// What makes a scale readable without colours: its lightness rises from end to end.
TEST(FalseColor, LightnessRises) {
    float before = -1.0F;
    for (int k = 0; k <= 200; ++k) {
        const auto [r, g, b] = false_color(static_cast<float>(k) / 200.0F);
        const float luma = 0.299F * r + 0.587F * g + 0.114F * b;
        EXPECT_GT(luma, before) << k;
        before = luma;
    }
    EXPECT_EQ(false_color(-1.0F), false_colors.front());
    EXPECT_EQ(false_color(2.0F), false_colors.back());
}

TEST(FalseColor, PlacesAreLogarithmic) {
    EXPECT_FLOAT_EQ(log_place(1e-3F, -6.0F, 0.0F), 0.5F);
    EXPECT_EQ(log_place(0.0F, -6.0F, 0.0F), 0.0F);
    EXPECT_EQ(log_place(10.0F, -6.0F, 0.0F), 1.0F);
}

}  // namespace
}  // namespace ghostlight
