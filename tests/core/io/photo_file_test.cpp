// Photographs through files and back: every format gives the light that went in, within the step of
// its levels.

#include "core/io/photo_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

namespace fs = std::filesystem;

class PhotoFile : public testing::Test {
   protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "ghostlight_photo_XXXXXX").string();
        folder = mkdtemp(name.data());
    }
    void TearDown() override { fs::remove_all(folder); }

    /// Smooth, coloured, and other in every quarter, so that a turned picture is seen.
    static Photo ramp() {
        Photo photo;
        photo.width_px = 48;
        photo.height_px = 32;
        photo.rgb.resize(3 * photo.pixels());
        for (int y = 0; y < photo.height_px; ++y)
            for (int x = 0; x < photo.width_px; ++x) {
                float* rgb = &photo.rgb[3 * static_cast<std::size_t>(y * photo.width_px + x)];
                rgb[0] = 0.1F + 0.6F * static_cast<float>(x) / 48.0F;
                rgb[1] = 0.1F + 0.5F * static_cast<float>(y) / 32.0F;
                rgb[2] = 0.3F;
            }
        photo.noise = {.shot = 1e-4, .read = 1e-6, .estimated = false};
        photo.exposure_s = 0.02;
        photo.f_number = 4.0;
        photo.focal_length_mm = 50.0;
        return photo;
    }
    Photo through(const std::string& name, int bits) const {
        write_photo(ramp(), bits, folder / name);
        return read_photo(folder / name);
    }
    static double largest_difference(const Photo& a, const Photo& b) {
        double most = 0.0;
        for (std::size_t k = 0; k < a.rgb.size(); ++k)
            most = std::max(most, std::abs(static_cast<double>(a.rgb[k] - b.rgb[k])));
        return most;
    }
    fs::path folder;
};

/// Slope of the sRGB curve's inverse at the brightest value used, 0.7: a step of an encoded level
/// is at most so much light.
constexpr double srgb_slope = 2.0;

TEST_F(PhotoFile, EveryFormatGivesTheLightBack) {
    struct Case {
        const char* name;
        int bits;
        double step;  ///< of light between neighbouring levels, at most
    };
    for (const Case& each :
         {Case{"a.exr", 0, 1e-6}, Case{"a.tif", 16, 1.0 / 65535},
          Case{"a16.png", 16, srgb_slope / 65535}, Case{"a8.png", 8, srgb_slope / 255},
          // JPEG: quantised coefficients of blocks, some levels.
          Case{"a.jpg", 8, 8.0 * srgb_slope / 255}}) {
        const Photo read = through(each.name, each.bits);
        ASSERT_EQ(read.width_px, 48) << each.name;
        ASSERT_EQ(read.height_px, 32) << each.name;
        EXPECT_LT(largest_difference(read, ramp()), each.step) << each.name;
    }
}

TEST_F(PhotoFile, DataOfTheExposureComeBack) {
    const Photo read = through("a.exr", 0);
    ASSERT_TRUE(read.exposure_s && read.f_number && read.focal_length_mm);
    EXPECT_NEAR(*read.exposure_s, 0.02, 1e-6);
    EXPECT_NEAR(*read.f_number, 4.0, 1e-5);
    EXPECT_NEAR(*read.focal_length_mm, 50.0, 1e-4);
    EXPECT_NEAR(read.noise.shot, 1e-4, 1e-8);
    EXPECT_FALSE(read.noise.estimated);
}

TEST_F(PhotoFile, BadFilesAreRefusedWithWhatToDo) {
    EXPECT_NE(error_of([&] { read_photo(folder / "none.exr"); }).problem.find("no such photograph"),
              std::string::npos);
    for (const char* name : {"text.nef", "text.jpg", "text.exr"}) {
        std::ofstream(folder / name) << "not a picture";
        const Error::Parts error = error_of([&] { read_photo(folder / name); });
        EXPECT_FALSE(error.problem.empty()) << name;
        EXPECT_FALSE(error.expected.empty()) << name;
    }
    Photo black = ramp();
    std::ranges::fill(black.rgb, 0.0F);
    write_photo(black, 0, folder / "black.exr");
    EXPECT_NE(error_of([&] { read_photo(folder / "black.exr"); }).problem.find("black"),
              std::string::npos);
    std::ranges::fill(black.rgb, std::nanf(""));
    write_photo(black, 0, folder / "nan.exr");
    EXPECT_NE(error_of([&] { read_photo(folder / "nan.exr"); }).problem.find("number"),
              std::string::npos);
    std::ranges::fill(black.rgb, 1.0F);
    write_photo(black, 8, folder / "white.png");
    EXPECT_NE(error_of([&] { read_photo(folder / "white.png"); }).problem.find("saturated"),
              std::string::npos);
}

}  // namespace
}  // namespace ghostlight
