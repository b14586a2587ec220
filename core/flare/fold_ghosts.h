#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/flare/planned_ghost.h"

namespace ghostlight {

/// Which ghosts may be folded into the veil: those of the least irradiance whose kernels are broad
/// enough, together with at most `share` of the light of all that reach the sensor. Indices into
/// `ghosts`.
std::vector<std::size_t> foldable(std::span<const GhostSpot> ghosts, double share,
                                  double sensor_width_mm, double sensor_height_mm);

/// Folds ghosts that have been weighed: their fate, and their spots' colours. Of those that are to
/// be drawn; a picture then lacks at most their light, and has it elsewhere in the veil: an L1
/// error of at most twice what they bring to the sensor.
void fold_ghosts(const GhostPlanner& planner, double share, std::vector<ProbedGhost>& ghosts);

/// The spots of the ghosts that a plan folds.
std::vector<GhostSpot> folded_spots(const FlarePlan& plan);

}  // namespace ghostlight
