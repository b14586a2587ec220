#include "render/picture_frame.h"

#include <gtest/gtest.h>

namespace ghostlight {
namespace {

constexpr double rounding = 1e-12;  // px or mm, of a few operations in double

TEST(PictureFrame, FillsTheViewportAlongTheTighterSide) {
    const PictureFrame wide = framed(1000.0, 400.0, 36.0, 24.0);
    EXPECT_DOUBLE_EQ(wide.height_px, 400.0);
    EXPECT_DOUBLE_EQ(wide.width_px, 600.0);
    EXPECT_DOUBLE_EQ(wide.left_px, 200.0);
    EXPECT_DOUBLE_EQ(wide.top_px, 0.0);
    const PictureFrame tall = framed(360.0, 1000.0, 36.0, 24.0);
    EXPECT_DOUBLE_EQ(tall.width_px, 360.0);
    EXPECT_DOUBLE_EQ(tall.height_px, 240.0);
    EXPECT_DOUBLE_EQ(tall.top_px, 380.0);
}

TEST(PictureFrame, PictureRightIsMinusXAndTopIsMinusY) {
    const PictureFrame frame = framed(360.0, 240.0, 36.0, 24.0);
    const glm::dvec2 corner = frame.sensor_from_view({0.0, 0.0});
    EXPECT_NEAR(corner.x, 18.0, rounding);
    EXPECT_NEAR(corner.y, -12.0, rounding);
    const glm::dvec2 low_right = frame.view_from_sensor({-18.0, 12.0});
    EXPECT_NEAR(low_right.x, 360.0, rounding);
    EXPECT_NEAR(low_right.y, 240.0, rounding);
}

TEST(PictureFrame, GoesThereAndBackAtAnyZoom) {
    const PictureFrame frame = framed(731.0, 517.0, 23.5, 15.6, {3.7, {4.1, -2.2}});
    for (const glm::dvec2 point : {glm::dvec2(0.0, 0.0), {11.0, -7.0}, {-300.0, 90.0}}) {
        const glm::dvec2 back = frame.sensor_from_view(frame.view_from_sensor(point));
        EXPECT_NEAR(back.x, point.x, 1e-10);
        EXPECT_NEAR(back.y, point.y, 1e-10);
    }
}

TEST(PictureFrame, ZoomPutsItsCentreInTheMiddleOfTheViewport) {
    const PictureFrame frame = framed(600.0, 400.0, 36.0, 24.0, {8.0, {5.0, 3.0}});
    const glm::dvec2 middle = frame.view_from_sensor({5.0, 3.0});
    EXPECT_NEAR(middle.x, 300.0, 1e-9);
    EXPECT_NEAR(middle.y, 200.0, 1e-9);
}

TEST(PictureFrame, ScalesWithTheDisplay) {
    const PictureFrame logical = framed(600.0, 400.0, 36.0, 24.0, {2.0, {1.0, 1.0}});
    const PictureFrame device = framed(900.0, 600.0, 36.0, 24.0, {2.0, {1.0, 1.0}});
    const PictureFrame scaled = logical.scaled(1.5);
    EXPECT_NEAR(scaled.left_px, device.left_px, 1e-9);
    EXPECT_NEAR(scaled.top_px, device.top_px, 1e-9);
    EXPECT_NEAR(scaled.width_px, device.width_px, 1e-9);
    EXPECT_NEAR(scaled.height_px, device.height_px, 1e-9);
}

}  // namespace
}  // namespace ghostlight
