// What is painted, against areas in closed form; texts against themselves.

#include "core/fit/photo_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

Photo empty_photo() {
    Photo photo;
    photo.width_px = 400;
    photo.height_px = 300;
    photo.rgb.assign(3 * photo.pixels(), 0.1F);
    photo.masked.assign(photo.pixels(), 0);
    return photo;
}

/// Of the upright file, which is mirrored left to right against the sensor's frame.
bool is_masked(const Photo& photo, int x, int y) {
    return photo.masked[static_cast<std::size_t>(y * photo.width_px + photo.width_px - 1 - x)] != 0;
}

TEST(PhotoMask, APolygonMasksItsArea) {
    Photo photo = empty_photo();
    mask_region(photo, {.points = {{20.0, 30.0}, {320.0, 60.0}, {100.0, 250.0}}, .brush_px = 0.0});
    // Half the cross product; pixels along the outline are in or out by their middles, whose sum
    // over some 900 px of outline scatters by less than 30.
    const double area = 0.5 * (300.0 * 220.0 - 80.0 * 30.0);
    EXPECT_NEAR(static_cast<double>(count_masked(photo).painted), area, 30.0);
    EXPECT_TRUE(is_masked(photo, 100, 100));
    EXPECT_FALSE(is_masked(photo, 299, 200));
    EXPECT_FALSE(is_masked(photo, 10, 30));
}

TEST(PhotoMask, ABrushMasksAStadium) {
    Photo photo = empty_photo();
    const MaskRegion stroke = {.points = {{60.0, 80.0}, {260.0, 200.0}}, .brush_px = 40.0};
    mask_region(photo, stroke);
    const double length = std::hypot(200.0, 120.0);
    const double area = 40.0 * length + std::numbers::pi * 20.0 * 20.0;
    EXPECT_NEAR(static_cast<double>(count_masked(photo).painted), area, 30.0);  // px, as above
    for (int y = 0; y < photo.height_px; ++y)
        for (int x = 0; x < photo.width_px; ++x)
            ASSERT_EQ(is_masked(photo, x, y), covers(stroke, {x + 0.5, y + 0.5})) << x << ' ' << y;
}

TEST(PhotoMask, ADotOfTheBrushIsADisc) {
    Photo photo = empty_photo();
    mask_region(photo, {.points = {{200.0, 150.0}}, .brush_px = 60.0});
    EXPECT_NEAR(static_cast<double>(count_masked(photo).painted), std::numbers::pi * 900.0, 20.0);
}

TEST(PhotoMask, WhatCrossesItselfIsEvenOdd) {
    // A square traced twice encloses nothing; a bow tie is two triangles.
    const std::vector<FilePoint> square = {{10, 10}, {110, 10}, {110, 110}, {10, 110}};
    std::vector<FilePoint> twice = square;
    twice.insert(twice.end(), square.begin(), square.end());
    Photo photo = empty_photo();
    mask_region(photo, {.points = twice, .brush_px = 0.0});
    EXPECT_EQ(count_masked(photo).painted, 0U);
    mask_region(photo, {.points = {{10, 10}, {110, 110}, {110, 10}, {10, 110}}, .brush_px = 0.0});
    EXPECT_NEAR(static_cast<double>(count_masked(photo).painted), 5000.0, 110.0);  // a diagonal
}

TEST(PhotoMask, RegionsReachBeyondTheFrameWithoutHarm) {
    Photo photo = empty_photo();
    mask_region(photo, {.points = {{-50, -50}, {500, -50}, {500, 10}, {-50, 10}}, .brush_px = 0.0});
    mask_region(photo, {.points = {{-10, 290}, {900, 290}}, .brush_px = 4.0});
    EXPECT_EQ(count_masked(photo).painted, 400U * 10U + 400U * 4U);
}

TEST(PhotoMask, WhatWasMaskedBeforeKeepsItsReason) {
    Photo photo = empty_photo();
    photo.masked[0] = mask_reason::saturated;
    mask_outside(photo, {.left_px = 100.0, .top_px = 50.0, .width_px = 200.0, .height_px = 150.0});
    EXPECT_EQ(photo.masked[0], mask_reason::saturated);
    EXPECT_EQ(count_masked(photo).cropped, 400U * 300U - 200U * 150U - 1U);
    EXPECT_FALSE(is_masked(photo, 100, 50));
    EXPECT_TRUE(is_masked(photo, 99, 50));
    EXPECT_TRUE(is_masked(photo, 300, 199));
    EXPECT_NE(error_of([&] {
                  mask_outside(
                      photo, {.left_px = 500.0, .top_px = 0.0, .width_px = 9.0, .height_px = 9.0});
              }).problem.find("nothing of the photograph"),
              std::string::npos);
}

TEST(PhotoMask, TextsReadBack) {
    const std::vector<MaskRegion> regions = {
        {.points = {{1.5, 2.0}, {30.1, 4.0}, {7.0, 80.3}}, .brush_px = 0.0},
        {.points = {{10.0, 20.0}}, .brush_px = 12.5}};
    EXPECT_EQ(text_of(regions), "1.5,2,30.1,4,7,80.3/brush:12.5:10,20");
    EXPECT_EQ(parse_mask_regions(text_of(regions)), regions);
    EXPECT_TRUE(parse_mask_regions("").empty());
    const FileBox box = {.left_px = 1.0, .top_px = 2.0, .width_px = 30.5, .height_px = 4.0};
    EXPECT_EQ(parse_file_box(text_of(box)), box);
    for (const char* wrong : {"1,2,3,4", "1,2,3,4,5", "brush:0:1,2", "brush:5:", "1,2,3,4,5,x"})
        EXPECT_NE(error_of([&] { parse_mask_regions(wrong); }).expected.find("brush"),
                  std::string::npos)
            << wrong;
    for (const char* wrong : {"1,2,3", "1,2,0,4", "a"})
        EXPECT_FALSE(error_of([&] { parse_file_box(wrong); }).expected.empty()) << wrong;
}

}  // namespace
}  // namespace ghostlight
