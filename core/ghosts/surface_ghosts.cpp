#include "core/ghosts/surface_ghosts.h"

#include <algorithm>

namespace ghostlight {

std::vector<SurfaceGhost> ghosts_of_surface(const GhostTable& table, std::size_t row) {
    std::vector<SurfaceGhost> fed;
    for (const GhostRow& ghost : table.ghosts)
        for (std::size_t k = 0; k < ghost.path.reflections.size(); ++k)
            if (ghost.path.reflections[k] == row)
                // Turns alternate: the first one is met on the way to the sensor.
                fed.push_back({ghost.path, ghost.flux_mm2, ghost.turns[k], k % 2 == 0});
    std::ranges::stable_sort(fed, std::ranges::greater{}, &SurfaceGhost::flux_mm2);
    return fed;
}

}  // namespace ghostlight
