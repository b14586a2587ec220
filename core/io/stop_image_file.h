#pragma once

#include <filesystem>

#include "core/optics/prescription.h"

namespace ghostlight {

/// Reads an image for the stop: PNG, TIFF, EXR and what else OpenImageIO knows, 8, 16 or 32 bits,
/// of any shape. White is open; colours count by the mean of red, green and blue, and what is
/// transparent is shut. Eight- and sixteen-bit values are taken as shares of the light as they
/// stand, without a gamma. Throws Error for what is no image, is empty, has a side above 16384
/// pixels, has values that are no numbers, or is shut everywhere.
StopImage read_stop_image(const std::filesystem::path& file);

}  // namespace ghostlight
