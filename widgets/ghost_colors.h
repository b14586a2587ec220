#pragma once

#include <QColor>

#include "core/ghosts/ghost_path.h"

namespace ghostlight {

/// A ghost's colour, the same in table, layout and flare. It follows from the two surfaces alone,
/// so that it stays while numbers and order change.
QColor ghost_color(const GhostPath& path);

}  // namespace ghostlight
