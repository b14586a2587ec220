#include "core/io/image_file.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "core/flare/tone_map.h"
#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

namespace fs = std::filesystem;

class ImageFile : public testing::Test {
   protected:
    ImageFile() {
        std::string name = (fs::temp_directory_path() / "ghostlight_image_XXXXXX").string();
        folder = ::mkdtemp(name.data());
        image.width_px = 3;
        image.height_px = 2;
        for (int i = 0; i < 6; ++i) {
            const float value = 0.1f * static_cast<float>(i + 1);
            image.irradiance.push_back(value);
            image.rgb.insert(image.rgb.end(), {value, 2e-9f * value, 1e5f * value});
        }
    }
    ~ImageFile() override { fs::remove_all(folder); }

    fs::path folder;
    FlareImage image;
};

TEST_F(ImageFile, ExrHoldsTheFloatsUpright) {
    const fs::path file = folder / "flare.exr";
    write_exr(image, file,
              {.lens = "a lens",
               .configuration = {},
               .spectrum = "D65",
               .wavelengths_nm = {450, 550.5},
               .light = {5.0, 90.0}});
    const auto in = OIIO::ImageInput::open(file.string());
    ASSERT_TRUE(in);
    const OIIO::ImageSpec& spec = in->spec();
    EXPECT_EQ(spec.width, 3);
    EXPECT_EQ(spec.height, 2);
    EXPECT_EQ(spec.format, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT));
    EXPECT_EQ(spec.get_string_attribute("ImageDescription"),
              "a lens, D65, field 5 deg, azimuth 90 deg");
    EXPECT_EQ(spec.get_string_attribute("ghostlight:wavelengths_nm"), "450 550.5");
    EXPECT_EQ(spec.get_string_attribute("Software").substr(0, 11), "Ghostlight ");
    std::vector<float> data(24);
    ASSERT_TRUE(in->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, data.data()));
    const std::vector<float> upright = upright_picture(image.irradiance, 3, 2, 1);
    const auto channel = [&](const char* name) {
        return static_cast<std::size_t>(spec.channelindex(name));
    };
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(data[4 * i + channel("irradiance.Y")], upright[i]);
        EXPECT_EQ(data[4 * i + channel("R")], upright[i]);
        EXPECT_EQ(data[4 * i + channel("G")], 2e-9f * upright[i]);
        EXPECT_EQ(data[4 * i + channel("B")], 1e5f * upright[i]);
    }
}

TEST_F(ImageFile, PngIsTheToneMappedPicture) {
    const fs::path file = folder / "flare.png";
    write_display(image, 0.5, file);
    const auto in = OIIO::ImageInput::open(file.string());
    ASSERT_TRUE(in);
    ASSERT_EQ(in->spec().nchannels, 3);
    std::vector<unsigned char> data(18);
    ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, data.data()));
    const std::vector<float> upright = upright_picture(image.rgb, 3, 2, 3);
    for (std::size_t i = 0; i < 18; i += 3) {
        const auto shown = tone_mapped({upright[i], upright[i + 1], upright[i + 2]}, 0.5);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_EQ(data[i + c], std::lround(255.0f * shown[c])) << i + c;
    }
}

TEST_F(ImageFile, AFailingWriteLeavesNothing) {
    error_of([&] { write_exr(image, folder / "none" / "flare.exr"); });
    image.rgb.pop_back();
    error_of([&] { write_exr(image, folder / "flare.exr"); });
    error_of([&] { write_display(FlareImage{}, 0.0, folder / "flare.png"); });
    EXPECT_TRUE(fs::is_empty(folder));
}

}  // namespace
}  // namespace ghostlight
