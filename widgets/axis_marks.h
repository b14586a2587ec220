#pragma once

#include <string>
#include <vector>

#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// A place on the axis that first-order optics names, and for pupils how wide it is.
struct AxisMark {
    enum class Kind { focus, principal, entrance_pupil, exit_pupil, ghost_focus };
    Kind kind = Kind::focus;
    double z_mm = 0.0;  ///< from the first vertex
    double half_height_mm = 0.0;
    std::string label;
    GhostPath path;  ///< of a ghost's focus
};

/// Foci, principal points and pupils of the direct path, and the foci of the given ghosts. What
/// does not exist (an afocal lens, a telecentric pupil) has no mark.
std::vector<AxisMark> axis_marks(const OpticalSystem& system, const std::vector<GhostPath>& ghosts);

}  // namespace ghostlight
