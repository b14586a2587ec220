#include "core/fit/ghost_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fit/bundle_polygon.h"
#include "core/ghosts/pupil.h"

namespace ghostlight {
namespace {

constexpr int look_cells = 24;  ///< of the first look at where a bundle lands
constexpr int split_cells = 4;  ///< across a singular cell
/// Cells across: as fine as keeps the map bilinear to this share of a sample.
constexpr double bend = 0.03;
constexpr int least_cells = 48, most_cells = 128;
constexpr double color_margin = 0.04;  ///< of a pupil's breadth, shared by wavelengths
/// Samples: colours that are closer than this fall together, since the spline blurs them.
constexpr double merged_colors = 0.02;
/// Strata of the pupil, in |u| and v: one film ray each.
constexpr int strata_u = 3, strata_v = 5;

PupilBox widened(const PupilBox& box, double share, double extra_mm) {
    const double du = share * (box.u1_mm - box.u0_mm) + extra_mm,
                 dv = share * (box.v1_mm - box.v0_mm) + extra_mm;
    return {box.u0_mm - du, box.u1_mm + du, box.v0_mm - dv, box.v1_mm + dv};
}

/// The stop elsewhere: its margins again at the shifted crossings.
void move_stop(const OpticalSystem& system, const StopPlace& place, RayField<float>& field) {
    if (place == StopPlace{}) return;
    std::size_t which = 2;
    for (std::size_t k = 0; k < static_cast<std::size_t>(field.rays.stop_crossings); ++k)
        for (int edge = 0; edge < stop_edges(system.stop_mask); ++edge, ++which)
            for (std::size_t i = 0; i < field.rays.size(); ++i)
                field.clearances[which][i] = static_cast<float>(
                    stop_margin(system.stop_mask, edge,
                                static_cast<double>(field.rays.stop_u_mm[k][i]) - place.x_mm,
                                static_cast<double>(field.rays.stop_v_mm[k][i]) - place.y_mm));
}

/// The box of the cells whose rays may pass and land on the frame; the largest such cell's size.
struct Landing {
    PupilBox box;
    bool empty = true;
};
Landing landing(const RayField<float>& field, const PupilBox& box, const PixelFrame& frame) {
    const int side = look_cells + 1;
    const double margin_mm = 2.0 * frame.pitch_mm;
    const double left = frame.left_mm - margin_mm, right = -left;
    const double bottom = frame.bottom_mm - margin_mm, top = -bottom;
    Landing found;
    int i0 = look_cells, i1 = -1, j0 = look_cells, j1 = -1;
    for (int j = 0; j < look_cells; ++j)
        for (int i = 0; i < look_cells; ++i) {
            const auto a = static_cast<std::size_t>(j * side + i);
            const std::size_t corners[4] = {a, a + 1, a + side, a + side + 1};
            bool may_pass = true;
            for (const auto& clearance : field.clearances) {
                float high = clearance[a], low = high;
                for (const std::size_t c : corners) {
                    high = std::max(high, clearance[c]);
                    low = std::min(low, clearance[c]);
                }
                may_pass = may_pass && high + 0.5F * (high - low) >= 0.0F;
            }
            if (!may_pass) continue;
            double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
            for (const std::size_t c : corners) {
                x0 = std::min(x0, static_cast<double>(field.rays.x_mm[c]));
                x1 = std::max(x1, static_cast<double>(field.rays.x_mm[c]));
                y0 = std::min(y0, static_cast<double>(field.rays.y_mm[c]));
                y1 = std::max(y1, static_cast<double>(field.rays.y_mm[c]));
            }
            const double wx = x1 - x0, wy = y1 - y0;
            if (x1 + 0.3 * wx < left || x0 - 0.3 * wx > right || y1 + 0.3 * wy < bottom ||
                y0 - 0.3 * wy > top)
                continue;
            i0 = std::min(i0, i);
            i1 = std::max(i1, i);
            j0 = std::min(j0, j);
            j1 = std::max(j1, j);
        }
    if (i1 < 0) return found;
    auto u = [&](int i) {
        return std::lerp(box.u0_mm, box.u1_mm, static_cast<double>(i) / look_cells);
    };
    auto v = [&](int j) {
        return std::lerp(box.v0_mm, box.v1_mm, static_cast<double>(j) / look_cells);
    };
    found.empty = false;
    found.box = {u(std::max(0, i0 - 1)), u(std::min(look_cells, i1 + 2)), v(std::max(0, j0 - 1)),
                 v(std::min(look_cells, j1 + 2))};
    return found;
}

/// Box, cells and nodes; what depends on the pieces comes with them.
GhostGrid found_grid(const FitScene& scene, const GhostPath& path, const BeamFrame& frame,
                     const PixelFrame& pixels, bool main_only) {
    GhostGrid grid;
    const OpticalSystem& system = scene.system();
    const auto trace = trace_path<float>(system, path);
    const Pupil pupil = find_pupil(system, trace, frame, PupilSearch::quick);
    grid.traced += pupil.rays;
    if (pupil.empty()) return grid;
    const double stop_shift_mm = std::hypot(scene.lens.stop.x_mm, scene.lens.stop.y_mm);
    const PupilBox wide = widened(pupil.box, color_margin, stop_shift_mm);
    Bundle<float> points;
    lay_grid(wide, look_cells, points);
    RayField<float> look = trace_field(system, trace, frame, std::move(points), Weights::none);
    move_stop(system, scene.lens.stop, look);
    grid.traced += look.rays.size();
    const Landing on = landing(look, wide, pixels);
    if (on.empty) return grid;
    grid.box = on.box;
    const double reach_mm = std::hypot(2.0 * pixels.left_mm, 2.0 * pixels.bottom_mm);
    grid.cells =
        std::max(least_cells, cells_for_bend(probe_bundle(system, trace, frame, grid.box),
                                             bend * pixels.pitch_mm, reach_mm, most_cells));
    grid.nodes.push_back(scene.main);
    if (!main_only && scene.geometry.size() > 1) {
        // How far the outer wavelengths land from each other, where they pass.
        double apart_mm = 0.0;
        for (const std::size_t node : {std::size_t{0}, scene.geometry.size() - 1}) {
            Bundle<float> again;
            lay_grid(wide, look_cells, again);
            const auto other =
                trace_field(scene.geometry[node], trace_path<float>(scene.geometry[node], path),
                            frame, std::move(again), Weights::none);
            grid.traced += other.rays.size();
            for (std::size_t i = 0; i < other.rays.size(); ++i) {
                bool passes = true;
                for (const auto& clearance : look.clearances)
                    passes = passes && clearance[i] >= 0.0F;
                if (!passes) continue;
                const double dx = static_cast<double>(other.rays.x_mm[i] - look.rays.x_mm[i]),
                             dy = static_cast<double>(other.rays.y_mm[i] - look.rays.y_mm[i]);
                apart_mm = std::max(apart_mm, std::hypot(dx, dy));
            }
        }
        if (apart_mm >= merged_colors * pixels.pitch_mm) {
            grid.nodes.clear();
            for (std::size_t node = 0; node < scene.geometry.size(); ++node)
                grid.nodes.push_back(node);
        }
    }
    return grid;
}

/// The points themselves, u and v in mm.
template <class Take>
void points_of(const SplitGrid<float>& grid, const PixelFrame& pixels, double spacing,
               const Take& take) {
    struct Values {
        const RayField<float>& field;
        double x(std::size_t node) const { return static_cast<double>(field.rays.x_mm[node]); }
        double y(std::size_t node) const { return static_cast<double>(field.rays.y_mm[node]); }
        double clearance(std::size_t k, std::size_t node) const {
            return static_cast<double>(field.clearances[k][node]);
        }
    };
    for_each_cell(grid, [&](const BundleGrid<float>& on, int cell) {
        for_each_point<double>(on, Values{on.field}, cell, pixels, spacing, take);
    });
}

/// The part of the pupil that matters, and one ray for each part of it. Mirrored halves weigh alike
/// about the meridional plane, u = 0.
void set_strata(const std::vector<std::vector<BundlePiece>>& at_node, GhostGrid& grid) {
    double u1 = 0.0, v0 = std::numeric_limits<double>::infinity(), v1 = -v0;
    for (const auto& list : at_node)
        for (const BundlePiece& piece : list) {
            u1 = std::max(u1, std::abs(piece.u));
            v0 = std::min(v0, piece.v);
            v1 = std::max(v1, piece.v);
        }
    if (v0 > v1) return;
    grid.u_half_mm = std::max(u1, 1e-9);
    grid.v_mid_mm = 0.5 * (v0 + v1);
    grid.v_half_mm = std::max(0.5 * (v1 - v0), 1e-9);
    std::vector<std::array<double, 3>> strata(strata_u * strata_v, {0, 0, 0});
    for (const auto& list : at_node)
        for (const BundlePiece& piece : list) {
            const double u = std::abs(piece.u) / grid.u_half_mm,
                         v = (piece.v - grid.v_mid_mm) / grid.v_half_mm;
            const int i = std::min(strata_u - 1, static_cast<int>(u * strata_u));
            const int j = std::clamp(static_cast<int>(0.5 * (v + 1.0) * strata_v), 0, strata_v - 1);
            auto& stratum = strata[static_cast<std::size_t>(i * strata_v + j)];
            stratum[0] += piece.area_mm2 * std::abs(piece.u);
            stratum[1] += piece.area_mm2 * piece.v;
            stratum[2] += piece.area_mm2;
        }
    double all = 0.0;
    for (const auto& stratum : strata) all += stratum[2];
    for (const auto& [u, v, area] : strata) {
        // A sliver of a stratum says nothing that its neighbours do not.
        if (!(area > 1e-3 * all)) continue;
        grid.ray_places.push_back({u / area, v / area});
        grid.ray_areas.push_back(area);
    }
}

GhostPieces traced_pieces(const FitScene& scene, const GhostPath& path, const BeamFrame& frame,
                          const PixelFrame& pixels, GhostGrid found, bool with_strata) {
    GhostPieces pieces;
    pieces.grid = std::move(found);
    pieces.traced = pieces.grid.traced;
    if (pieces.grid.empty()) return pieces;
    for (const std::size_t node : pieces.grid.nodes) {
        const SplitGrid<float> rays = traced_grid(scene, node, path, frame, pieces.grid);
        pieces.traced += rays.rays();
        auto& list = pieces.at_node.emplace_back();
        points_of(rays, pixels, pieces.grid.point_spacing,
                  [&](const BundlePiece& piece) { list.push_back(piece); });
    }
    if (with_strata) set_strata(pieces.at_node, pieces.grid);
    if (pieces.empty()) {
        pieces.at_node.clear();
        return pieces;
    }
    for (auto& list : pieces.at_node)
        for (BundlePiece& piece : list) {
            piece.u /= pieces.grid.u_half_mm;
            piece.v = (piece.v - pieces.grid.v_mid_mm) / pieces.grid.v_half_mm;
        }
    return pieces;
}

}  // namespace

SplitGrid<float> traced_grid(const FitScene& scene, std::size_t node, const GhostPath& path,
                             const BeamFrame& frame, const GhostGrid& grid) {
    const OpticalSystem& system = scene.geometry[node];
    auto rays = trace_grid(system, trace_path<float>(system, path), frame, grid.box, grid.cells,
                           split_cells, Weights::none);
    move_stop(system, scene.lens.stop, rays.base.field);
    for (auto& split : rays.splits) move_stop(system, scene.lens.stop, split.field);
    return rays;
}

GhostPieces ghost_pieces(const FitScene& scene, const GhostPath& path, const LightDirection& light,
                         const PixelFrame& frame, bool main_only) {
    const BeamFrame beam = beam_frame(light);
    return traced_pieces(scene, path, beam, frame, found_grid(scene, path, beam, frame, main_only),
                         true);
}

GhostPieces ghost_pieces(const FitScene& scene, const GhostPath& path, const LightDirection& light,
                         const PixelFrame& frame, const GhostGrid& grid) {
    return traced_pieces(scene, path, beam_frame(light), frame, grid, false);
}

}  // namespace ghostlight
