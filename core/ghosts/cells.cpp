#include "core/ghosts/cells.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {

template <class T>
BundleGrid<T> trace_grid(const OpticalSystem& system, const TracePath<T>& path,
                         const BeamFrame& frame, const PupilBox& box, int cells, Weights weights) {
    BundleGrid<T> grid;
    grid.cells = cells;
    lay_grid(box, cells, grid.rays);
    trace_bundle(path, frame, weights, grid.rays);
    const std::size_t count = grid.rays.size();
    grid.clearances.push_back(grid.rays.margin);
    std::vector<T>& clear = grid.clearances.emplace_back(count);
    for (std::size_t i = 0; i < count; ++i) clear[i] = T(1) - grid.rays.r_rel[i];
    for (int k = 0; k < grid.rays.stop_crossings; ++k) {
        std::vector<T>& open = grid.clearances.emplace_back(count);
        const auto& u = grid.rays.stop_u_mm[k];
        const auto& v = grid.rays.stop_v_mm[k];
        for (std::size_t i = 0; i < count; ++i)
            open[i] = static_cast<T>(stop_margin(system.stop_mask, u[i], v[i]));
    }
    return grid;
}

template <class T>
Piece clip_triangle(const BundleGrid<T>& grid, int stride, int triangle) {
    // Clearances are interpolated in the triangle's own coordinates: corner k of the polygon is
    // p = Σ share·node.
    struct Corner {
        double share[3];
    };
    const TriangleNodes nodes = triangle_nodes(grid.cells, stride, triangle);
    Corner corners[Piece::max_corners] = {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
    int count = 3;
    Piece piece;
    piece.triangle = triangle;
    for (const std::vector<T>& clearance : grid.clearances) {
        const double f[3] = {static_cast<double>(clearance[nodes.node[0]]),
                             static_cast<double>(clearance[nodes.node[1]]),
                             static_cast<double>(clearance[nodes.node[2]])};
        if (f[0] >= 0.0 && f[1] >= 0.0 && f[2] >= 0.0) continue;
        piece.whole = false;
        if (f[0] < 0.0 && f[1] < 0.0 && f[2] < 0.0) return piece;
        auto value = [&](const Corner& c) {
            return c.share[0] * f[0] + c.share[1] * f[1] + c.share[2] * f[2];
        };
        Corner kept[Piece::max_corners];
        int kept_count = 0;
        for (int k = 0; k < count; ++k) {
            const Corner& a = corners[k];
            const Corner& b = corners[(k + 1) % count];
            const double va = value(a), vb = value(b);
            if (va >= 0.0) kept[kept_count++] = a;
            if ((va >= 0.0) != (vb >= 0.0)) {
                const double t = va / (va - vb);
                Corner& cut = kept[kept_count++];
                for (int s = 0; s < 3; ++s) cut.share[s] = a.share[s] + t * (b.share[s] - a.share[s]);
            }
        }
        count = kept_count;
        if (count < 3) return piece;
        std::copy_n(kept, count, corners);
    }
    const Bundle<T>& rays = grid.rays;
    for (int k = 0; k < count; ++k) {
        auto at = [&](const std::vector<T>& values) {
            double sum = 0.0;
            for (int s = 0; s < 3; ++s)
                sum += corners[k].share[s] * static_cast<double>(values[nodes.node[s]]);
            return sum;
        };
        piece.corners[k] = {at(rays.u_mm), at(rays.v_mm), at(rays.x_mm), at(rays.y_mm),
                            at(rays.weight)};
    }
    piece.count = count;
    return piece;
}

double flux_mm2(const Piece& piece) {
    double sum = 0.0;
    const PieceCorner& o = piece.corners[0];
    for (int k = 1; k + 1 < piece.count; ++k) {
        const PieceCorner& a = piece.corners[k];
        const PieceCorner& b = piece.corners[k + 1];
        const double area = 0.5 * std::abs((a.u_mm - o.u_mm) * (b.v_mm - o.v_mm) -
                                           (b.u_mm - o.u_mm) * (a.v_mm - o.v_mm));
        sum += area * (o.weight + a.weight + b.weight) / 3.0;
    }
    return sum;
}

template BundleGrid<float> trace_grid(const OpticalSystem&, const TracePath<float>&,
                                      const BeamFrame&, const PupilBox&, int, Weights);
template BundleGrid<double> trace_grid(const OpticalSystem&, const TracePath<double>&,
                                       const BeamFrame&, const PupilBox&, int, Weights);
template Piece clip_triangle(const BundleGrid<float>&, int, int);
template Piece clip_triangle(const BundleGrid<double>&, int, int);

}  // namespace ghostlight
