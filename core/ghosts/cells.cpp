#include "core/ghosts/cells.h"

#include <algorithm>
#include <cmath>

#include "core/ghosts/clip_shares.h"

namespace ghostlight {

template <class T>
RayField<T> trace_field(const OpticalSystem& system, const TracePath<T>& path,
                        const BeamFrame& frame, Bundle<T> rays, Weights weights) {
    RayField<T> field;
    field.rays = std::move(rays);
    trace_bundle(path, frame, weights, field.rays);
    const std::size_t count = field.rays.size();
    field.clearances.push_back(field.rays.margin);
    std::vector<T>& clear = field.clearances.emplace_back(count);
    for (std::size_t i = 0; i < count; ++i) clear[i] = T(1) - field.rays.r_rel[i];
    for (std::size_t k = 0; k < static_cast<std::size_t>(field.rays.stop_crossings); ++k) {
        const auto& u = field.rays.stop_u_mm[k];
        const auto& v = field.rays.stop_v_mm[k];
        for (int edge = 0; edge < stop_edges(system.stop_mask); ++edge) {
            std::vector<T>& open = field.clearances.emplace_back(count);
            for (std::size_t i = 0; i < count; ++i)
                open[i] = static_cast<T>(stop_margin(
                    system.stop_mask, edge, static_cast<double>(u[i]), static_cast<double>(v[i])));
        }
    }
    return field;
}

namespace {

template <class T>
BundleGrid<T> trace_cells(const OpticalSystem& system, const TracePath<T>& path,
                          const BeamFrame& frame, const PupilBox& box, int cells, Weights weights) {
    Bundle<T> rays;
    lay_grid(box, cells, rays);
    return {trace_field(system, path, frame, std::move(rays), weights), cells};
}

/// Within a cell of where rays begin to fail, or of where a reflection becomes total, unless
/// something else stops them all.
template <class T>
bool is_singular(const BundleGrid<T>& grid, int reflections, int cell) {
    const int side = grid.cells + 1;
    const int a = cell / grid.cells * side + cell % grid.cells;
    const int corners[4] = {a, a + 1, a + side, a + side + 1};
    auto range = [&](const std::vector<T>& values) {
        T low = values[static_cast<std::size_t>(a)], high = low;
        for (const int c : corners) {
            low = std::min(low, values[static_cast<std::size_t>(c)]);
            high = std::max(high, values[static_cast<std::size_t>(c)]);
        }
        return std::pair{low, high};
    };
    const auto [low, high] = range(grid.field.clearances[0]);
    if (high < T(0)) return false;
    bool singular = low <= high - low;
    for (int k = 0; k < reflections && !singular; ++k) {
        const auto [least, most] = range(grid.field.rays.onset[static_cast<std::size_t>(k)]);
        singular = least <= most - least && most >= least - most;
    }
    if (!singular) return false;
    for (std::size_t k = 1; k < grid.field.clearances.size(); ++k) {
        const auto [least, most] = range(grid.field.clearances[k]);
        if (most + T(0.5) * (most - least) < T(0)) return false;
    }
    return true;
}

}  // namespace

template <class T>
SplitGrid<T> trace_grid(const OpticalSystem& system, const TracePath<T>& path,
                        const BeamFrame& frame, const PupilBox& box, int cells, int split_cells,
                        Weights weights) {
    SplitGrid<T> grid;
    grid.base = trace_cells(system, path, frame, box, cells, weights);
    int reflections = 0;
    for (const TraceStep<T>& step : path.steps) reflections += step.reflects ? 1 : 0;
    reflections = std::min(reflections, 2);
    grid.split_of_cell.assign(static_cast<std::size_t>(cells * cells), -1);
    for (int cell = 0; cell < cells * cells; ++cell) {
        if (!is_singular(grid.base, reflections, cell)) continue;
        auto u = [&](int i) {
            return std::lerp(box.u0_mm, box.u1_mm, static_cast<double>(i) / cells);
        };
        auto v = [&](int j) {
            return std::lerp(box.v0_mm, box.v1_mm, static_cast<double>(j) / cells);
        };
        const int i = cell % cells, j = cell / cells;
        const Weights own = weights == Weights::none ? Weights::polarised : weights;
        grid.split_of_cell[static_cast<std::size_t>(cell)] = static_cast<int>(grid.splits.size());
        grid.splits.push_back(
            trace_cells(system, path, frame, {u(i), u(i + 1), v(j), v(j + 1)}, split_cells, own));
    }
    return grid;
}

template <class T>
Piece clip_triangle(const RayField<T>& field, const TriangleNodes& nodes, int triangle) {
    Piece piece;
    piece.triangle = triangle;
    const auto clipped = clip_shares<double>(field.clearances.size(), [&](std::size_t k, int s) {
        return static_cast<double>(field.clearances[k][static_cast<std::size_t>(nodes.node[s])]);
    });
    piece.whole = clipped.whole;
    if (clipped.count == 0) return piece;
    const Bundle<T>& rays = field.rays;
    // A failed ray's sensor point means nothing: it takes the mean of its valid neighbours'.
    double x[3], y[3], x_mean = 0.0, y_mean = 0.0;
    int valid = 0;
    for (int s = 0; s < 3; ++s) {
        const auto node = static_cast<std::size_t>(nodes.node[s]);
        x[s] = static_cast<double>(rays.x_mm[node]);
        y[s] = static_cast<double>(rays.y_mm[node]);
        if (rays.margin[node] < T(0)) continue;
        x_mean += x[s];
        y_mean += y[s];
        ++valid;
    }
    for (int s = 0; s < 3 && valid > 0; ++s)
        if (rays.margin[static_cast<std::size_t>(nodes.node[s])] < T(0)) {
            x[s] = x_mean / valid;
            y[s] = y_mean / valid;
        }
    for (int k = 0; k < clipped.count; ++k) {
        const double* share = clipped.corners[k].share;
        auto mixed = [&](const double* p) {
            return share[0] * p[0] + share[1] * p[1] + share[2] * p[2];
        };
        auto at = [&](const std::vector<T>& values) {
            double sum = 0.0;
            for (int s = 0; s < 3; ++s)
                sum +=
                    share[s] * static_cast<double>(values[static_cast<std::size_t>(nodes.node[s])]);
            return sum;
        };
        piece.corners[k] = {at(rays.u_mm), at(rays.v_mm), mixed(x), mixed(y), at(rays.weight)};
    }
    piece.count = clipped.count;
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

template SplitGrid<float> trace_grid(const OpticalSystem&, const TracePath<float>&,
                                     const BeamFrame&, const PupilBox&, int, int, Weights);
template SplitGrid<double> trace_grid(const OpticalSystem&, const TracePath<double>&,
                                      const BeamFrame&, const PupilBox&, int, int, Weights);
template RayField<float> trace_field(const OpticalSystem&, const TracePath<float>&,
                                     const BeamFrame&, Bundle<float>, Weights);
template RayField<double> trace_field(const OpticalSystem&, const TracePath<double>&,
                                      const BeamFrame&, Bundle<double>, Weights);
template Piece clip_triangle(const RayField<float>&, const TriangleNodes&, int);
template Piece clip_triangle(const RayField<double>&, const TriangleNodes&, int);

}  // namespace ghostlight
