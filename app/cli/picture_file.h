#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/io/image_file.h"

namespace ghostlight::cli {

/// The ending of a picture's file, in small letters: .exr, .png, .tif or .tiff. Throws Error for
/// others.
std::string picture_extension(const std::string& file);

/// What --exposure says, for a picture of this ending; nothing when it was not given.
std::optional<double> exposure_value(std::string_view text, std::string_view extension);

}  // namespace ghostlight::cli
