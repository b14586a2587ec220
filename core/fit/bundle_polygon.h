#pragma once

#include <ceres/jet.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/fit/fit_data.h"
#include "core/fit/ghost_pieces.h"
#include "core/ghosts/clip_shares.h"

// How the cells of a traced grid become points, small against a sample, that a smooth footprint
// makes a picture of. On the scalar S: double for the picture, ceres::Jet for its slopes, so that
// the slope is that of the very picture: of the interior by how points move on the sensor, of the
// rims by how corners move in the pupil.

namespace ghostlight {

inline double number(double x) { return x; }
template <class T, int N>
double number(const ceres::Jet<T, N>& x) {
    return x.a;
}

/// Beyond the frame's edge a footprint still reaches in, samples.
inline constexpr double beyond_edge = spline_reach + 0.5;

template <class S>
struct BundlePolygon {
    struct Corner {
        S u, v, x, y;
    };
    static constexpr int most_corners = Piece::max_corners + 16;
    std::array<Corner, most_corners> corners;
    int count = 0;
};

/// The part of a polygon to one side of a line across the sensor.
template <class S>
BundlePolygon<S> half_of(const BundlePolygon<S>& polygon, bool along_x, double middle,
                         double side) {
    BundlePolygon<S> result;
    auto value = [&](const auto& c) { return S(side * ((along_x ? c.x : c.y) - middle)); };
    for (int k = 0; k < polygon.count; ++k) {
        const auto& a = polygon.corners[static_cast<std::size_t>(k)];
        const auto& b = polygon.corners[static_cast<std::size_t>((k + 1) % polygon.count)];
        const S va = value(a), vb = value(b);
        auto add = [&](const auto& corner) {
            if (result.count < BundlePolygon<S>::most_corners)
                result.corners[static_cast<std::size_t>(result.count++)] = corner;
        };
        if (number(va) >= 0.0) add(a);
        if ((number(va) >= 0.0) != (number(vb) >= 0.0)) {
            const S t = va / (va - vb);
            auto at = [&t](const S& p, const S& q) { return S(p + t * (q - p)); };
            add(typename BundlePolygon<S>::Corner{at(a.u, b.u), at(a.v, b.v), at(a.x, b.x),
                                                  at(a.y, b.y)});
        }
    }
    return result;
}

/// Middle and area of a polygon, fanned from its first corner.
template <class S>
PieceOf<S> middle_of(const BundlePolygon<S>& polygon) {
    PieceOf<S> sum{S(0.0), S(0.0), S(0.0), S(0.0), S(0.0)};
    const auto& a = polygon.corners[0];
    for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(polygon.count); ++k) {
        const auto &b = polygon.corners[k], &c = polygon.corners[k + 1];
        S area = 0.5 * ((b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v));
        if (number(area) < 0.0) area = -area;
        sum.area_mm2 += area;
        sum.x_mm += area * (a.x + b.x + c.x) / 3.0;
        sum.y_mm += area * (a.y + b.y + c.y) / 3.0;
        sum.u += area * (a.u + b.u + c.u) / 3.0;
        sum.v += area * (a.v + b.v + c.v) / 3.0;
    }
    if (number(sum.area_mm2) > 0.0) {
        const S inverse = 1.0 / sum.area_mm2;
        sum.x_mm *= inverse;
        sum.y_mm *= inverse;
        sum.u *= inverse;
        sum.v *= inverse;
    }
    return sum;
}

template <class S>
bool matters(const PieceOf<S>& piece, const PixelFrame& frame) {
    const double margin = beyond_edge * frame.pitch_mm;
    return number(piece.area_mm2) > 0.0 && std::abs(number(piece.x_mm)) < -frame.left_mm + margin &&
           std::abs(number(piece.y_mm)) < -frame.bottom_mm + margin;
}

