#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/ghosts/bundle.h"

namespace ghostlight {

/// A rectangle on the plane across the beam, mm.
struct PupilBox {
    double u0_mm = 0.0, u1_mm = 0.0, v0_mm = 0.0, v1_mm = 0.0;
    double area_mm2() const { return (u1_mm - u0_mm) * (v1_mm - v0_mm); }
};

/// A square cell of the entrance box divided into `across` × `across`.
struct PupilCell {
    std::uint32_t i = 0, j = 0;
};

/// Where rays of a path may pass.
struct Pupil {
    PupilBox entrance;  ///< what was searched
    int across = 1;     ///< cells of `entrance` across
    std::vector<PupilCell> cells;
    PupilBox box;          ///< around the cells
    std::size_t rays = 0;  ///< spent in looking
    bool empty() const { return cells.empty(); }
};

/// The box around the first surface's clear cap, as the beam sees it.
PupilBox entrance_box(const OpticalSystem& system, const BeamFrame& frame);

/// How hard to look: `thorough` finds slivers of a few thousandths of the entrance beside failing
/// rays, for tables; `quick` may miss them, for pictures at interactive rate; `beside_failing`
/// looks for them in one half of a beam in the y–z plane (the cells of the other half are left
/// out), and only where some rays do not fail: a third of the thorough search's rays.
enum class PupilSearch { quick, beside_failing, thorough };

/// Looks for the part of the entrance that reaches the sensor along `path`: cells that may hold a
/// passing ray, judged by their corners' clearances and stop coordinates with a safety margin, are
/// split until enough of them pass. Follows the stop: a small stop's pre-image is found however
/// small it is.
template <class T>
Pupil find_pupil(const OpticalSystem& system, const TracePath<T>& path, const BeamFrame& frame,
                 PupilSearch search = PupilSearch::thorough);

/// (cells + 1)² points over a box, row by row from v0 and u0.
template <class T>
void lay_grid(const PupilBox& box, int cells, Bundle<T>& bundle);

}  // namespace ghostlight
