#pragma once

#include <filesystem>

#include "core/flare/flare_image.h"
#include "core/flare/light.h"
#include "core/flare/light_pattern.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// A picture as floats, row 0 at the top, as it stands in its file.
struct LinearPicture {
    int width = 0, height = 0;
    std::vector<float> rgb;  ///< 3 a pixel, linear Rec.709
};

/// Reads a picture: float formats as they are, integer ones taken as sRGB and made linear. One
/// channel is grey, a fourth is left out. Throws Error for what cannot be read, or is too large.
LinearPicture read_linear_picture(const std::filesystem::path& file);

/// The pattern of a light's size; reads the file of a PictureSize.
LightPattern pattern_of_size(const LightSize& size);

/// A photograph behind the flare: scaled to fill the sensor's width and cut or filled with black in
/// height, averaged over each pixel. Its value 1 is irradiance `white_per_e0`.
FlareImage read_backdrop(const std::filesystem::path& file, const Sensor& sensor, int width_px,
                         double white_per_e0);

/// Irradiance / E0 of a white surface in the sun, facing it: 1 / (4 N²), its radiance being E0/π
/// (Reiss, J. Opt. Soc. Am. 38 (1948) 980, without losses and on axis).
double sunlit_white_per_e0(double f_number);

}  // namespace ghostlight
