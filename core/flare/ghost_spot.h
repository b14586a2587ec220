#pragma once

#include <array>

#include "core/flare/color_mesh.h"
#include "core/flare/flare_plan.h"
#include "core/flare/ghost_mesh.h"

namespace ghostlight {

/// A ghost's light on the sensor plane, on the sensor or beside it, with its flux and colour.
struct GhostSpot : GhostMoments {
    std::array<double, 4> flux_mm2{};  ///< over E0: linear Rec.709, irradiance

    double flux() const { return flux_mm2[3]; }
    /// Standard deviations along the principal axes, the smaller first, mm.
    std::array<double, 2> sigmas_mm() const;
};

/// Moments of the light that a grid of rays carries, each cell split into parts of which those
/// inside the interpolated clearances count. `nodes.weights` holds 4 a node.
GhostSpot spot_of(const MeshNodes& nodes, const PixelFrame& frame);

}  // namespace ghostlight
