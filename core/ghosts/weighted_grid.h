#pragma once

#include "core/ghosts/cells.h"

namespace ghostlight {

/// A grid for pictures and peaks, in single precision: the geometry on cells × cells (a multiple
/// of 8), the polarised weights interpolated from 8 × 8 where they are smooth enough for it (to
/// about 0.3 % of the flux), traced everywhere where they are not. Films cost several times what
/// the geometry does.
SplitGrid<float> weighted_grid(const OpticalSystem& system, const TracePath<float>& path,
                               const BeamFrame& frame, const PupilBox& box, int cells);

}  // namespace ghostlight
