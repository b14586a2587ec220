#pragma once

#include <cstddef>
#include <vector>

#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// Largest reflectance of each row that can turn light (the sensor's the last), for light that goes
/// towards the sensor and back; 0 where nothing turns.
struct LargestReflectances {
    std::vector<double> forward, backward;
};

/// Steepest incidence on each row, by direction, radians.
struct SteepestIncidence {
    std::vector<double> forward_rad, backward_rad;
};

/// Over both polarisations and all angles up to the steepest.
LargestReflectances largest_reflectances(const OpticalSystem& system,
                                         const SteepestIncidence& steepest);
/// The larger of each pair.
void widen(LargestReflectances& bounds, const LargestReflectances& other);

struct BoundedPath {
    GhostPath path;
    double flux_bound_mm2 = 0.0;
};

/// The ghosts of four reflections, ranked by a bound: clear area × the four largest reflectances.
struct RankedPaths {
    std::size_t count = 0;               ///< of all of them
    double flux_bound_mm2 = 0.0;         ///< of all of them
    std::vector<BoundedPath> strongest;  ///< largest bound first
};
/// Stops at `most` paths, or once the bounds of the rest add up to no more than `rest_mm2`. All are
/// counted and summed, though only the strongest are ever formed: 33 surfaces have 232,408. The
/// bound holds as far as four-reflection light meets no surface more steeply than the reflectances
/// were taken for.
RankedPaths strongest_four_reflections(const LargestReflectances& bounds, double clear_area_mm2,
                                       std::size_t most, double rest_mm2);

}  // namespace ghostlight
