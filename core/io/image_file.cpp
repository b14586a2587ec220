#include "core/io/image_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/error.h"
#include "core/flare/tone_map.h"
#include "core/io/aside_file.h"

namespace ghostlight {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why) {
    throw Error({.problem = "the picture cannot be written: " + why,
                 .file = file.string(),
                 .where = {},
                 .found = {},
                 .expected = {}});
}

void check(const FlareImage& image, const std::filesystem::path& file) {
    if (image.width_px < 1 || image.height_px < 1) fail(file, "it is empty");
    const auto pixels =
        static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
    if (image.rgb.size() != 3 * pixels || image.irradiance.size() != pixels)
        fail(file,
             fmt::format("its data do not fit {} × {} pixels", image.width_px, image.height_px));
}

void describe(OIIO::ImageSpec& spec, const FlareImage& image, const std::string& description) {
    spec.attribute("Software", "Ghostlight " GHOSTLIGHT_VERSION);
    if (!description.empty()) spec.attribute("ImageDescription", description);
    spec.attribute("ghostlight:sensor_width_mm", static_cast<float>(image.sensor_width_mm));
    spec.attribute("ghostlight:sensor_height_mm", static_cast<float>(image.sensor_height_mm));
    spec.attribute("ghostlight:flux_mm2", static_cast<float>(image.flux_mm2));
    spec.attribute("ghostlight:ghosts", static_cast<int>(image.ghosts));
}

/// The format is named, since the file aside does not end in its name.
void write(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* data,
           const std::filesystem::path& file) {
    AsideFile aside(file);
    const auto out = OIIO::ImageOutput::create(format);
    if (!out) fail(file, OIIO::geterror());
    if (!out->open(aside.path().string(), spec) || !out->write_image(type, data) || !out->close())
        fail(file, out->geterror());
    aside.commit();
}

}  // namespace

void write_exr(const FlareImage& image, const std::filesystem::path& file,
               const std::string& description) {
    check(image, file);
    const std::vector<float> rgb = upright_picture(image.rgb, image.width_px, image.height_px, 3);
    const std::vector<float> irradiance =
        upright_picture(image.irradiance, image.width_px, image.height_px, 1);
    std::vector<float> channels;
    channels.reserve(4 * irradiance.size());
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        channels.insert(channels.end(), {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]});
        channels.push_back(irradiance[i]);
    }
    OIIO::ImageSpec spec(image.width_px, image.height_px, 4, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"R", "G", "B", "irradiance.Y"};
    spec.alpha_channel = -1;
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    // Rec. 709 primaries and D65: x, y of red, green, blue and white.
    const float chromaticities[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities);
    describe(spec, image, description);
    write("openexr", spec, OIIO::TypeDesc::FLOAT, channels.data(), file);
}

void write_png(const FlareImage& image, double exposure_ev, const std::filesystem::path& file,
               const std::string& description) {
    check(image, file);
    const std::vector<float> rgb = upright_picture(image.rgb, image.width_px, image.height_px, 3);
    std::vector<std::uint8_t> bytes(rgb.size());
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        const std::array<float, 3> shown =
            tone_mapped({rgb[i], rgb[i + 1], rgb[i + 2]}, exposure_ev);
        for (std::size_t c = 0; c < 3; ++c)
            bytes[i + c] = static_cast<std::uint8_t>(std::lround(255.0f * shown[c]));
    }
    OIIO::ImageSpec spec(image.width_px, image.height_px, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("ghostlight:exposure_ev", static_cast<float>(exposure_ev));
    describe(spec, image, description);
    write("png", spec, OIIO::TypeDesc::UINT8, bytes.data(), file);
}

}  // namespace ghostlight
