#pragma once

#include <filesystem>
#include <string>

#include "core/flare/flare_image.h"

namespace ghostlight {

/// The flare as 32-bit float EXR, upright, linear Rec.709 R, G, B and the irradiance per E0 as
/// channel Y of a second layer "irradiance". `description` (lens, light) goes into the header.
/// Written aside and renamed. Throws Error.
void write_exr(const FlareImage& image, const std::filesystem::path& file,
               const std::string& description = {});

/// An 8-bit sRGB PNG at an exposure in stops (0 shows E0 of the light as white).
void write_png(const FlareImage& image, double exposure_ev, const std::filesystem::path& file,
               const std::string& description = {});

}  // namespace ghostlight