/// The bounds of values on the sensor, and whether a footprint from there reaches the frame.
struct SensorBounds {
    double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
    void add(double x, double y) {
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = std::min(y0, y);
        y1 = std::max(y1, y);
    }
    bool reaches(const PixelFrame& frame) const {
        const double margin = beyond_edge * frame.pitch_mm;
        const double right = -frame.left_mm + margin, top = -frame.bottom_mm + margin;
        return !(x0 > right || x1 < -right || y0 > top || y1 < -top);
    }
};

/// A polygon, cut until its parts are small against a sample: take(PieceOf<S>) for each that
/// matters. `spacing`: of points, samples.
template <class S, class Take>
void cut(const BundlePolygon<S>& polygon, const PixelFrame& frame, double spacing, int depth,
         const Take& take) {
    SensorBounds bounds;
    for (std::size_t k = 0; k < static_cast<std::size_t>(polygon.count); ++k)
        bounds.add(number(polygon.corners[k].x), number(polygon.corners[k].y));
    if (!bounds.reaches(frame)) return;
    const double wide = bounds.x1 - bounds.x0, high = bounds.y1 - bounds.y0;
    if (std::max(wide, high) <= spacing * frame.pitch_mm || depth == 0) {
        const PieceOf<S> piece = middle_of(polygon);
        if (matters(piece, frame)) take(piece);
        return;
    }
    const bool along_x = wide > high;
    const double middle = along_x ? 0.5 * (bounds.x0 + bounds.x1) : 0.5 * (bounds.y0 + bounds.y1);
    for (const double side : {1.0, -1.0})
        if (const auto half = half_of(polygon, along_x, middle, side); half.count >= 3)
            cut(half, frame, spacing, depth - 1, take);
}

/// What a cell of a grid is: dark, passed by all of its light, or cut by an edge.
enum class CellKind { dark, whole, cut };
inline CellKind cell_kind(const BundleGrid<float>& grid, int cell) {
    const auto side = static_cast<std::size_t>(grid.cells) + 1;
    const std::size_t a = static_cast<std::size_t>(cell / grid.cells) * side +
                          static_cast<std::size_t>(cell % grid.cells);
    bool whole = true;
    for (const auto& clearance : grid.field.clearances) {
        bool any = false;
        for (const std::size_t c : {a, a + 1, a + side, a + side + 1}) {
            any = any || clearance[c] >= 0.0F;
            whole = whole && clearance[c] >= 0.0F;
        }
        if (!any) return CellKind::dark;
    }
    return whole ? CellKind::whole : CellKind::cut;
}

/// Calls visit(grid, cell) for the cells of a grid, those of its finer parts in place of what they
/// stand for.
template <class Visit>
void for_each_cell(const SplitGrid<float>& grid, const Visit& visit) {
    for (int cell = 0; cell < grid.base.cells * grid.base.cells; ++cell) {
        const int split = grid.split_of_cell[static_cast<std::size_t>(cell)];
        if (split < 0) {
            visit(grid.base, cell);
            continue;
        }
        const BundleGrid<float>& finer = grid.splits[static_cast<std::size_t>(split)];
        for (int c = 0; c < finer.cells * finer.cells; ++c) visit(finer, c);
    }
}

