#include "core/io/photo_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/flare/flare_image.h"
#include "core/flare/tone_map.h"
#include "core/io/aside_file.h"
#include "core/io/refuse_file.h"

namespace ghostlight {
namespace {

/// Of linear values taken back through the sRGB curve where the camera's own is not known: cameras
/// differ from it by several times this in contrast, most of which exposure and balance take up;
/// what is left is some percents between levels a factor of ten apart.
constexpr double guessed_curve_error = 0.03;

constexpr std::array<std::string_view, 19> raw_extensions = {
    ".dng", ".cr2", ".cr3", ".crw", ".nef", ".nrw", ".arw", ".raf", ".rw2", ".orf",
    ".pef", ".srw", ".rwl", ".3fr", ".iiq", ".erf", ".mef", ".mos", ".x3f"};
/// What synth writes in front of its numbers, into a field that every format keeps.
constexpr std::string_view noise_key = "ghostlight noise: shot ";
/// 24 Mpx cameras and more are common; beyond this something is wrong with the file.
constexpr std::size_t most_pixels = 400'000'000;

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return extension;
}

std::unique_ptr<OIIO::ImageInput> opened(const std::filesystem::path& file, bool raw) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        refuse_file(file, "there is no such photograph", {},
                    "the path of an EXR, TIFF, PNG, JPEG or RAW");
    OIIO::ImageSpec config;
    if (raw) {
        config.attribute("raw:ColorSpace", "raw");
        config.attribute("raw:auto_bright", 0);
        config.attribute("raw:use_camera_wb", 0);
        config.attribute("raw:use_camera_matrix", 0);
        // The camera's own balance: scaled channels would clip at levels of their own.
        constexpr std::array unscaled = {1.0F, 1.0F, 1.0F, 1.0F};
        config.attribute("raw:user_mul", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 4), unscaled.data());
        // White stays the file's white level: by the picture's own it would differ between
        // exposures.
        config.attribute("raw:adjust_maximum_thr", 0.0F);
        config.attribute("raw:HighlightMode", 1);
        config.attribute("raw:balance_clamped", 0);  // of a balance that is none
        config.attribute("raw:user_flip", 0);        // as the sensor has it
    }
    auto input = OIIO::ImageInput::open(file.string(), &config);
    if (!input) {
        std::string why = OIIO::geterror();
        std::ranges::replace(why, '\n', ' ');
        refuse_file(
            file, raw ? "the RAW file cannot be read" : "the photograph cannot be read", why,
            raw ? "a RAW of a camera that the RAW reader knows, or the same picture developed to "
                  "linear TIFF or EXR"
                : "an EXR, TIFF, PNG, JPEG or RAW file");
    }
    return input;
}

std::optional<double> number_in(const OIIO::ImageSpec& spec, const char* name) {
    const float value = spec.get_float_attribute(name, -1.0F);
    if (value > 0.0F && std::isfinite(value)) return static_cast<double>(value);
    return std::nullopt;
}

std::optional<PhotoNoise> noise_in(const std::string& text) {
    const auto at = text.find(noise_key);
    if (at == std::string::npos) return std::nullopt;
    const char* from = text.data() + at + noise_key.size();
    const char* end = text.data() + text.size();
    PhotoNoise noise;
    auto result = std::from_chars(from, end, noise.shot);
    constexpr std::string_view read_key = ", read ";
    if (result.ec != std::errc() ||
        !std::string_view(result.ptr, static_cast<std::size_t>(end - result.ptr))
             .starts_with(read_key))
        return std::nullopt;
    result = std::from_chars(result.ptr + read_key.size(), end, noise.read);
    if (result.ec != std::errc() || !(noise.shot >= 0.0) || !(noise.read >= 0.0))
        return std::nullopt;
    return noise;
}

std::vector<float> read_rgb(OIIO::ImageInput& input, const OIIO::ImageSpec& spec,
                            const std::filesystem::path& file) {
    const auto pixels =
        static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    auto channel_of = [&](const char* name) { return spec.channelindex(name); };
    int r = channel_of("R"), g = channel_of("G"), b = channel_of("B");
    if (r < 0 || g < 0 || b < 0) r = g = b = spec.nchannels >= 3 ? -1 : 0;
    if (r < 0) {
        r = 0;
        g = 1;
        b = 2;
    }
    const int last = std::max({r, g, b}) + 1;
    std::vector<float> all(pixels * static_cast<std::size_t>(last));
    if (!input.read_image(0, 0, 0, last, OIIO::TypeDesc::FLOAT, all.data()))
        refuse_file(file, "the photograph cannot be read to its end", input.geterror(),
                    "a complete file");
    if (r == 0 && g == 1 && b == 2 && last == 3) return all;
    std::vector<float> rgb(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* from = &all[i * static_cast<std::size_t>(last)];
        rgb[3 * i] = from[r];
        rgb[3 * i + 1] = from[g];
        rgb[3 * i + 2] = from[b];
    }
    return rgb;
}

}  // namespace

