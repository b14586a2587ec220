#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/flare/flare_image.h"

namespace ghostlight {

/// What a picture's file says about where it comes from.
struct FlareOrigin {
    std::string lens, configuration;
    std::string spectrum;  ///< as name(Spectrum) has it
    std::vector<double> wavelengths_nm;
    LightDirection light;
    bool operator==(const FlareOrigin&) const = default;
};

/// A further picture of the same size, as channels "<name>.R", "<name>.G", "<name>.B".
struct FlareLayer {
    std::string name;  ///< "ghost.5-3"
    const FlareImage* image = nullptr;
};

/// The flare as 32-bit float EXR, upright, linear Rec.709 R, G, B, the irradiance per E0 as channel
/// Y of a second layer "irradiance", and further layers. Lens, light, wavelengths, the unit
/// (irradiance / E0) and the program's version go into the header. Written aside and renamed.
/// Throws Error.
void write_exr(const FlareImage& image, const std::filesystem::path& file,
               const FlareOrigin& origin = {}, const std::vector<FlareLayer>& layers = {});

/// For looking, at an exposure in stops (0 shows E0 of the light as white): an sRGB PNG of 8 bits,
/// or a TIFF of 16 bits where the name ends in .tif or .tiff.
void write_display(const FlareImage& image, double exposure_ev, const std::filesystem::path& file,
                   const FlareOrigin& origin = {});

/// The same PNG in memory.
std::string png_bytes(const FlareImage& image, double exposure_ev);

}  // namespace ghostlight
