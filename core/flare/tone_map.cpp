#include "core/flare/tone_map.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {

float srgb_encoded(float linear) {
    if (!(linear > 0.0f)) return 0.0f;
    if (linear >= 1.0f) return 1.0f;
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float srgb_decoded(float encoded) {
    return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

std::array<float, 3> tone_mapped(std::array<float, 3> linear, double exposure_ev) {
    const float scale = static_cast<float>(std::exp2(exposure_ev));
    float largest = 0.0f;
    for (float& channel : linear) {
        channel = std::max(channel * scale, 0.0f);
        largest = std::max(largest, channel);
    }
    if (largest > tone_shoulder) {
        // One factor for the three channels keeps the hue; slope 1 at the shoulder, 1 at infinity.
        constexpr float rest = 1.0f - tone_shoulder;
        const float mapped =
            tone_shoulder + rest * (1.0f - std::exp(-(largest - tone_shoulder) / rest));
        const float factor = std::isinf(largest) ? 0.0f : mapped / largest;
        for (float& channel : linear) channel = std::isinf(channel) ? 1.0f : channel * factor;
    }
    for (float& channel : linear) channel = srgb_encoded(channel);
    return linear;
}

std::array<float, 3> tone_mapped(std::array<float, 3> linear, double exposure_ev, ToneCurve curve) {
    if (curve == ToneCurve::soft) return tone_mapped(linear, exposure_ev);
    const float scale = static_cast<float>(std::exp2(exposure_ev));
    float largest = 0.0f;
    for (float& channel : linear) {
        channel = std::min(std::max(channel * scale, 0.0f), 1e30f);
        largest = std::max(largest, channel);
    }
    const float mapped =
        curve == ToneCurve::linear
            ? std::min(largest, 1.0f)
            : srgb_decoded(
                  std::clamp(1.0f + std::log2(std::max(largest, 1e-30f)) / tone_stops, 0.0f, 1.0f));
    for (float& channel : linear)
        channel = srgb_encoded(channel * (mapped / std::max(largest, 1e-30f)));
    return linear;
}

}  // namespace ghostlight
