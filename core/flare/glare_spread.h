#pragma once

#include "core/flare/flare_image.h"

namespace ghostlight {

/// Light that a lens scatters about its image: a share of the direct light, with the profile
/// (1 + r²/r₀²)^(−exponent/2) over the distance r from the image, r₀ the focal length times the
/// core's angle. That is the form measured for the wings of telescopes' images (Moffat, Astron.
/// Astrophys. 3 (1969) 455), and for a large r the power law of scatter from polished surfaces
/// (Harvey, SPIE 107 (1977) 41). Dust, scratches and age decide its numbers, not the prescription:
/// off by default.
struct GlareSpread {
    double share = 0.0;     ///< of the direct light, 0 to 1
    double exponent = 2.5;  ///< above 2, so that the light is finite
    double core_deg = 0.2;
    bool operator==(const GlareSpread&) const = default;
};
inline constexpr double least_glare_exponent = 2.05, most_glare_exponent = 10.0;

/// Irradiance / E0 at a distance from an image that holds `flux_mm2`; its integral over the plane
/// is share × flux.
double glare_per_e0(const GlareSpread& spread, double flux_mm2, double core_mm, double r_mm);

/// Adds the spread of an image at (x, y) mm whose channels hold `flux_mm2` (linear Rec.709,
/// irradiance). Pixels near the core get its mean over their area.
void add_glare_spread(const GlareSpread& spread, const std::array<double, 4>& flux_mm2, double x_mm,
                      double y_mm, double efl_mm, unsigned threads, FlareImage& image);

}  // namespace ghostlight
