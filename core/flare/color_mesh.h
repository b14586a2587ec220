#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/flare/color_raster.h"
#include "core/flare/ghost_mesh.h"

namespace ghostlight {

/// The nodes of a square grid of rays as they land on the sensor, ready to be drawn.
struct MeshNodes {
    int cells = 0;                   ///< across; (cells + 1)² nodes, row by row
    double cell_area_mm2 = 0.0;      ///< on the plane across the beam
    std::vector<float> column, row;  ///< on the sensor, in full-size pixels
    std::vector<float> margin;       ///< < 0 where the ray fails
    /// Each ≥ 0 where light passes; linear interpolation between nodes has been made unbiased.
    std::vector<std::vector<float>> clearances;
    std::vector<float> weights;  ///< C a node: light per E0, in each channel
    std::vector<char> skipped;   ///< by cell: drawn elsewhere, on a grid of its own; empty: none
};

/// A ghost as the raster takes it, in full-size pixels.
template <int C>
struct ColorMesh {
    std::vector<ColorEdge<C>> edges;
    std::vector<ColorPoint<C>> points;
    std::array<double, C> flux_mm2{};  ///< Σ weight dA, on or off the sensor
    /// Σ |step of the last channel's value across an edge| × length: what blurring by a pixel
    /// costs. In irradiance / E0 × px.
    double edge_contrast = 0.0;
    /// Σ |step of that value's slope across an edge| × length, which is ∫ |∇²| over the ghost: what
    /// blurring costs where it is smooth but uneven. In irradiance / E0.
    double slope_contrast = 0.0;
    double area_px2 = 0.0;            ///< of all sheets near the frame
    std::size_t cells = 0;            ///< pieces drawn
    bool reaches_past_right = false;  ///< edges right of the frame have been left out
    void clear() { *this = {}; }
};

/// Adds a grid's pieces to a mesh. Each piece carries its flux exactly: its irradiance is linear
/// over it, from areas averaged at the nodes, and scaled so that its integral is the piece's flux.
/// Whole cells are drawn as quadrilaterals that share their edges, cells at the rim as clipped
/// triangles, cells on a fold as triangles of their own.
template <int C>
void add_grid(const MeshNodes& nodes, const PixelFrame& frame, ColorMesh<C>& mesh);

/// Makes the linear interpolation of a clearance unbiased: over a cell a function with second
/// differences D lies above its interpolation by −(D_u + D_v)/12 on average, which is added to the
/// nodes. A round rim drawn by chords then keeps its area to fourth order.
void correct_curvature(int cells, std::vector<float>& clearance);

}  // namespace ghostlight
