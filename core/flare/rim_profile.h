#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/flare/flare_scene.h"

namespace ghostlight {

/// Channels of what fringes change: linear Rec.709 and irradiance.
inline constexpr int rim_channels = 4;
using RimColor = std::array<float, rim_channels>;

/// How far the profile is followed into the shadow, in Fresnel's w.
inline constexpr double into_shadow = 2.2;

/// The profile of one rim over Fresnel's w, positive in the light: in every channel as a share of
/// the light there, of all wavelengths together.
struct RimProfile {
    float shadow = 0.0F, light = 0.0F;  ///< w it reaches to; tapered into 0 and 1 there
    float steps_per_w = 0.0F;
    std::vector<RimColor> values;  ///< from −shadow to light

    /// ∫ values dw from the first on, so that a pixel's mean is a difference; built with them.
    std::vector<RimColor> below;

    /// Mean over w − half to w + half: what a pixel has that spans so much.
    RimColor mean(float w, float half) const {
        const RimColor high = integral(w + half), low = integral(w - half);
        RimColor value;
        for (std::size_t c = 0; c < rim_channels; ++c)
            value[c] = (high[c] - low[c]) / (2.0F * half);
        return value;
    }
    RimColor integral(float w) const {
        const float place = (w + shadow) * steps_per_w;
        if (!(place > 0.0F)) return RimColor{};
        const auto k = static_cast<std::size_t>(place);
        RimColor value = below[k + 1 < below.size() ? k : below.size() - 1];
        const float rest = w - light;
        for (std::size_t c = 0; c < rim_channels; ++c)
            value[c] = k + 1 < below.size() ? value[c] + (place - static_cast<float>(k)) *
                                                             (below[k + 1][c] - value[c])
                                            : value[c] + rest;
        return value;
    }
    RimColor at(float w) const {
        const float place = (w + shadow) * steps_per_w;
        if (!(place > 0.0F)) return RimColor{};
        const auto k = static_cast<std::size_t>(place);
        if (k + 1 >= values.size()) return RimColor{1.0F, 1.0F, 1.0F, 1.0F};
        const float part = place - static_cast<float>(k);
        const RimColor &low = values[k], &high = values[k + 1];
        RimColor value;
        for (std::size_t c = 0; c < rim_channels; ++c)
            value[c] = low[c] + part * (high[c] - low[c]);
        return value;
    }
};

/// Colour shares of a ghost's light: of each spectral sample in each channel, summing to the
/// ghost's colour over its irradiance.
using ColorShares = std::vector<std::array<double, rim_channels>>;
/// From a ghost's mean weight at each spectral sample.
ColorShares color_shares(const FlareScene& scene, const std::vector<double>& spectrum);

/// Of a rim of this Fresnel number at the main wavelength, drawn at so many pixels per w, round or
/// a straight blade. It gives as much light as it takes.
RimProfile rim_profile(const FlareScene& scene, const ColorShares& shares, double fresnel_number,
                       double px_per_w, bool round);

}  // namespace ghostlight
