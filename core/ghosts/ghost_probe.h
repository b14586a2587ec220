#pragma once

#include <cstddef>

#include "core/ghosts/mirror_grid.h"

namespace ghostlight {

/// Where a path's light enters, and a coarse grid of rays over it.
struct GhostProbe {
    MirrorGrid grid;          ///< geometry and cosines
    std::size_t passing = 0;  ///< nodes of the full grid that pass, the stop taken as round
    PupilBox passing_box;     ///< of these nodes, with a cell to spare, within the entrance
    std::size_t rays = 0;     ///< traced, the search included
    bool empty = false;       ///< nothing was found
};

/// How hard to look. `quick`, for a light that is being dragged, takes what the zoom finds;
/// `careful` also looks beside failing rays and along the meridian, at up to three times the rays.
enum class ProbeSearch { quick, careful };

/// Looks for the part of the entrance that reaches the sensor along `path`, zooming in on the box
/// of the cells that may pass until it shrinks no further; where that does not settle (islands,
/// crescents), by find_pupil's cells. The beam must lie in the y–z plane. Tables are not needed:
/// a search takes a few hundred rays. With the box of a similar beam or lens, `nearby`, a quick
/// search is content with that box where it still holds and is filled by what passes. Else the zoom
/// begins there; where what passes reaches the edge of what is looked at, or nothing passes, it
/// begins anew with the whole entrance.
GhostProbe probe_ghost(const OpticalSystem& system, const TracePath<float>& path,
                       const BeamFrame& frame, const PupilBox& entrance, int cells,
                       ProbeSearch search = ProbeSearch::careful, const PupilBox* nearby = nullptr);

}  // namespace ghostlight
