#pragma once

#include <vector>

#include "core/flare/ghost_sweep.h"
#include "core/io/table.h"

namespace ghostlight {

/// One row for each ghost of each point of a sweep, the parameter's value first, and last the value
/// at which this ghost has its largest flux. Points without a table have no rows.
Table sweep_table(const SweepParameter& parameter, const std::vector<SweepPoint>& points);

}  // namespace ghostlight
