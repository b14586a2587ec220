#pragma once

#include <cstddef>
#include <vector>

#include "core/flare/color_mesh.h"
#include "core/ghosts/mirror_grid.h"

namespace ghostlight {

/// Whether a node's ray is valid and every clearance is at least `least`.
bool is_within(const MeshNodes& nodes, std::size_t node, double least);

/// Light beyond the rim that a bend or a shift may be measured on, in units of a clearance.
inline constexpr double near_rim = -0.15;

/// Of the bend times the contrast: only its part across an edge counts, and most of the contrast
/// is at rims, where chords follow the bend. Calibrated on all bundled lenses, see
/// docs/benchmarks.md.
inline constexpr double grid_factor = 0.3;
/// Of a chord's height: unbiased chords are off by a quarter of it on average.
inline constexpr double rim_factor = 0.25;

/// How far a grid's nodes are from the means of their neighbours, RMS over what passes and lands
/// near the frame: what a grid twice as coarse gets wrong, hence four times what this one does.
double bend_px(const MeshNodes& nodes, const PixelFrame& frame);

/// How far the chords that a grid draws a rim by are from it in their middle, mean over the cells
/// that a rim goes through. Falls fourfold on doubling the grid.
double rim_px(const MeshNodes& nodes, const PixelFrame& frame);

/// RMS distance between the nodes of two grids on the sensor, over what passes both.
double shift_px(const MeshNodes& a, const MeshNodes& b);

/// How far the light of a half grid's rays is from the mean of their neighbours, as a share of it:
/// four times what interpolating it gets wrong, divided by four.
double roughness(const MirrorGrid& grid, const std::vector<float>& light);

/// Cells, of the half with u ≥ 0, beside failing rays or the onset of total reflection, unless
/// something else stops all their light: there map and weight go as a square root.
std::vector<int> singular_cells(const MirrorGrid& grid, const MeshNodes& nodes);

/// The light through cells of the half with u ≥ 0 and their mirror images, mm² over E0.
double light_in(const std::vector<int>& cells, const MeshNodes& nodes);

/// What a probe says of the light that a ghost brings to the frame.
struct FrameLight {
    double flux_mm2 = 0.0;
    double whole_flux_mm2 = 0.0;  ///< on the frame or beside it
    bool passes = false, near_frame = false;
};
FrameLight light_on_frame(const MeshNodes& nodes, const PixelFrame& frame);

}  // namespace ghostlight
