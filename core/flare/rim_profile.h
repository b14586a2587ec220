#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/flare/flare_scene.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// Channels of what fringes change: linear Rec.709 and irradiance.
inline constexpr int rim_channels = 4;
using RimColor = std::array<float, rim_channels>;

/// How far the profile is followed into the shadow, in Fresnel's w.
inline constexpr double into_shadow = 2.5;

/// What one edge changes, over the depth in semi-diameters: profile − 1 in the light, the profile
/// in the shadow, in every channel as a share of the ghost's irradiance there.
class EdgeChange {
   public:
    static constexpr int steps = 512;
    double shadow = 0.0, light = 0.0;  ///< depths it reaches to
    std::vector<RimColor> profile;     ///< the profile itself, tapered into 0 and 1

    RimColor at(double depth) const;
};

/// Colour shares of a ghost's light: of each spectral sample in each channel, summing to the
/// ghost's colour over its irradiance.
using ColorShares = std::vector<std::array<double, rim_channels>>;
/// From a ghost's mean weight at each spectral sample.
ColorShares color_shares(const FlareScene& scene, const std::vector<double>& spectrum);

/// Of a ghost of this Fresnel number, drawn at so many pixels per w, at a round stop or a straight
/// blade. It gives as much light as it takes.
EdgeChange edge_change(const FlareScene& scene, const ColorShares& shares, double fresnel_number,
                       double px_per_w, bool round);

/// An edge of the stop in semi-diameters: a blade's line, or its arc, or all of a round stop.
struct EdgeLine {
    double nx = 0.0, ny = 0.0;  ///< outwards
    double distance = 1.0;      ///< of a straight one from the middle
    double back = 0.0, radius = 1.0;
    bool is_straight = false;
};
std::vector<EdgeLine> edge_lines(const StopMask& stop);

/// Depth in semi-diameters, and its direction inwards.
struct EdgeDepth {
    double depth, nx, ny;
};
EdgeDepth edge_at(const EdgeLine& line, double u, double v);

}  // namespace ghostlight
