#include "core/flare/light_track.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/flare/image_place.h"
#include "core/optics/trace.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr int width = 40, height = 30;

std::vector<float> dark() {
    return std::vector<float>(static_cast<std::size_t>(width * height) * 3, 0.1F);
}
void set(std::vector<float>& rgb, int x, int y, float r, float g, float b) {
    float* at = &rgb[static_cast<std::size_t>(y * width + x) * 3];
    at[0] = r;
    at[1] = g;
    at[2] = b;
}

TEST(LightBlobs, AreTheirExcessOverTheThreshold) {
    auto rgb = dark();
    set(rgb, 10, 5, 5, 5, 5);
    set(rgb, 11, 6, 3, 3, 3);  // touches by a corner: one light
    set(rgb, 30, 20, 40, 20, 0);
    const auto blobs = find_blobs(rgb, width, height, 1.0);
    ASSERT_EQ(blobs.size(), 2U);
    EXPECT_NEAR(blobs[1].excess[0], 4.0 + 2.0, 1e-6);
    EXPECT_NEAR(blobs[1].x_px, (4.0 * 10.5 + 2.0 * 11.5) / 6.0, 1e-6);
    EXPECT_NEAR(blobs[1].y_px, (4.0 * 5.5 + 2.0 * 6.5) / 6.0, 1e-6);
    // Its colour is kept.
    EXPECT_NEAR(blobs[0].excess[0] / blobs[0].excess[1], 2.0, 1e-6);
    EXPECT_TRUE(find_blobs(rgb, width, height, 50.0).empty());
}

TEST(LightBlobs, APixelEntersFromZero) {
    auto rgb = dark();
    set(rgb, 10, 5, 1.001F, 1.001F, 1.001F);
    const auto blobs = find_blobs(rgb, width, height, 1.0);
    ASSERT_EQ(blobs.size(), 1U);
    EXPECT_LT(blobs[0].luminance(), 0.0011);
}

LightBlob at(double x, double y, double light) {
    LightBlob blob;
    blob.x_px = x;
    blob.y_px = y;
    blob.excess = {light, light, light};
    return blob;
}

TEST(LightTracks, ALightThatWasHiddenIsTheSame) {
    std::vector<std::vector<LightBlob>> frames(20);
    for (std::size_t k = 0; k < 20; ++k) {
        if (k < 6 || k > 12)
            frames[k].push_back(at(10.0 + 5.0 * static_cast<double>(k), 20.0, 3.0));
        frames[k].push_back(at(200.0 - 4.0 * static_cast<double>(k), 80.0, 1.0));
    }
    const auto tracks = track_lights(frames, {.most = 4, .farthest_px = 8.0});
    ASSERT_EQ(tracks.size(), 2U);
    for (std::size_t k = 0; k < 20; ++k) {
        EXPECT_EQ(tracks[0].frames[k].luminance() > 0.0, k < 6 || k > 12) << k;
        EXPECT_NEAR(tracks[0].frames[k].x_px, 10.0 + 5.0 * static_cast<double>(k), 1e-9) << k;
        EXPECT_NEAR(tracks[1].frames[k].luminance(), 1.0, 1e-9) << k;
    }
}

TEST(LightTracks, SpecksAreNoLights) {
    std::vector<std::vector<LightBlob>> frames(5, {at(10, 10, 100.0), at(50, 50, 0.5)});
    EXPECT_EQ(track_lights(frames, {}).size(), 1U);
    EXPECT_EQ(track_lights({{}, {}}, {}).size(), 0U);
}

TEST(ImagePlace, IsWhereTheChiefRayLands) {
    for (const char* name : {"tessar_brendel_100_f2.8", "fisheye_nikkor_10.5_f2.8"}) {
        const OpticalSystem system = compile(bundled(name), 587.5618);
        const ImagePlace place(system);
        for (const double field : {2.0, 7.0}) {
            const FieldPoint point = field_curves(system, field, 2).back();
            const auto light =
                place.light_at(0.6 * point.image_height_mm, 0.8 * point.image_height_mm);
            ASSERT_TRUE(light) << name;
            EXPECT_NEAR(light->field_deg, field, 1e-3) << name;  // linear over a quarter degree
            const double turn = std::remainder(light->azimuth_deg - 53.1301, 360.0);
            EXPECT_NEAR(turn, 0.0, 1e-3) << name;
        }
        EXPECT_FALSE(place.light_at(500.0, 0.0));
    }
}

}  // namespace
}  // namespace ghostlight
