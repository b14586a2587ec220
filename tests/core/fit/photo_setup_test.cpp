// Photographs placed on the sensor, against the lens itself: where a light's image lies comes back
// as its direction, however the picture is cropped, shifted and turned.

#include "core/fit/photo_setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/fit/fit_setup.h"
#include "core/fit/light_place.h"
#include "core/io/fit_setup_json.h"
#include "core/io/lens_file.h"
#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

Prescription tessar() { return read_lens(lens_folder() / "tessar_brendel_100_f2.8.json").lens; }

Photo dim_photo(int width_px, int height_px) {
    Photo photo;
    photo.width_px = width_px;
    photo.height_px = height_px;
    photo.file = "photo.exr";
    photo.rgb.assign(3 * photo.pixels(), 0.01F);
    photo.masked.assign(photo.pixels(), 0);
    photo.noise = {.shot = 1e-5, .read = 1e-8, .estimated = false};
    return photo;
}

TEST(PhotoSetup, ALightClickedInATurnedCropHasItsOwnDirection) {
    const Prescription lens = tessar();
    const OpticalSystem system = compile(lens, d_line_nm);
    const LightDirection light{4.0, 60.0};
    const auto image = image_of_light(system, light);
    ASSERT_TRUE(image);
    FitPhotoSetup setup;
    setup.width_mm = 0.8 * lens.sensor.width_mm;
    setup.axis = FilePoint{150.0, 130.0};
    setup.rotation_deg = 12.0;
    // By hand: a camera that is turned counterclockwise sees the sensor's points turned clockwise.
    const double pitch_mm = *setup.width_mm / 320.0, turn = rad_from_deg(12.0);
    const double x = std::cos(turn) * image->x_mm + std::sin(turn) * image->y_mm,
                 y = std::cos(turn) * image->y_mm - std::sin(turn) * image->x_mm;
    setup.light = text_of(FilePoint{150.0 - x / pitch_mm, 130.0 + y / pitch_mm});
    Notes notes;
    const FitPhoto placed = fit_photo(dim_photo(320, 200), setup, lens, notes);
    EXPECT_NEAR(placed.light.field_deg, light.field_deg, 1e-3);
    EXPECT_NEAR(placed.light.azimuth_deg, light.azimuth_deg, 0.02);
    const PhotoPixel back = pixel_at(placed, image->x_mm, image->y_mm);
    EXPECT_NEAR(back.column, 320.0 - (150.0 - x / pitch_mm), 1e-9);
    EXPECT_NEAR(back.row, 130.0 + y / pitch_mm, 1e-9);
}

TEST(PhotoSetup, OnlyAPictureOfTheWholeSensorNeedsItsShape) {
    const Prescription lens = tessar();
    FitPhotoSetup setup;
    setup.light = "deg:4:90";
    Notes notes;
    const Error::Parts error =
        error_of([&] { fit_photo(dim_photo(300, 300), setup, lens, notes); });
    EXPECT_NE(error.problem.find("sensor's shape"), std::string::npos);
    setup.width_mm = 20.0;
    EXPECT_EQ(fit_photo(dim_photo(300, 300), setup, lens, notes).place.sensor_width_mm, 20.0);
}

TEST(PhotoSetup, TheGlowAboutTheLightIsMaskedAsFarAsItReaches) {
    Photo photo = dim_photo(600, 400);
    constexpr double level = 0.01, glow = 400.0;
    for (int y = 0; y < photo.height_px; ++y)
        for (int x = 0; x < photo.width_px; ++x) {
            const double r = std::max(2.0, std::hypot(x + 0.5 - 250.0, y + 0.5 - 180.0));
            for (std::size_t c = 0; c < 3; ++c)
                photo.rgb[3 * static_cast<std::size_t>(y * photo.width_px + x) + c] =
                    static_cast<float>(level + level * glow * glow / (r * r * r * r));
        }
    // Half above the level: glow² / r⁴ = 1/2. A ring is 1.5 px; the level further out is its median
    // between 48 and 96 px, 1 % above `level`.
    const double reach_px = std::sqrt(glow) * std::pow(2.0, 0.25);
    EXPECT_NEAR(light_core_px(photo, 250.0, 180.0, 5.0), reach_px, 2.0);
    EXPECT_EQ(light_core_px(photo, 250.0, 180.0, 40.0), 40.5);  // the next ring
    // None: no more than asked for.
    EXPECT_NEAR(light_core_px(dim_photo(600, 400), 250.0, 180.0, 5.0), 5.0, 1.5);
}