/// Points of a cell: a lattice of them where all of it passes, else its clipped halves, cut.
/// `field` gives x(node), y(node) and clearance(k, node) on the scalar S. Calls take(PieceOf<S>).
template <class S, class Field, class Take>
void for_each_point(const BundleGrid<float>& grid, const Field& field, int cell,
                    const PixelFrame& frame, double spacing, const Take& take) {
    constexpr int most_points = 24;  ///< across a cell
    constexpr int most_halvings = 8;
    const CellKind kind = cell_kind(grid, cell);
    if (kind == CellKind::dark) return;
    const Bundle<float>& rays = grid.field.rays;
    auto u_of = [&](std::size_t node) { return static_cast<double>(rays.u_mm[node]); };
    auto v_of = [&](std::size_t node) { return static_cast<double>(rays.v_mm[node]); };
    if (kind == CellKind::cut) {
        for (int t = 2 * cell; t < 2 * cell + 2; ++t) {
            const TriangleNodes nodes = triangle_nodes(grid.cells, t);
            std::size_t node[3];
            for (int s = 0; s < 3; ++s) node[s] = static_cast<std::size_t>(nodes.node[s]);
            const auto clipped =
                clip_shares<S>(grid.field.clearances.size(),
                               [&](std::size_t k, int s) { return field.clearance(k, node[s]); });
            if (clipped.count < 3) continue;
            // A failed ray's sensor point means nothing: it takes the mean of its valid
            // neighbours'.
            S x[3], y[3], x_mean(0.0), y_mean(0.0);
            int valid = 0;
            for (int s = 0; s < 3; ++s) {
                x[s] = field.x(node[s]);
                y[s] = field.y(node[s]);
                if (rays.margin[node[s]] < 0.0F) continue;
                x_mean += x[s];
                y_mean += y[s];
                ++valid;
            }
            for (int s = 0; s < 3 && valid > 0; ++s)
                if (rays.margin[node[s]] < 0.0F) {
                    x[s] = x_mean / static_cast<double>(valid);
                    y[s] = y_mean / static_cast<double>(valid);
                }
            BundlePolygon<S> polygon;
            polygon.count = clipped.count;
            for (int k = 0; k < clipped.count; ++k) {
                const S* share = clipped.corners[k].share;
                auto& corner = polygon.corners[static_cast<std::size_t>(k)];
                corner.u =
                    share[0] * u_of(node[0]) + share[1] * u_of(node[1]) + share[2] * u_of(node[2]);
                corner.v =
                    share[0] * v_of(node[0]) + share[1] * v_of(node[1]) + share[2] * v_of(node[2]);
                corner.x = share[0] * x[0] + share[1] * x[1] + share[2] * x[2];
                corner.y = share[0] * y[0] + share[1] * y[1] + share[2] * y[2];
            }
            cut(polygon, frame, spacing, most_halvings, take);
        }
        return;
    }
    const auto side = static_cast<std::size_t>(grid.cells) + 1;
    const std::size_t a = static_cast<std::size_t>(cell / grid.cells) * side +
                          static_cast<std::size_t>(cell % grid.cells);
    const std::size_t corners[4] = {a, a + 1, a + side, a + side + 1};
    SensorBounds bounds;
    double x[4], y[4];
    for (int k = 0; k < 4; ++k) {
        x[k] = static_cast<double>(rays.x_mm[corners[k]]);
        y[k] = static_cast<double>(rays.y_mm[corners[k]]);
        bounds.add(x[k], y[k]);
    }
    if (!bounds.reaches(frame)) return;
    auto points = [&](int p, int q, int r, int s) {
        const double length =
            std::max(std::hypot(x[q] - x[p], y[q] - y[p]), std::hypot(x[s] - x[r], y[s] - y[r]));
        return std::clamp(static_cast<int>(std::ceil(length / (spacing * frame.pitch_mm))), 1,
                          most_points);
    };
    const int along_u = points(0, 1, 2, 3), along_v = points(0, 2, 1, 3);
    const double u0 = u_of(a), v0 = v_of(a), du = u_of(a + 1) - u0, dv = v_of(a + side) - v0;
    const double area_mm2 = std::abs(du * dv) / (along_u * along_v);
    S xs[4], ys[4];
    for (int k = 0; k < 4; ++k) {
        xs[k] = field.x(corners[k]);
        ys[k] = field.y(corners[k]);
    }
    for (int j = 0; j < along_v; ++j)
        for (int i = 0; i < along_u; ++i) {
            const double f = (i + 0.5) / along_u, g = (j + 0.5) / along_v;
            auto at = [&](const S* w) {
                return S((1.0 - g) * ((1.0 - f) * w[0] + f * w[1]) +
                         g * ((1.0 - f) * w[2] + f * w[3]));
            };
            const PieceOf<S> point{at(xs), at(ys), S(u0 + f * du), S(v0 + g * dv), S(area_mm2)};
            if (matters(point, frame)) take(point);
        }
}

}  // namespace ghostlight
