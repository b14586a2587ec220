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

    /// ∫ values dw from the first on, so that a pixel's mean is a difference.
    std::vector<RimColor> below;
};

/// Colour shares of a ghost's light: of each spectral sample in each channel, summing to the
/// ghost's colour over its irradiance.
using ColorShares = std::vector<std::array<double, rim_channels>>;
/// From a ghost's mean weight at each spectral sample.
ColorShares color_shares(const FlareScene& scene, const std::vector<double>& spectrum);

/// A straight edge's fringes at every wavelength of a scene, over Fresnel's w of the main one: what
/// all ghosts of a picture have in common.
class EdgeFringes {
   public:
    explicit EdgeFringes(const FlareScene& scene);

    /// How far fringes are followed into the light, in w.
    double into_light() const { return into_light_; }
    /// The profile less 0 in the shadow and 1 in the light, `samples` values a step, from
    /// −into_shadow on.
    const std::vector<float>& changes() const { return changes_; }
    std::size_t samples() const { return samples_; }
    /// ∫ |the light's own profile − what a sharp rim has| dw, both as pixels have them of which one
    /// w has so many.
    double changed_w(double px_per_w) const;

   private:
    double into_light_;
    std::size_t samples_;
    std::vector<float> changes_;
    std::vector<double> changed_w_;  ///< by the logarithm of the pixels
};

/// Of a rim of this Fresnel number at the main wavelength, drawn at so many pixels per w, round or
/// a straight blade. It gives as much light as it takes.
RimProfile rim_profile(const EdgeFringes& edge, const ColorShares& shares, double fresnel_number,
                       double px_per_w, bool round);

}  // namespace ghostlight
