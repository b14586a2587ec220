#include "core/io/scene_pictures.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/flare/ghost_mesh.h"
#include "core/io/refuse_file.h"

namespace ghostlight {
namespace {

constexpr int most_side_px = 32768;
constexpr double most_pixels = 2e8;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

float srgb_decoded(float encoded) {
    return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

/// Overlap of [low, high] with the unit interval that begins at k.
double overlap(double low, double high, int k) {
    return std::max(0.0, std::min(high, k + 1.0) - std::max(low, static_cast<double>(k)));
}

/// The share of each source pixel in a target pixel's span.
struct Span {
    int first = 0;
    std::vector<float> shares;
};
Span span(double low, double high, int count) {
    Span result;
    result.first = std::clamp(static_cast<int>(std::floor(low)), 0, count);
    for (int k = result.first; k < count && k < high; ++k)
        result.shares.push_back(static_cast<float>(overlap(low, high, k) / (high - low)));
    return result;
}

}  // namespace

LinearPicture read_linear_picture(const std::filesystem::path& file) {
    std::error_code unreadable;
    if (!std::filesystem::is_regular_file(file, unreadable))
        refuse_file(file, "no such picture", {}, {});
    const auto in = OIIO::ImageInput::open(file.string());
    if (!in) refuse_file(file, "the picture cannot be read: " + OIIO::geterror(), {}, {});
    const OIIO::ImageSpec spec = in->spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
        refuse_file(file, "the picture is empty", {}, {});
    if (spec.width > most_side_px || spec.height > most_side_px ||
        static_cast<double>(spec.width) * spec.height > most_pixels)
        refuse_file(file, "the picture is too large",
                    fmt::format("{} × {}", spec.width, spec.height),
                    fmt::format("at most {} a side and {:.0f} million pixels", most_side_px,
                                most_pixels * 1e-6));
    LinearPicture picture{spec.width, spec.height, {}};
    const std::size_t pixels = idx(spec.width) * idx(spec.height);
    const int channels = std::min(spec.nchannels, 3);
    std::vector<float> values(pixels * idx(channels));
    if (!in->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data()))
        refuse_file(file, "the picture cannot be read: " + in->geterror(), {}, {});
    const bool is_float = spec.format.is_floating_point();
    picture.rgb.resize(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const float value = values[i * idx(channels) + (channels == 3 ? c : 0)];
            picture.rgb[3 * i + c] = is_float ? value : srgb_decoded(value);
        }
    return picture;
}

LightPattern pattern_of_size(const LightSize& size) {
    if (const auto* disc = std::get_if<DiscSize>(&size)) return disc_pattern(disc->diameter_deg);
    const auto* shown = std::get_if<PictureSize>(&size);
    if (shown == nullptr) return {};
    const LinearPicture picture = read_linear_picture(shown->file);
    std::vector<float> luminance;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
        luminance.push_back(0.2126F * picture.rgb[i] + 0.7152F * picture.rgb[i + 1] +
                            0.0722F * picture.rgb[i + 2]);
    try {
        return picture_pattern(luminance, picture.width, picture.height, shown->width_deg);
    } catch (const Error& error) {
        Error::Parts parts = error.parts();
        parts.file = shown->file;
        throw Error(std::move(parts));
    }
}

double sunlit_white_per_e0(double f_number) { return 1.0 / (4.0 * f_number * f_number); }

FlareImage read_backdrop(const std::filesystem::path& file, const Sensor& sensor, int width_px,
                         double white_per_e0) {
    const LinearPicture picture = read_linear_picture(file);
    const PixelFrame frame = pixel_frame(sensor.width_mm, sensor.height_mm, width_px);
    FlareImage image;
    image.width_px = frame.width_px;
    image.height_px = frame.height_px;
    image.sensor_width_mm = sensor.width_mm;
    image.sensor_height_mm = sensor.height_mm;
    const std::size_t count = idx(frame.width_px) * idx(frame.height_px);
    image.rgb.assign(3 * count, 0.0F);
    image.irradiance.assign(count, 0.0F);
    // As the sensor has it: mirrored left to right (upright_picture), row 0 being the top.
    const double scale = static_cast<double>(picture.width) / frame.width_px;
    const double top = 0.5 * (picture.height - frame.height_px * scale);
    std::vector<Span> columns;
    for (int i = 0; i < frame.width_px; ++i)
        columns.push_back(span(i * scale, (i + 1) * scale, picture.width));
    double sum = 0.0;
    for (int j = 0; j < frame.height_px; ++j) {
        const Span rows =
            span(std::max(0.0, top + j * scale), top + (j + 1) * scale, picture.height);
        for (int i = 0; i < frame.width_px; ++i) {
            const Span& across = columns[idx(i)];
            double rgb[3] = {};
            for (std::size_t b = 0; b < rows.shares.size(); ++b)
                for (std::size_t a = 0; a < across.shares.size(); ++a) {
                    const float* from =
                        &picture
                             .rgb[3 * (idx(rows.first + static_cast<int>(b)) * idx(picture.width) +
                                       idx(across.first + static_cast<int>(a)))];
                    const double share = static_cast<double>(rows.shares[b]) *
                                         static_cast<double>(across.shares[a]) * white_per_e0;
                    for (std::size_t c = 0; c < 3; ++c)
                        // Beyond what a photograph can hold there is nothing to show.
                        if (std::isfinite(from[c])) rgb[c] += share * static_cast<double>(from[c]);
                }
            const std::size_t at = idx(j) * idx(frame.width_px) + idx(frame.width_px - 1 - i);
            for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * at + c] = static_cast<float>(rgb[c]);
            image.irradiance[at] =
                static_cast<float>(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
            sum += static_cast<double>(image.irradiance[at]);
        }
    }
    image.flux_mm2 = image.flux_on_sensor_mm2 = sum * frame.pixel_area_mm2();
    return image;
}

}  // namespace ghostlight