std::span<const std::string_view> raw_photo_extensions() { return raw_extensions; }

PhotoFormat photo_format(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    if (extension == ".exr") return {.srgb = false, .bits = 0};
    if (extension == ".tif" || extension == ".tiff") return {.srgb = false, .bits = 16};
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg")
        return {.srgb = true, .bits = 8};
    refuse_file(file, "a photograph cannot be written under this name", extension,
                ".exr, .tif, .png or .jpg");
}

Photo read_photo(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    const bool raw = std::ranges::find(raw_extensions, extension) != raw_extensions.end();
    const auto input = opened(file, raw);
    const OIIO::ImageSpec spec = input->spec();
    Photo photo;
    photo.file = file.string();
    photo.width_px = spec.width;
    photo.height_px = spec.height;
    if (spec.width < 16 || spec.height < 16 || photo.pixels() > most_pixels)
        refuse_file(file, "the photograph has an unusual size",
                    fmt::format("{} x {} pixels", spec.width, spec.height),
                    "16 to some ten thousand pixels each way");
    photo.rgb = read_rgb(*input, spec, file);

    const bool integer = spec.format.is_floating_point() == false;
    std::string space = spec.get_string_attribute("oiio:ColorSpace");
    const std::string text = spec.get_string_attribute("ImageDescription");
    const auto known_noise = noise_in(text);
    const bool linear =
        raw || !integer || (known_noise && (extension == ".tif" || extension == ".tiff"));
    if (!linear) {
        photo.curve_error = guessed_curve_error;
        std::ranges::transform(photo.rgb, photo.rgb.begin(),
                               [](float value) { return srgb_decoded(value); });
        photo.notes.push_back(
            {Note::Severity::warning, file.filename().string(),
             fmt::format(
                 "{}taken as sRGB and made linear by its standard curve; a camera's own tone "
                 "curve differs, which the fit cannot see",
                 space.empty() ? "" : space + " "),
             Note::Fate::assumed, true,
             "develop the RAW file to linear TIFF or EXR, or give the RAW itself"});
    }
    // Integer files end at their largest value; the last level may hold anything above.
    photo.saturation = 1.0;
    if (integer) photo.saturation = 1.0 - 0.5 / (spec.format.size() > 1 ? 65535.0 : 255.0) * 2.0;
    if (!integer) {
        const float highest = std::ranges::max(photo.rgb, [](float a, float b) {
            return std::isfinite(a) ? (std::isfinite(b) ? a < b : false) : true;
        });
        const auto at_highest = std::ranges::count(photo.rgb, highest);
        // Several pixels of exactly the largest value are a clip.
        photo.saturation = at_highest > 3 ? static_cast<double>(highest) * (1.0 - 1e-6)
                                          : std::numeric_limits<double>::infinity();
    }
    photo.rgb = upright_picture(photo.rgb, photo.width_px, photo.height_px, 3);

    photo.exposure_s = number_in(spec, "ExposureTime");
    photo.f_number = number_in(spec, "FNumber");
    photo.focal_length_mm = number_in(spec, "Exif:FocalLength");
    photo.camera = spec.get_string_attribute("Model");
    photo.taken = spec.get_string_attribute("DateTime");
    if (!photo.exposure_s || !photo.f_number)
        photo.notes.push_back(
            {Note::Severity::info, file.filename().string(),
             fmt::format("no {} in the file's data; the lens's own stop is used, the exposure is "
                         "fitted",
                         !photo.f_number && !photo.exposure_s ? "exposure time and f-number"
                         : !photo.f_number                    ? "f-number"
                                                              : "exposure time"),
             Note::Fate::assumed, true, "give --f-number if the stop was not the lens file's"});
    const int orientation = spec.get_int_attribute("Orientation", 1);
    if (orientation != 1 && !raw)
        photo.notes.push_back(
            {Note::Severity::warning, file.filename().string(),
             fmt::format("the file says that it is to be turned (EXIF orientation "
                         "{}); it is taken as it is stored",
                         orientation),
             Note::Fate::noticed, true, "the sensor's own orientation is what the lens needs"});
    photo.masked.assign(photo.pixels(), 0);
    if (known_noise) {
        photo.noise = *known_noise;
        // Through a curve of 8 bits the levels are coarser than the noise that synth knew of.
        if (!linear) photo.noise.read += 1.0 / (255.0 * 255.0 * 12.0) / (12.92 * 12.92);
    }
    const MaskCounts counts = mask_unusable(photo);
    if (!known_noise) {
        photo.noise = estimated_noise(photo);
        mask_hot(photo);
    }
    if (counts.not_a_number > 0)
        photo.notes.push_back(
            {Note::Severity::warning,
             file.filename().string(),
             fmt::format("{} pixels are no numbers and are left out", counts.not_a_number),
             Note::Fate::left_out,
             false,
             {}});
    return photo;
}

