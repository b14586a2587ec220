#pragma once

#include <array>

namespace ghostlight {

/// sRGB's encoding of a linear value, 0 to 1 (IEC 61966-2-1).
float srgb_encoded(float linear);

/// Display colour of a linear one at an exposure in stops: scale, soft shoulder above 0.8 that
/// keeps hue, sRGB encoding. For screens and PNG only; files keep linear values.
std::array<float, 3> tone_mapped(std::array<float, 3> linear, double exposure_ev);

}  // namespace ghostlight
