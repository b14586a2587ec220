#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "core/fit/photo.h"

namespace ghostlight {

/// Lower case, with their dots.
std::span<const std::string_view> raw_photo_extensions();

/// Reads EXR, TIFF, PNG, JPEG and camera RAW, linear, in the sensor's frame. Files in sRGB are
/// linearised, with a note that their tone curve is a guess; RAW stays in camera space, unclipped
/// and without automatic brightness. Exposure time, f-number, focal length, camera and time come
/// from EXIF data where there; the noise model from what `synth` wrote, otherwise it is estimated.
/// Unusable pixels are masked (mask_unusable). Throws Error.
Photo read_photo(const std::filesystem::path& file);

/// A painted mask: pixels brighter than half are left out. Upright, the photograph's size or any
/// size of its shape. Throws Error.
void mask_by_file(Photo& photo, const std::filesystem::path& file);

/// Linear 32-bit float EXR, linear 16-bit TIFF, or sRGB PNG or JPEG (PNG with 8 or 16 bits), with
/// exposure, noise and a description. The extension decides. Throws Error.
void write_photo(const Photo& photo, int bits, const std::filesystem::path& file);

/// Whether a file of that name would be sRGB, and its bits unless others are asked for (0: float).
struct PhotoFormat {
    bool srgb = false;
    int bits = 0;
};
/// Throws Error for extensions that write_photo() does not know.
PhotoFormat photo_format(const std::filesystem::path& file);

}  // namespace ghostlight