void mask_by_file(Photo& photo, const std::filesystem::path& file) {
    const auto input = opened(file, false);
    const OIIO::ImageSpec spec = input->spec();
    const double shape = static_cast<double>(spec.width) / spec.height;
    const double wanted = static_cast<double>(photo.width_px) / photo.height_px;
    if (std::abs(shape / wanted - 1.0) > 0.02)
        refuse_file(
            file, "the mask has not the photograph's shape",
            fmt::format("{} x {} pixels", spec.width, spec.height),
            fmt::format("{} x {}, or smaller in that proportion", photo.width_px, photo.height_px));
    const std::vector<float> mask =
        upright_picture(read_rgb(*input, spec, file), spec.width, spec.height, 3);
    for (int y = 0; y < photo.height_px; ++y)
        for (int x = 0; x < photo.width_px; ++x) {
            const int column = static_cast<int>(std::int64_t{x} * spec.width / photo.width_px);
            const int row = static_cast<int>(std::int64_t{y} * spec.height / photo.height_px);
            char& masked =
                photo
                    .masked[static_cast<std::size_t>(y) * static_cast<std::size_t>(photo.width_px) +
                            static_cast<std::size_t>(x)];
            if (!masked && mask[3 * static_cast<std::size_t>(row * spec.width + column)] > 0.5F)
                masked = mask_reason::painted;
        }
}

void write_photo(const Photo& photo, int bits, const std::filesystem::path& file) {
    const PhotoFormat format = photo_format(file);
    const std::string extension = extension_of(file);
    const bool exr = extension == ".exr", jpeg = extension.starts_with(".jp");
    if (bits == 0) bits = format.bits;
    const auto type =
        exr ? OIIO::TypeDesc::FLOAT : (bits > 8 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
    OIIO::ImageSpec spec(photo.width_px, photo.height_px, 3, type);
    spec.attribute("Software", "Ghostlight");
    spec.attribute("oiio:ColorSpace", format.srgb ? "sRGB" : "Linear");
    if (jpeg) spec.attribute("CompressionQuality", 95);
    if (exr) spec.attribute("compression", "zip");
    spec.attribute("ImageDescription",
                   fmt::format("{}{}, read {}", noise_key, photo.noise.shot, photo.noise.read));
    if (photo.exposure_s) spec.attribute("ExposureTime", static_cast<float>(*photo.exposure_s));
    if (photo.f_number) spec.attribute("FNumber", static_cast<float>(*photo.f_number));
    if (photo.focal_length_mm)
        spec.attribute("Exif:FocalLength", static_cast<float>(*photo.focal_length_mm));
    if (!photo.camera.empty()) spec.attribute("Model", photo.camera);
    std::vector<float> values = upright_picture(photo.rgb, photo.width_px, photo.height_px, 3);
    if (!exr)
        for (float& value : values) {
            value = std::clamp(value, 0.0F, 1.0F);
            if (format.srgb) value = srgb_encoded(value);
        }
    AsideFile aside(file);
    const auto out = OIIO::ImageOutput::create(exr                   ? "openexr"
                                               : extension == ".png" ? "png"
                                               : jpeg                ? "jpeg"
                                                                     : "tiff");
    if (!out || !out->open(aside.path().string(), spec) ||
        !out->write_image(OIIO::TypeDesc::FLOAT, values.data()) || !out->close())
        refuse_file(file, "the photograph cannot be written",
                    out ? out->geterror() : OIIO::geterror(), {});
    aside.commit();
}

}  // namespace ghostlight
