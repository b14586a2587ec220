#pragma once

#include <cstddef>
#include <vector>

#include "core/ghosts/bundle.h"
#include "core/ghosts/pupil.h"

namespace ghostlight {

/// A square grid of rays of a beam in the y–z plane (azimuth 90°), through a box that is symmetric
/// about u = 0. A lens of round surfaces maps one half onto the mirror image of the other, so only
/// one half is traced: columns from u = 0 to u = u1.
struct MirrorGrid {
    PupilBox box;
    int cells = 0;  ///< across, an even number
    Bundle<float> half;
    /// Its mirror image, ray by ray, where the symmetry is not relied upon; else empty.
    Bundle<float> other = {};
    bool is_polarised = false;  ///< its weights are there, with polarisation carried

    int half_side() const { return cells / 2 + 1; }
    int side() const { return cells + 1; }
    /// Ray of the half grid that is, or mirrors, a node of the full one.
    std::size_t of_node(int i, int j) const {
        const int from_middle = i < cells / 2 ? cells / 2 - i : i - cells / 2;
        return static_cast<std::size_t>(j * half_side() + from_middle);
    }
    bool is_mirrored(int i) const { return i < cells / 2; }
};

/// Lays the half grid.
void lay_mirrored(MirrorGrid& grid);
/// Lays the other half.
void lay_other_half(MirrorGrid& grid);
/// Where the rays of both, traced, land on the mean, and through the narrower of their ways.
void take_mean_of_halves(MirrorGrid& grid);
/// Lays the half grid and traces it.
void trace_mirrored(const TracePath<float>& path, const BeamFrame& frame, Weights weights,
                    MirrorGrid& grid);

}  // namespace ghostlight
