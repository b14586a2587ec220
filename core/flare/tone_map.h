#pragma once

#include <array>

namespace ghostlight {

/// sRGB's encoding of a linear value, 0 to 1 (IEC 61966-2-1).
float srgb_encoded(float linear);

/// Its inverse.
float srgb_decoded(float encoded);

/// Up to here a display value is the linear one.
inline constexpr float tone_shoulder = 0.8f;

/// Display colour of a linear one at an exposure in stops: times 2^ev, negative values to 0; with m
/// the largest channel and s the shoulder, where m > s all three times m'/m,
/// m' = s + (1 − s)(1 − exp(−(m − s)/(1 − s))), which keeps the hue; sRGB encoding. For screens and
/// PNG only; files keep linear values.
std::array<float, 3> tone_mapped(std::array<float, 3> linear, double exposure_ev);

/// How brightness is shown. Each changes the largest channel and keeps the hue.
enum class ToneCurve {
    soft,    ///< tone_mapped() above
    linear,  ///< m, cut off at 1
    log      ///< sRGB 1 + log2(m) / tone_stops: so many stops below white, evenly
};
inline constexpr float tone_stops = 8.0f;
std::array<float, 3> tone_mapped(std::array<float, 3> linear, double exposure_ev, ToneCurve curve);

}  // namespace ghostlight
