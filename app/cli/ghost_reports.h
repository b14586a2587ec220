#pragma once

#include "app/cli/ghost_states.h"
#include "core/ghosts/ghost_table.h"

namespace ghostlight::cli {

/// The flux by surface, the largest first, and all together in the last row.
Table rows_by_surface(const GhostTable& ghosts, const Prescription& lens);

/// The flux of two-reflection ghosts by the pair of elements they turn at; all in the last row.
Table rows_by_element(const GhostTable& ghosts, const Prescription& lens);

/// What each coating's numbers do to each ghost's flux, by ghost in the table's order.
Table rows_of_sensitivities(const GhostTable& ghosts, const GhostState& state);

}  // namespace ghostlight::cli
