#pragma once

#include "core/flare/color_mesh.h"
#include "core/flare/flare_plan.h"
#include "core/flare/ghost_mesh.h"

namespace ghostlight {

/// Moments of the light that a grid of rays carries: exact for what is bilinear over whole cells;
/// cells that a rim goes through are split into parts, of which those inside the interpolated
/// clearances count. `channels`: of `nodes.weights`, 1 (irradiance; the spot is grey) or 4.
GhostSpot spot_of(const MeshNodes& nodes, int channels, const PixelFrame& frame);

}  // namespace ghostlight