TEST(PhotoSetup, EnteredSaturationAndNoiseReplaceTheFiles) {
    Photo photo = dim_photo(100, 80);
    photo.rgb[3 * 4040] = 0.6F;
    photo.saturation = 1.0;
    FitPhotoSetup setup;
    setup.saturation = 0.5;
    setup.noise = parse_noise("2e-4,3e-6");
    adjust_photo(photo, setup);
    EXPECT_EQ(count_masked(photo).saturated, 9U);  // with its neighbours
    EXPECT_EQ(photo.noise.shot, 2e-4);
    setup.saturation = 0.7;
    adjust_photo(photo, setup);
    EXPECT_EQ(count_masked(photo).saturated, 0U);
    EXPECT_EQ(count_masked(photo).hot, 1U);  // it stands out by more than ten σ
    for (const char* wrong : {"1e-4", "-1,0", "0,0", "a,b"})
        EXPECT_NE(error_of([&] { parse_noise(wrong); }).expected.find("SHOT,READ"),
                  std::string::npos);
}

FitSetup full_setup() {
    FitSetup setup;
    FitPhotoSetup& photo = setup.photos.emplace_back();
    photo.file = "/pictures/a.exr";
    photo.light = "12,34";
    photo.mask_file = "/pictures/mask.png";
    photo.masked = parse_mask_regions("1,2,3,4,5,6/brush:7:8,9");
    photo.crop = FileBox{1.0, 2.0, 300.0, 200.0};
    photo.width_mm = 30.0;
    photo.axis = FilePoint{150.5, 99.0};
    photo.rotation_deg = -1.5;
    photo.noise = PhotoNoise{.shot = 1e-4, .read = 2e-6, .estimated = false};
    photo.saturation = 0.9;
    setup.photos.emplace_back().file = "/pictures/b.exr";
    setup.vary = "center@1";
    setup.loss = FitLoss::tukey;
    setup.loss_scale = 6.0;
    setup.left_out = "5-3";
    setup.only = "5-3,7-2";
    setup.profiled = "center@1";
    setup.bootstrap = 20;
    return setup;
}

TEST(FitSetupJson, EverythingReadsBack) {
    const FitSetup setup = full_setup();
    EXPECT_EQ(fit_setup_from_json(fit_setup_to_json(setup)), setup);
    // Named from the lens's folder, and found from another.
    FitSetup moved = fit_setup_from_json(fit_setup_to_json(setup, "/pictures"), "/elsewhere");
    EXPECT_EQ(moved.photos.front().mask_file, "/elsewhere/mask.png");
    EXPECT_EQ(moved.photos.front().masked, setup.photos.front().masked);
    // What cannot be read is as at first.
    const FitSetup odd = fit_setup_from_json(
        R"({"photos": [{"file": "a.exr", "crop_px": "x", "rotation_deg": 1e9}], "loss": "mean"})");
    EXPECT_FALSE(odd.photos.front().crop);
    EXPECT_EQ(odd.photos.front().rotation_deg, 0.0);
    EXPECT_EQ(odd.loss, FitLoss::cauchy);
}

TEST(FitSetup, CommandNamesWhatIsNotUsual) {
    const std::string all = fit_command(full_setup(), "lens.json");
    for (const char* part :
         {"--photo /pictures/a.exr,/pictures/b.exr", "--light \"12,34;auto\"",
          "--photo-mask \"/pictures/mask.png,\"", "--mask-region \"1,2,3,4,5,6/brush:7:8,9;\"",
          "--crop \"1,2,300,200;\"", "--principal \"150.5,99;\"", "--rotation \"-1.5;0\"",
          "--profile center@1", "--bootstrap 20", "--loss tukey", "--leave-out 5-3",
          "--use-ghosts 5-3,7-2"})
        EXPECT_NE(all.find(part), std::string::npos) << part << " in " << all;
    FitSetup plain;
    plain.photos.emplace_back().file = "a.exr";
    plain.vary = "center@1";
    EXPECT_EQ(fit_command(plain, "lens.json"),
              "fit lens.json --photo a.exr --vary center@1 --spectrum \"D65\" --seed 1");
}

TEST(FitSetup, GhostsAreLeftOutByName) {
    const Prescription lens = tessar();
    const auto all = two_reflection_ghosts(compile(lens, d_line_nm));
    EXPECT_TRUE(ghosts_left_out("", "", lens).empty());
    EXPECT_EQ(ghosts_left_out("5-3, 7-2", "", lens), (std::vector<std::string>{"5-3", "7-2"}));
    const auto rest = ghosts_left_out("", "5-3", lens);
    EXPECT_EQ(rest.size(), all.size() - 1);
    EXPECT_EQ(std::ranges::count(rest, "5-3"), 0);
    EXPECT_EQ(ghosts_left_out("5-3", "5-3", lens).size(), all.size());
    EXPECT_FALSE(error_of([&] { ghosts_left_out("99-1", "", lens); }).problem.empty());
}

}  // namespace
}  // namespace ghostlight
