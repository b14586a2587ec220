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
    int triangle = 0;   ///< 2 × cell + (0 lower left half, 1 upper right half)
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

template <class T>
BundleGrid<T> trace_grid(const OpticalSystem& system, const TracePath<T>& path,
                         const BeamFrame& frame, const PupilBox& box, int cells,
                         Weights weights);

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
    return triangle % 2 == 0 ? TriangleNodes{{a, b, c}} : TriangleNodes{{d, c, b}};
}

/// The part of a triangle that passes; count is 0 when nothing does.
template <class T>
Piece clip_triangle(const BundleGrid<T>& grid, int stride, int triangle);

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
