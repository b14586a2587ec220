#include "core/io/stop_image_file.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "core/io/lens_file.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

namespace fs = std::filesystem;

class StopImageFile : public testing::Test {
   protected:
    StopImageFile() {
        std::string name = (fs::temp_directory_path() / "ghostlight_stop_XXXXXX").string();
        folder = ::mkdtemp(name.data());
    }
    ~StopImageFile() override { fs::remove_all(folder); }

    fs::path write(const char* name, int width, int height, int channels, OIIO::TypeDesc type,
                   const std::vector<float>& values) const {
        const fs::path file = folder / name;
        const auto out = OIIO::ImageOutput::create(file.string());
        OIIO::ImageSpec spec(width, height, channels, type);
        EXPECT_TRUE(out->open(file.string(), spec)) << out->geterror();
        EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data())) << out->geterror();
        out->close();
        return file;
    }
    fs::path folder;
};

TEST_F(StopImageFile, EightAndSixteenBitsAlphaAndColour) {
    const std::vector<float> gray = {1.0F, 0.0F, 0.5F, 1.0F};
    for (const auto& [name, type] : {std::pair{"8.png", OIIO::TypeDesc(OIIO::TypeDesc::UINT8)},
                                     {"16.png", OIIO::TypeDesc(OIIO::TypeDesc::UINT16)},
                                     {"16.tif", OIIO::TypeDesc(OIIO::TypeDesc::UINT16)}}) {
        const StopImage image = read_stop_image(write(name, 2, 2, 1, type, gray));
        // From the lowest row.
        const std::vector<float> expected = {0.5F, 1.0F, 1.0F, 0.0F};
        for (std::size_t k = 0; k < 4; ++k)
            EXPECT_NEAR(image.picture->open()[k], expected[k], 1.0 / 255.0) << name;
    }
    // Open where it is white and opaque; the mean of the colours.
    const StopImage image =
        read_stop_image(write("alpha.png", 4, 2, 4, OIIO::TypeDesc::UINT8,
                              {1, 1, 1, 1, /**/ 1, 1, 1, 1, /**/ 1, 1, 1, 0, /**/ 1, 1, 1, 0,
                               1, 1, 1, 1, /**/ 1, 1, 1, 1, /**/ 1, 1, 1, 0, /**/ 1, 1, 1, 0}));
    EXPECT_NEAR(image.picture->open_at(-0.9, 0.2), 1.0, 1e-3);
    EXPECT_NEAR(image.picture->open_at(0.9, 0.2), 0.0, 1e-3);
    const StopImage red =
        read_stop_image(write("red.png", 1, 1, 3, OIIO::TypeDesc::UINT8, {1.0F, 0.5F, 0.0F}));
    EXPECT_NEAR(red.picture->open()[0], 0.5, 1.0 / 255.0);
}

TEST_F(StopImageFile, WhatIsNoUsableImageIsRefused) {
    const fs::path text = folder / "text.png";
    write_file_safely(text, "no image");
    EXPECT_EQ(error_of([&] { read_stop_image(text); }).file, text.string());
    EXPECT_NE(error_of([&] { read_stop_image(folder / "absent.png"); }).problem, "");
    const fs::path empty = folder / "empty.png";
    write_file_safely(empty, "");
    EXPECT_NE(error_of([&] { read_stop_image(empty); }).problem, "");
    const fs::path black =
        write("black.png", 4, 4, 1, OIIO::TypeDesc::UINT8, std::vector<float>(16, 0.0F));
    EXPECT_EQ(error_of([&] { read_stop_image(black); }).problem,
              "the stop's image lets no light through");
    const fs::path wide =
        write("wide.tif", 20'000, 1, 1, OIIO::TypeDesc::UINT8, std::vector<float>(20'000, 1.0F));
    EXPECT_EQ(error_of([&] { read_stop_image(wide); }).problem, "the stop's image is too large");
    const fs::path nan =
        write("nan.tif", 1, 1, 1, OIIO::TypeDesc::FLOAT, {std::numeric_limits<float>::quiet_NaN()});
    EXPECT_EQ(error_of([&] { read_stop_image(nan); }).problem,
              "the stop's image has a value that is no number");
}

TEST_F(StopImageFile, LensNamesItRelativeToItself) {
    fs::create_directory(folder / "masks");
    fs::rename(write("disc.png", 2, 2, 1, OIIO::TypeDesc::UINT8, {1, 1, 1, 0}),
               folder / "masks/disc.png");
    Prescription lens = lens_of({row(50.0, 3.0, 1.5), row(-50.0, 40.0, 1.0)});
    lens.stop.image = read_stop_image(folder / "masks/disc.png");
    lens.stop.dirt = {.dust_coverage = 0.02,
                      .dust_smallest_mm = 0.01,
                      .dust_largest_mm = 0.3,
                      .scratches = 12,
                      .scratch_thinnest_mm = 0.001,
                      .scratch_widest_mm = 0.1,
                      .fingerprint = 0.25,
                      .seed = 5};
    const fs::path file = folder / "lens.json";
    write_lens(lens, file);
    std::string text = lens_to_json(lens, folder);
    EXPECT_NE(text.find("\"image\": \"masks/disc.png\""), std::string::npos) << text;
    const Prescription again = read_lens(file).lens;
    EXPECT_EQ(again, lens);
    EXPECT_EQ(again.stop.dirt.seed, 5);
    // Moved together with its image it still opens; alone it says what is missing.
    const fs::path elsewhere = folder / "elsewhere";
    fs::create_directory(elsewhere);
    fs::copy(folder / "masks", elsewhere / "masks");
    fs::copy(file, elsewhere / "lens.json");
    EXPECT_EQ(*read_lens(elsewhere / "lens.json").lens.stop.image->picture,
              *lens.stop.image->picture);
    fs::remove_all(elsewhere / "masks");
    const auto parts = error_of([&] { read_lens(elsewhere / "lens.json"); });
    EXPECT_EQ(parts.where, "stop.image");
    EXPECT_NE(parts.problem.find("disc.png"), std::string::npos);
    EXPECT_EQ(parts.file, (elsewhere / "lens.json").string());
}

TEST(StopDirt, WhatIsWrongIsNamed) {
    struct Case {
        const char *dirt, *where;
    };
    for (const Case& each : {Case{R"({"dust_coverage": 0.7})", "stop.dirt.dust_coverage"},
                             Case{R"({"dust_coverage": -1})", "stop.dirt.dust_coverage"},
                             Case{R"({"dust_smallest_mm": 0})", "stop.dirt.dust_smallest_mm"},
                             Case{R"({"dust_smallest_mm": 1})", "stop.dirt.dust_smallest_mm"},
                             Case{R"({"scratches": 1000000})", "stop.dirt.scratches"},
                             Case{R"({"scratches": 1.5})", "stop.dirt.scratches"},
                             Case{R"({"fingerprint": 2})", "stop.dirt.fingerprint"},
                             Case{R"({"seed": -3})", "stop.dirt.seed"}, Case{"7", "stop.dirt"}}) {
        const std::string text =
            R"({"ghostlight_lens": 1, "name": "x", "stop": {"surface": 1, "dirt": )" +
            std::string(each.dirt) +
            R"(}, "sensor": {"distance_mm": 10}, "surfaces": [{"radius_mm": 20, "index": 1.5,
                 "semi_diameter_mm": 5}]})";
        EXPECT_EQ(error_of([&] { lens_from_json(text, "x.json"); }).where, each.where) << text;
    }
}

}  // namespace
}  // namespace ghostlight
