#include "core/io/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
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

void describe(OIIO::ImageSpec& spec, const FlareImage& image, const FlareOrigin& origin) {
    spec.attribute("Software", "Ghostlight " GHOSTLIGHT_VERSION);
    spec.attribute("ghostlight:unit", "irradiance / E0, E0 the light's across its beam");
    spec.attribute("ghostlight:sensor_width_mm", static_cast<float>(image.sensor_width_mm));
    spec.attribute("ghostlight:sensor_height_mm", static_cast<float>(image.sensor_height_mm));
    spec.attribute("ghostlight:flux_mm2", static_cast<float>(image.flux_mm2));
    spec.attribute("ghostlight:ghosts", static_cast<int>(image.ghosts));
    if (origin == FlareOrigin{}) return;
    spec.attribute("ImageDescription",
                   fmt::format("{}{}{}, {}, field {} deg, azimuth {} deg", origin.lens,
                               origin.configuration.empty() ? "" : ", ", origin.configuration,
                               origin.spectrum, origin.light.field_deg, origin.light.azimuth_deg));
    spec.attribute("ghostlight:lens", origin.lens);
    if (!origin.configuration.empty())
        spec.attribute("ghostlight:configuration", origin.configuration);
    spec.attribute("ghostlight:spectrum", origin.spectrum);
    spec.attribute("ghostlight:wavelengths_nm",
                   fmt::format("{}", fmt::join(origin.wavelengths_nm, " ")));
    spec.attribute("ghostlight:field_deg", static_cast<float>(origin.light.field_deg));
    spec.attribute("ghostlight:azimuth_deg", static_cast<float>(origin.light.azimuth_deg));
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

/// The picture in display values of 0 to 1, sRGB.
std::vector<float> display_values(const FlareImage& image, double exposure_ev) {
    std::vector<float> rgb = upright_picture(image.rgb, image.width_px, image.height_px, 3);
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        const std::array<float, 3> shown =
            tone_mapped({rgb[i], rgb[i + 1], rgb[i + 2]}, exposure_ev);
        std::copy(shown.begin(), shown.end(), rgb.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return rgb;
}

template <class Level>
std::vector<Level> levels(const std::vector<float>& values) {
    std::vector<Level> result(values.size());
    constexpr float most = std::numeric_limits<Level>::max();
    std::ranges::transform(values, result.begin(), [](float value) {
        return static_cast<Level>(std::lround(most * value));
    });
    return result;
}

OIIO::ImageSpec display_spec(const FlareImage& image, double exposure_ev, OIIO::TypeDesc type) {
    OIIO::ImageSpec spec(image.width_px, image.height_px, 3, type);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("ghostlight:exposure_ev", static_cast<float>(exposure_ev));
    return spec;
}

}  // namespace

void write_exr(const FlareImage& image, const std::filesystem::path& file,
               const FlareOrigin& origin, const std::vector<FlareLayer>& layers) {
    check(image, file);
    const std::size_t channels = 4 + 3 * layers.size();
    const auto pixels =
        static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
    std::vector<float> data(channels * pixels);
    auto put = [&](const std::vector<float>& values, std::size_t count, std::size_t first) {
        const auto upright =
            upright_picture(values, image.width_px, image.height_px, static_cast<int>(count));
        for (std::size_t i = 0; i < pixels; ++i)
            for (std::size_t c = 0; c < count; ++c)
                data[channels * i + first + c] = upright[count * i + c];
    };
    put(image.rgb, 3, 0);
    put(image.irradiance, 1, 3);
    OIIO::ImageSpec spec(image.width_px, image.height_px, static_cast<int>(channels),
                         OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"R", "G", "B", "irradiance.Y"};
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const FlareImage& layer = *layers[k].image;
        check(layer, file);
        if (layer.width_px != image.width_px || layer.height_px != image.height_px)
            fail(file, fmt::format("layer {} is not of its size", layers[k].name));
        put(layer.rgb, 3, 4 + 3 * k);
        for (const char* channel : {".R", ".G", ".B"})
            spec.channelnames.push_back(layers[k].name + channel);
    }
    spec.alpha_channel = -1;
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    // Rec. 709 primaries and D65: x, y of red, green, blue and white.
    const float chromaticities[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities);
    describe(spec, image, origin);
    write("openexr", spec, OIIO::TypeDesc::FLOAT, data.data(), file);
}

void write_display(const FlareImage& image, double exposure_ev, const std::filesystem::path& file,
                   const FlareOrigin& origin) {
    check(image, file);
    const std::vector<float> values = display_values(image, exposure_ev);
    const std::string extension = file.extension().string();
    if (extension == ".tif" || extension == ".tiff" || extension == ".TIF" ||
        extension == ".TIFF") {
        OIIO::ImageSpec spec = display_spec(image, exposure_ev, OIIO::TypeDesc::UINT16);
        describe(spec, image, origin);
        write("tiff", spec, OIIO::TypeDesc::UINT16, levels<std::uint16_t>(values).data(), file);
        return;
    }
    OIIO::ImageSpec spec = display_spec(image, exposure_ev, OIIO::TypeDesc::UINT8);
    describe(spec, image, origin);
    write("png", spec, OIIO::TypeDesc::UINT8, levels<std::uint8_t>(values).data(), file);
}

std::string png_bytes(const FlareImage& image, double exposure_ev) {
    check(image, "in memory");
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto out = OIIO::ImageOutput::create("png");
    if (!out) fail("in memory", OIIO::geterror());
    out->set_ioproxy(&memory);
    const OIIO::ImageSpec spec = display_spec(image, exposure_ev, OIIO::TypeDesc::UINT8);
    const auto shown = levels<std::uint8_t>(display_values(image, exposure_ev));
    if (!out->open("flare.png", spec) || !out->write_image(OIIO::TypeDesc::UINT8, shown.data()) ||
        !out->close())
        fail("in memory", out->geterror());
    return {bytes.begin(), bytes.end()};
}

}  // namespace ghostlight
