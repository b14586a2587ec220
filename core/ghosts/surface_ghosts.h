#pragma once

#include <cstddef>
#include <vector>

#include "core/ghosts/ghost_table.h"

namespace ghostlight {

/// A ghost's turn at a surface.
struct SurfaceGhost {
    GhostPath path;
    double flux_mm2 = 0.0;
    TurnOfGhost turn;        ///< its angles are in the medium that the light comes from
    bool from_front = true;  ///< the light arrives on its way to the sensor
};

/// What turns at a row, counted from 0, strongest first: the ghosts that its coating feeds. A
/// ghost that turns there twice is listed twice.
std::vector<SurfaceGhost> ghosts_of_surface(const GhostTable& table, std::size_t row);

}  // namespace ghostlight
