#pragma once

#include <string>
#include <vector>

#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// Rays of a path to be drawn, in one colour.
struct DrawnPath {
    GhostPath path;
    std::string color;
    int rays = 5;
    double opacity = 0.8;
};

/// The lens cut by the y–z plane, to scale, with its stop, its sensor, and rays of light that comes
/// at `field_deg` in that plane: one SVG element that needs nothing else.
std::string layout_svg(const OpticalSystem& system, double field_deg,
                       const std::vector<DrawnPath>& paths);

}  // namespace ghostlight
