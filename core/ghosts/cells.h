#pragma once

#include <vector>

#include "core/ghosts/bundle.h"
#include "core/ghosts/pupil.h"

namespace ghostlight {

/// A corner of a piece of a bundle: entrance point, sensor point, weight.
struct PieceCorner {
    double u_mm, v_mm, x_mm, y_mm, weight;
};

/// A convex piece of one triangle of a bundle's grid that passes everywhere: clipped where
/// interpolated clearances, stop margins or validity cross zero.
struct Piece {
    /// A convex polygon gains at most one corner per cut: 3, plus validity, clearance, the
    /// sensor's 4 sides and up to 3 crossings of a stop of up to 13 blades; more are not cut.
    static constexpr int max_corners = 48;
    PieceCorner corners[max_corners];
    int count = 0;
    int triangle = 0;   ///< 2 × cell + (0 lower half, 1 upper half)
    bool whole = true;  ///< the triangle unclipped
};

/// Traced rays and the functions that clip them: each is ≥ 0 where light passes (validity,
/// 1 − r_rel, and the stop's margin at each crossing).
template <class T>
struct RayField {
    Bundle<T> rays;
    std::vector<std::vector<T>> clearances;
};
/// Traces `rays` (u_mm, v_mm given) and works out the clearances.
template <class T>
RayField<T> trace_field(const OpticalSystem& system, const TracePath<T>& path,
                        const BeamFrame& frame, Bundle<T> rays, Weights weights);

struct TriangleNodes {
    int node[3];
};

/// The part of a triangle of rays that passes; count is 0 when nothing does.
template <class T>
Piece clip_triangle(const RayField<T>& field, const TriangleNodes& nodes, int triangle = 0);

/// A square grid of (cells + 1)² rays.
template <class T>
struct BundleGrid {
    RayField<T> field;
    int cells = 0;
};

/// Corner nodes of a cell's lower and upper half.
inline TriangleNodes triangle_nodes(int cells, int triangle) {
    const int cell = triangle / 2;
    const int side = cells + 1;
    const int a = cell / cells * side + cell % cells;
    const int b = a + 1, c = a + side, d = c + 1;
    // Diagonals mirror about the middle, so that a symmetric bundle has a symmetric grid.
    if (2 * (cell % cells) < cells)
        return triangle % 2 == 0 ? TriangleNodes{{a, b, c}} : TriangleNodes{{d, c, b}};
    return triangle % 2 == 0 ? TriangleNodes{{a, b, d}} : TriangleNodes{{d, c, a}};
}

/// A grid whose cells at the edge of a miss or at the onset of total reflection are traced again,
/// each on a grid of its own: the map and the weight have a square-root singularity there, on
/// which interpolation fails.
template <class T>
struct SplitGrid {
    BundleGrid<T> base;
    std::vector<int> split_of_cell;     ///< index into `splits`, −1 for an ordinary cell
    std::vector<BundleGrid<T>> splits;  ///< one per singular cell

    std::size_t rays() const {
        std::size_t count = base.field.rays.size();
        for (const auto& split : splits) count += split.field.rays.size();
        return count;
    }
};

/// Traces a box on cells × cells, and its singular cells on split_cells × split_cells each; the
/// latter always with a weight, polarised if `weights` is none.
template <class T>
SplitGrid<T> trace_grid(const OpticalSystem& system, const TracePath<T>& path,
                        const BeamFrame& frame, const PupilBox& box, int cells, int split_cells,
                        Weights weights);

/// Calls visit(grid, piece) for every piece that passes.
template <class T, class Visit>
void for_each_piece(const SplitGrid<T>& grid, Visit visit) {
    auto pieces_of = [&](const BundleGrid<T>& on, int cell) {
        for (int t = 2 * cell; t < 2 * cell + 2; ++t) {
            const Piece piece = clip_triangle(on.field, triangle_nodes(on.cells, t), t);
            if (piece.count >= 3) visit(on, piece);
        }
    };
    for (int cell = 0; cell < grid.base.cells * grid.base.cells; ++cell) {
        const int split = grid.split_of_cell[static_cast<std::size_t>(cell)];
        if (split < 0) {
            pieces_of(grid.base, cell);
            continue;
        }
        const BundleGrid<T>& finer = grid.splits[static_cast<std::size_t>(split)];
        for (int c = 0; c < finer.cells * finer.cells; ++c) pieces_of(finer, c);
    }
}

/// The part of a piece where `value(corner)` ≥ 0, for a function that is linear on the piece.
template <class Value>
Piece clipped(const Piece& piece, Value value) {
    Piece result;
    result.triangle = piece.triangle;
    result.whole = piece.whole;
    for (int k = 0; k < piece.count; ++k) {
        const PieceCorner& a = piece.corners[k];
        const PieceCorner& b = piece.corners[(k + 1) % piece.count];
        const double va = value(a), vb = value(b);
        if (va >= 0.0) result.corners[result.count++] = a;
        if ((va >= 0.0) != (vb >= 0.0)) {
            const double t = va / (va - vb);
            auto at = [t](double p, double q) { return p + t * (q - p); };
            result.corners[result.count++] = {at(a.u_mm, b.u_mm), at(a.v_mm, b.v_mm),
                                              at(a.x_mm, b.x_mm), at(a.y_mm, b.y_mm),
                                              at(a.weight, b.weight)};
            result.whole = false;
        } else if (va < 0.0) {
            result.whole = false;
        }
    }
    return result;
}

/// Integral over the piece of weight dA on the entrance plane, mm².
double flux_mm2(const Piece& piece);

}  // namespace ghostlight
