#pragma once

#include "core/ghosts/cells.h"

namespace ghostlight {

/// A coarse look at a path's bundle: 8 × 8 cells with polarised weights, in single precision.
RayField<float> probe_bundle(const OpticalSystem& system, const TracePath<float>& path,
                             const BeamFrame& frame, const PupilBox& box);

/// Cells (8 to `finest_cells`, a multiple of 8) for which the map to the sensor is bilinear to
/// within `bend_mm` RMS over what passes and lands within `reach_mm` of the axis, predicted from
/// the probe: the error falls fourfold on doubling.
int cells_for_bend(const RayField<float>& probe, double bend_mm, double reach_mm,
                   int finest_cells = 256);

/// A grid for pictures and peaks, in single precision: the geometry on cells × cells, the weights
/// interpolated from the probe where they are smooth enough for it (to about 0.3 % of the flux),
/// traced everywhere where they are not. Films cost several times what the geometry does.
SplitGrid<float> weighted_grid(const OpticalSystem& system, const TracePath<float>& path,
                               const BeamFrame& frame, const PupilBox& box,
                               const RayField<float>& probe, int cells);

}  // namespace ghostlight
