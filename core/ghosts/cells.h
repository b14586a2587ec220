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
    static constexpr int max_corners = 16;
    PieceCorner corners[max_corners];
    int count = 0;
    int triangle = 0;   ///< 2 × cell + (0 lower half, 1 upper half)
    bool whole = true;  ///< the triangle unclipped
};

/// A traced square grid of (cells + 1)² rays and the functions that clip it: each is ≥ 0 where
/// light passes (validity, 1 − r_rel, and the stop's margin at each crossing).
template <class T>
struct BundleGrid {
    Bundle<T> rays;
    int cells = 0;
    std::vector<std::vector<T>> clearances;
};

/// Corner nodes of a triangle at a stride (every `stride`-th node makes a coarser grid).
struct TriangleNodes {
    int node[3];
};
inline TriangleNodes triangle_nodes(int cells, int stride, int triangle) {
    const int across = cells / stride;
    const int cell = triangle / 2;
    const int side = cells + 1;
    const int a = (cell / across) * stride * side + (cell % across) * stride;
    const int b = a + stride, c = a + stride * side, d = c + stride;
    // Diagonals mirror about the middle, so that a symmetric bundle has a symmetric grid.
    if (2 * (cell % across) < across)
        return triangle % 2 == 0 ? TriangleNodes{{a, b, c}} : TriangleNodes{{d, c, b}};
    return triangle % 2 == 0 ? TriangleNodes{{a, b, d}} : TriangleNodes{{d, c, a}};
}

/// The part of a triangle that passes; count is 0 when nothing does.
template <class T>
Piece clip_triangle(const BundleGrid<T>& grid, int stride, int triangle);

/// A grid whose cells at the edge of a miss or of total reflection are traced again, each on a
/// grid of its own: the map and the weight have a square-root singularity there, on which
/// interpolation fails.
template <class T>
struct SplitGrid {
    BundleGrid<T> base;
    std::vector<int> split_of_cell;     ///< index into `splits`, −1 for an ordinary cell
    std::vector<BundleGrid<T>> splits;  ///< one per singular cell

    std::size_t rays() const {
        std::size_t count = base.rays.size();
        for (const auto& split : splits) count += split.rays.size();
        return count;
    }
};

/// Traces a box on cells × cells, and its singular cells on split_cells × split_cells each.
template <class T>
SplitGrid<T> trace_grid(const OpticalSystem& system, const TracePath<T>& path,
                        const BeamFrame& frame, const PupilBox& box, int cells, int split_cells,
                        Weights weights);

/// Calls visit(grid, stride, piece) for every piece that passes, on the grid or, with a stride of
/// 2 or 4, on the coarser grids that it holds.
template <class T, class Visit>
void for_each_piece(const SplitGrid<T>& grid, int stride, Visit visit) {
    auto both_halves = [&](const BundleGrid<T>& on, int step, int cell) {
        for (int half = 0; half < 2; ++half) {
            const Piece piece = clip_triangle(on, step, 2 * cell + half);
            if (piece.count >= 3) visit(on, step, piece);
        }
    };
    const int across = grid.base.cells / stride;
    for (int cell = 0; cell < across * across; ++cell) {
        const int i0 = cell % across * stride, j0 = cell / across * stride;
        auto base_cell = [&](int k) { return (j0 + k / stride) * grid.base.cells + i0 + k % stride; };
        auto split = [&](int k) {
            return grid.split_of_cell[static_cast<std::size_t>(base_cell(k))];
        };
        bool ordinary = true;
        for (int k = 0; k < stride * stride; ++k) ordinary = ordinary && split(k) < 0;
        if (ordinary) {
            both_halves(grid.base, stride, cell);
            continue;
        }
        for (int k = 0; k < stride * stride; ++k) {
            if (split(k) < 0) {
                both_halves(grid.base, 1, base_cell(k));
                continue;
            }
            const BundleGrid<T>& finer = grid.splits[static_cast<std::size_t>(split(k))];
            const int finer_across = finer.cells / stride;
            for (int c = 0; c < finer_across * finer_across; ++c) both_halves(finer, stride, c);
        }
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
