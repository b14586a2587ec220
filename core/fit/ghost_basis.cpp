#include "core/fit/ghost_basis.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/flare/flare_scene.h"
#include "core/ghosts/cells.h"
#include "core/ghosts/pupil.h"
#include "core/ghosts/weighted_grid.h"
#include "core/optics/trace_steps.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr int look_cells = 24;  ///< of the first look at where a bundle lands
constexpr int split_cells = 4;  ///< across a singular cell
/// Cells across: as fine as keeps the map bilinear to this share of a sample.
constexpr double bend = 0.03;
constexpr int least_cells = 48, most_cells = 128;
/// Of a sample: points this close leave aliases of the spline below 1e-3.
constexpr double point_spacing = 0.45;
constexpr int most_points = 24;        ///< across a cell
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

/// A piece, cut until it is small against a sample.
template <class Take>
void cut(const Piece& piece, const PixelFrame& frame, double largest_mm, int depth,
         const Take& take) {
    double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
    for (int k = 0; k < piece.count; ++k) {
        x0 = std::min(x0, piece.corners[k].x_mm);
        x1 = std::max(x1, piece.corners[k].x_mm);
        y0 = std::min(y0, piece.corners[k].y_mm);
        y1 = std::max(y1, piece.corners[k].y_mm);
    }
    const double margin = (spline_reach + 0.5) * frame.pitch_mm;
    const double right = -frame.left_mm + margin, top = -frame.bottom_mm + margin;
    if (x0 > right || x1 < -right || y0 > top || y1 < -top) return;
    if (std::max(x1 - x0, y1 - y0) <= largest_mm || depth == 0) {
        take(piece);
        return;
    }
    const bool along_x = x1 - x0 > y1 - y0;
    const double middle = along_x ? 0.5 * (x0 + x1) : 0.5 * (y0 + y1);
    for (const double side : {1.0, -1.0})
        if (const Piece half = clipped(piece,
                                       [&](const PieceCorner& c) {
                                           return side * ((along_x ? c.x_mm : c.y_mm) - middle);
                                       });
            half.count >= 3)
            cut(half, frame, largest_mm, depth - 1, take);
}

/// Middle and area of a polygon, fanned from its first corner.
BundlePiece middle_of(const Piece& piece) {
    BundlePiece sum{0, 0, 0, 0, 0};
    const PieceCorner& a = piece.corners[0];
    for (int k = 1; k + 1 < piece.count; ++k) {
        const PieceCorner &b = piece.corners[k], &c = piece.corners[k + 1];
        const double area = 0.5 * std::abs((b.u_mm - a.u_mm) * (c.v_mm - a.v_mm) -
                                           (c.u_mm - a.u_mm) * (b.v_mm - a.v_mm));
        sum.area_mm2 += area;
        sum.x_mm += area * (a.x_mm + b.x_mm + c.x_mm) / 3.0;
        sum.y_mm += area * (a.y_mm + b.y_mm + c.y_mm) / 3.0;
        sum.u += area * (a.u_mm + b.u_mm + c.u_mm) / 3.0;
        sum.v += area * (a.v_mm + b.v_mm + c.v_mm) / 3.0;
    }
    if (sum.area_mm2 > 0.0) {
        sum.x_mm /= sum.area_mm2;
        sum.y_mm /= sum.area_mm2;
        sum.u /= sum.area_mm2;
        sum.v /= sum.area_mm2;
    }
    return sum;
}

bool matters(const BundlePiece& piece, const PixelFrame& frame) {
    const double margin = (spline_reach + 0.5) * frame.pitch_mm;
    return piece.area_mm2 > 0.0 && std::abs(piece.x_mm) < -frame.left_mm + margin &&
           std::abs(piece.y_mm) < -frame.bottom_mm + margin;
}

/// The points of a cell: a lattice of them where all of it passes, else its clipped halves, cut.
template <class Take>
void add_cell(const BundleGrid<float>& grid, int cell, const PixelFrame& frame,
              std::vector<BundlePiece>& list, const Take& take) {
    const auto side = static_cast<std::size_t>(grid.cells) + 1;
    const std::size_t a = static_cast<std::size_t>(cell / grid.cells) * side +
                          static_cast<std::size_t>(cell % grid.cells);
    const std::size_t corners[4] = {a, a + 1, a + side, a + side + 1};
    bool whole = true;
    for (const auto& clearance : grid.field.clearances) {
        bool any = false;
        for (const std::size_t c : corners) {
            any = any || clearance[c] >= 0.0F;
            whole = whole && clearance[c] >= 0.0F;
        }
        if (!any) return;
    }
    if (!whole) {
        for (int t = 2 * cell; t < 2 * cell + 2; ++t) {
            const Piece piece = clip_triangle(grid.field, triangle_nodes(grid.cells, t), t);
            if (piece.count >= 3) cut(piece, frame, point_spacing * frame.pitch_mm, 8, take);
        }
        return;
    }
    const Bundle<float>& rays = grid.field.rays;
    double x[4], y[4], u[4], v[4];
    for (int k = 0; k < 4; ++k) {
        x[k] = static_cast<double>(rays.x_mm[corners[k]]);
        y[k] = static_cast<double>(rays.y_mm[corners[k]]);
        u[k] = static_cast<double>(rays.u_mm[corners[k]]);
        v[k] = static_cast<double>(rays.v_mm[corners[k]]);
    }
    const auto [x0, x1] = std::minmax({x[0], x[1], x[2], x[3]});
    const auto [y0, y1] = std::minmax({y[0], y[1], y[2], y[3]});
    const double margin = (spline_reach + 0.5) * frame.pitch_mm;
    const double right = -frame.left_mm + margin, top = -frame.bottom_mm + margin;
    if (x0 > right || x1 < -right || y0 > top || y1 < -top) return;
    auto points = [&](int p, int q, int r, int s) {
        const double length =
            std::max(std::hypot(x[q] - x[p], y[q] - y[p]), std::hypot(x[s] - x[r], y[s] - y[r]));
        return std::clamp(static_cast<int>(std::ceil(length / (point_spacing * frame.pitch_mm))), 1,
                          most_points);
    };
    const int along_u = points(0, 1, 2, 3), along_v = points(0, 2, 1, 3);
    const double area = std::abs((u[1] - u[0]) * (v[2] - v[0])) / (along_u * along_v);
    for (int j = 0; j < along_v; ++j)
        for (int i = 0; i < along_u; ++i) {
            const double f = (i + 0.5) / along_u, g = (j + 0.5) / along_v;
            auto at = [&](const double* w) {
                return std::lerp(std::lerp(w[0], w[1], f), std::lerp(w[2], w[3], f), g);
            };
            const BundlePiece point{at(x), at(y), at(u), at(v), area};
            if (matters(point, frame)) list.push_back(point);
        }
}

SplitGrid<float> traced_grid(const FitScene& scene, const OpticalSystem& system,
                             const GhostPath& path, const BeamFrame& frame, const PupilBox& box,
                             int cells) {
    auto grid = trace_grid(system, trace_path<float>(system, path), frame, box, cells, split_cells,
                           Weights::none);
    move_stop(system, scene.lens.stop, grid.base.field);
    for (auto& split : grid.splits) move_stop(system, scene.lens.stop, split.field);
    return grid;
}

/// A ray in double at every geometry node, its cosines interpolated to every wavelength.
FilmRay film_ray(const FitScene& scene, const GhostPath& path, const BeamFrame& frame,
                 const std::array<double, 2>& place, const std::vector<bool>& seen) {
    FilmRay found;
    const Prescription& lens = scene.lens.lens;
    const bool absorbs = lens.internal_transmittance;
    if (absorbs) found.passed.assign(scene.samples.size(), 1.0);
    std::vector<std::vector<double>> cosines;  // node by node
    for (std::size_t node = 0; node < scene.geometry.size(); ++node) {
        const auto trace = trace_path<double>(scene.geometry[node], path);
        const glm::dvec3 origin = place[0] * frame.e1 + place[1] * frame.e2;
        RayAt<double> ray{{origin.x, origin.y, origin.z},
                          {frame.direction.x, frame.direction.y, frame.direction.z}};
        Vec3<double> s(frame.e1.x, frame.e1.y, frame.e1.z);
        auto& own = cosines.emplace_back();
        std::size_t k = 0;
        auto absorb = [&](const Vec3<double>& start, double gap_mm, const Medium& medium) {
            if (!absorbs || node != scene.main) return;
            const Vec3<double>& end = ray.position;
            const double length_mm = std::sqrt(
                (end.x - start.x) * (end.x - start.x) + (end.y - start.y) * (end.y - start.y) +
                (end.z - start.z - gap_mm) * (end.z - start.z - gap_mm));
            for (std::size_t w = 0; w < scene.samples.size(); ++w)
                found.passed[w] *=
                    internal_transmittance(medium, scene.samples[w].wavelength_nm, length_mm);
        };
        for (const TraceStep<double>& step : trace.steps) {
            const Vec3<double> start = ray.position;
            const auto meeting = meet(step, trace.aspheric.data(), 1.0, ray);
            const auto row = static_cast<std::size_t>(step.surface);
            absorb(start, step.gap_mm,
                   step.sense > 0.0 ? medium_before(lens, row) : lens.surfaces[row].medium_after);
            const Vec3<double> before = ray.direction;
            turn(step, meeting, ray);
            if (!seen[k++]) continue;
            own.push_back(meeting.cos_incidence);
            if (node != scene.main) continue;
            const Vec3<double> n = cross(before, meeting.normal);
            const double n2 = dot(n, n);
            Vec3<double> now = s;
            if (n2 >= 1e-10) {
                const double inverse = 1.0 / std::sqrt(n2);
                now = Vec3<double>(n.x * inverse, n.y * inverse, n.z * inverse);
            }
            found.turn_cos.push_back(dot(s, now));
            found.turn_sin.push_back(dot(cross(before, s), now));
            s = now;
        }
    }
    const std::size_t events = cosines.front().size();
    for (std::size_t e = 0; e < events; ++e)
        for (const auto& shares : scene.nodes) {
            double cosine = 0.0;
            for (std::size_t node = 0; node < shares.size(); ++node)
                cosine += shares[node] * cosines[node][e];
            found.cosines.push_back(std::clamp(cosine, 0.0, 1.0));
        }
    return found;
}

/// Chebyshev nodes over the visible range, each with the colour of what a polynomial through the
/// nodes takes of it: ∫ power × colour × Lagrange's polynomial. Exact for weights that are
/// polynomials of the wavelength, so that a dozen nodes do for films; midpoints need thirty.
void set_samples(const Spectrum& spectrum, int count, FitScene& scene) {
    if (std::holds_alternative<Monochromatic>(spectrum)) {
        scene.samples = sample(spectrum, 1);
        scene.colors = sample_colors(spectrum, scene.samples);
        return;
    }
    constexpr double low_nm = 400.0, high_nm = 700.0;
    constexpr int fine = 600;
    for (int k = 0; k < count; ++k) {
        const double at = std::cos(std::numbers::pi * (2 * k + 1) / (2.0 * count));
        scene.samples.push_back({0.5 * (low_nm + high_nm) - 0.5 * (high_nm - low_nm) * at, 0.0});
    }
    scene.colors.resize(scene.samples.size());
    double power = 0.0;
    Rgb white;
    for (int i = 0; i < fine; ++i) {
        const double nm = low_nm + (high_nm - low_nm) * (i + 0.5) / fine;
        const double p = relative_power(spectrum, nm);
        const Xyz xyz = color_matching(nm);
        const Rgb rgb = linear_rec709({p * xyz.x, p * xyz.y, p * xyz.z});
        power += p;
        white = {white.r + rgb.r, white.g + rgb.g, white.b + rgb.b};
        for (std::size_t k = 0; k < scene.samples.size(); ++k) {
            const double own_nm = scene.samples[k].wavelength_nm;
            double share = 1.0;
            for (std::size_t other = 0; other < scene.samples.size(); ++other)
                if (other != k)
                    share *= (nm - scene.samples[other].wavelength_nm) /
                             (own_nm - scene.samples[other].wavelength_nm);
            scene.samples[k].weight += share * p;
            Rgb& color = scene.colors[k];
            color = {color.r + share * rgb.r, color.g + share * rgb.g, color.b + share * rgb.b};
        }
    }
    for (std::size_t k = 0; k < scene.samples.size(); ++k) {
        scene.samples[k].weight /= power;
        Rgb& color = scene.colors[k];
        color = {color.r / white.r, color.g / white.g, color.b / white.b};
    }
}

}  // namespace

FitScene fit_scene(const FittedLens& lens, const Spectrum& spectrum, int spectral_samples) {
    FitScene scene;
    scene.lens = lens;
    set_samples(spectrum, spectral_samples, scene);
    for (const double nm : geometry_wavelengths_nm(scene.samples))
        scene.geometry.push_back(compile(lens.lens, nm));
    scene.main = scene.geometry.size() / 2;
    for (const SpectralSample& each : scene.samples)
        scene.nodes.push_back(node_shares(scene.geometry, each.wavelength_nm));
    scene.ghosts = two_reflection_ghosts(scene.system());
    return scene;
}

std::array<double, pupil_terms> pupil_functions(double u, double v) {
    return {1.0, v, v * v, v * v * v, u * u, u * u * v};
}

GhostPieces ghost_pieces(const FitScene& scene, const GhostPath& path, const LightDirection& light,
                         const PixelFrame& pixels, bool main_only) {
    GhostPieces pieces;
    const BeamFrame frame = beam_frame(light);
    const OpticalSystem& system = scene.system();
    const auto trace = trace_path<float>(system, path);
    const Pupil pupil = find_pupil(system, trace, frame, PupilSearch::quick);
    pieces.traced += pupil.rays;
    if (pupil.empty()) return pieces;
    const double stop_shift_mm = std::hypot(scene.lens.stop.x_mm, scene.lens.stop.y_mm);
    const PupilBox wide = widened(pupil.box, color_margin, stop_shift_mm);
    Bundle<float> points;
    lay_grid(wide, look_cells, points);
    RayField<float> look = trace_field(system, trace, frame, std::move(points), Weights::none);
    move_stop(system, scene.lens.stop, look);
    pieces.traced += look.rays.size();
    const Landing on = landing(look, wide, pixels);
    if (on.empty) return pieces;
    const PupilBox& box = on.box;
    const double reach_mm = std::hypot(2.0 * pixels.left_mm, 2.0 * pixels.bottom_mm);
    const int cells =
        std::max(least_cells, cells_for_bend(probe_bundle(system, trace, frame, box),
                                             bend * pixels.pitch_mm, reach_mm, most_cells));
    std::vector<std::size_t> nodes;
    if (main_only || scene.geometry.size() == 1) {
        nodes.push_back(scene.main);
    } else {
        // How far the outer wavelengths land from each other, where they pass.
        double apart_mm = 0.0;
        for (const std::size_t node : {std::size_t{0}, scene.geometry.size() - 1}) {
            Bundle<float> again;
            lay_grid(wide, look_cells, again);
            const auto other =
                trace_field(scene.geometry[node], trace_path<float>(scene.geometry[node], path),
                            frame, std::move(again), Weights::none);
            pieces.traced += other.rays.size();
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
        if (apart_mm < merged_colors * pixels.pitch_mm)
            nodes.push_back(scene.main);
        else
            for (std::size_t node = 0; node < scene.geometry.size(); ++node) nodes.push_back(node);
    }
    for (const std::size_t node : nodes) {
        const SplitGrid<float> grid =
            traced_grid(scene, scene.geometry[node], path, frame, box, cells);
        pieces.traced += grid.rays();
        auto& list = pieces.at_node.emplace_back();
        auto take = [&](const Piece& piece) {
            const BundlePiece middle = middle_of(piece);
            if (matters(middle, pixels)) list.push_back(middle);
        };
        for (int cell = 0; cell < cells * cells; ++cell) {
            const int split = grid.split_of_cell[static_cast<std::size_t>(cell)];
            if (split < 0) {
                add_cell(grid.base, cell, pixels, list, take);
                continue;
            }
            const BundleGrid<float>& finer = grid.splits[static_cast<std::size_t>(split)];
            for (int c = 0; c < finer.cells * finer.cells; ++c)
                add_cell(finer, c, pixels, list, take);
        }
    }
    // The part of the pupil that matters, u and v from −1 to 1 over it. Mirrored halves weigh
    // alike about the meridional plane, u = 0.
    double u1 = 0.0, v0 = std::numeric_limits<double>::infinity(), v1 = -v0;
    for (const auto& list : pieces.at_node)
        for (const BundlePiece& piece : list) {
            u1 = std::max(u1, std::abs(piece.u));
            v0 = std::min(v0, piece.v);
            v1 = std::max(v1, piece.v);
        }
    if (v0 > v1) {
        pieces.at_node.clear();
        return pieces;
    }
    pieces.u_half_mm = std::max(u1, 1e-9);
    pieces.v_mid_mm = 0.5 * (v0 + v1);
    pieces.v_half_mm = std::max(0.5 * (v1 - v0), 1e-9);
    std::vector<std::array<double, 3>> strata(strata_u * strata_v, {0, 0, 0});
    for (auto& list : pieces.at_node)
        for (BundlePiece& piece : list) {
            const double u_mm = piece.u, v_mm = piece.v;
            piece.u = u_mm / pieces.u_half_mm;
            piece.v = (v_mm - pieces.v_mid_mm) / pieces.v_half_mm;
            const int i = std::min(strata_u - 1, static_cast<int>(std::abs(piece.u) * strata_u));
            const int j =
                std::clamp(static_cast<int>(0.5 * (piece.v + 1.0) * strata_v), 0, strata_v - 1);
            auto& stratum = strata[static_cast<std::size_t>(i * strata_v + j)];
            stratum[0] += piece.area_mm2 * std::abs(u_mm);
            stratum[1] += piece.area_mm2 * v_mm;
            stratum[2] += piece.area_mm2;
        }
    double all = 0.0;
    for (const auto& stratum : strata) all += stratum[2];
    for (const auto& [u, v, area] : strata) {
        // A sliver of a stratum says nothing that its neighbours do not.
        if (!(area > 1e-3 * all)) continue;
        pieces.ray_places.push_back({u / area, v / area});
        pieces.ray_areas.push_back(area);
    }
    return pieces;
}

GhostBasis ghost_basis(const FitScene& scene, std::size_t ghost, const LightDirection& light,
                       const PixelFrame& frame, const FitPlace& place, bool main_only) {
    const GhostPath& path = scene.ghosts[ghost];
    const GhostPieces pieces = ghost_pieces(scene, path, light, frame, main_only);
    GhostBasis basis;
    basis.ghost = ghost;
    basis.traced = pieces.traced;
    if (pieces.ray_places.empty()) return basis;
    const double c = std::cos(place.rotation_rad), s = std::sin(place.rotation_rad);
    auto column = [&](const BundlePiece& p) {
        return frame.column(c * p.x_mm - s * p.y_mm + place.shift_x_mm) - 0.5;
    };
    auto row = [&](const BundlePiece& p) {
        return frame.row(s * p.x_mm + c * p.y_mm + place.shift_y_mm) - 0.5;
    };
    double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
    for (const auto& list : pieces.at_node)
        for (const BundlePiece& piece : list) {
            x0 = std::min(x0, column(piece));
            x1 = std::max(x1, column(piece));
            y0 = std::min(y0, row(piece));
            y1 = std::max(y1, row(piece));
        }
    basis.first_column = std::max(0, static_cast<int>(std::floor(x0 - 1.0)));
    basis.first_row = std::max(0, static_cast<int>(std::floor(y0 - 1.0)));
    basis.columns =
        std::min(frame.width_px, static_cast<int>(std::ceil(x1 + 2.0))) - basis.first_column;
    basis.rows = std::min(frame.height_px, static_cast<int>(std::ceil(y1 + 2.0))) - basis.first_row;
    if (basis.columns <= 0 || basis.rows <= 0) return basis;
    basis.nodes = pieces.at_node.size();
    std::vector<double> sums(basis.width() * static_cast<std::size_t>(basis.columns * basis.rows),
                             0.0);
    for (std::size_t node = 0; node < basis.nodes; ++node)
        for (const BundlePiece& piece : pieces.at_node[node]) {
            auto terms = pupil_functions(piece.u, piece.v);
            for (double& term : terms) term *= piece.area_mm2 / frame.pixel_area_mm2();
            const double x = column(piece), y = row(piece);
            const int i0 = static_cast<int>(std::floor(x + 0.5)) - 1,
                      j0 = static_cast<int>(std::floor(y + 0.5)) - 1;
            for (int j = std::max(j0, basis.first_row);
                 j <= j0 + 2 && j < basis.first_row + basis.rows; ++j) {
                const double wy = spline(y - j);
                for (int i = std::max(i0, basis.first_column);
                     i <= i0 + 2 && i < basis.first_column + basis.columns; ++i) {
                    const double w = wy * spline(x - i);
                    double* to = &sums[basis.width() * static_cast<std::size_t>(
                                                           (j - basis.first_row) * basis.columns +
                                                           i - basis.first_column) +
                                       node * pupil_terms];
                    for (std::size_t t = 0; t < pupil_terms; ++t) to[t] += w * terms[t];
                }
            }
        }
    basis.values.assign(sums.begin(), sums.end());

    const auto trace = trace_path<double>(scene.system(), path);
    std::vector<bool> seen;
    for (const TraceStep<double>& step : trace.steps) {
        seen.push_back(!step.invisible);
        if (!step.invisible)
            basis.events.push_back(
                {static_cast<std::size_t>(step.surface), step.sense > 0.0, step.reflects});
    }
    const BeamFrame beam = beam_frame(light);
    const std::size_t count = pieces.ray_places.size();
    for (const auto& at : pieces.ray_places)
        basis.rays.push_back(film_ray(scene, path, beam, at, seen));
    // Weighted least squares of the rays' weights by the pupil functions, the smallest solution.
    Eigen::MatrixXd design(count, pupil_terms);
    Eigen::VectorXd root(count);
    for (std::size_t r = 0; r < count; ++r) {
        const auto terms =
            pupil_functions(pieces.ray_places[r][0] / pieces.u_half_mm,
                            (pieces.ray_places[r][1] - pieces.v_mid_mm) / pieces.v_half_mm);
        root(static_cast<Eigen::Index>(r)) = std::sqrt(pieces.ray_areas[r]);
        for (std::size_t t = 0; t < pupil_terms; ++t)
            design(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(t)) =
                root(static_cast<Eigen::Index>(r)) * terms[t];
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solved;
    solved.setThreshold(1e-6);
    solved.compute(design);
    const Eigen::MatrixXd projection = solved.pseudoInverse() * root.asDiagonal();
    for (Eigen::Index t = 0; t < pupil_terms; ++t)
        for (Eigen::Index r = 0; r < static_cast<Eigen::Index>(count); ++r)
            basis.projection.push_back(projection(t, r));
    return basis;
}

std::vector<GhostBasis> ghost_bases(const FitScene& scene, const LightDirection& light,
                                    const PixelFrame& frame, const FitPlace& place, bool main_only,
                                    unsigned threads, std::stop_token stop) {
    std::vector<GhostBasis> all(scene.ghosts.size());
    if (!parallel_for(all.size(), threads, std::move(stop), [&](std::size_t g) {
            all[g] = ghost_basis(scene, g, light, frame, place, main_only);
        }))
        return {};
    std::erase_if(all, [](const GhostBasis& basis) { return basis.empty(); });
    return all;
}

void add_place_slopes(const FitScene& scene, const GhostBasis& basis, const LightDirection& light,
                      const PixelFrame& frame, const FitPlace& place,
                      const std::vector<double>& coefficients,
                      std::array<std::vector<double>, 3>& slopes) {
    const GhostPieces pieces =
        ghost_pieces(scene, scene.ghosts[basis.ghost], light, frame, basis.nodes == 1);
    if (pieces.at_node.size() != basis.nodes) return;
    const double c = std::cos(place.rotation_rad), s = std::sin(place.rotation_rad);
    for (std::size_t node = 0; node < basis.nodes; ++node)
        for (const BundlePiece& piece : pieces.at_node[node]) {
            const auto terms = pupil_functions(piece.u, piece.v);
            std::array<double, 3> light_of{};
            for (std::size_t t = 0; t < pupil_terms; ++t)
                for (std::size_t ch = 0; ch < 3; ++ch)
                    light_of[ch] += terms[t] * coefficients[(node * pupil_terms + t) * 3 + ch];
            const double x_mm = c * piece.x_mm - s * piece.y_mm,
                         y_mm = s * piece.x_mm + c * piece.y_mm;
            const double x = frame.column(x_mm + place.shift_x_mm) - 0.5,
                         y = frame.row(y_mm + place.shift_y_mm) - 0.5;
            const double area = piece.area_mm2 / frame.pixel_area_mm2();
            const int i0 = static_cast<int>(std::floor(x + 0.5)) - 1,
                      j0 = static_cast<int>(std::floor(y + 0.5)) - 1;
            for (int j = std::max(0, j0); j <= j0 + 2 && j < frame.height_px; ++j)
                for (int i = std::max(0, i0); i <= i0 + 2 && i < frame.width_px; ++i) {
                    const double wx = spline(x - i), wy = spline(y - j);
                    const double by_x = area * spline_slope(x - i) * wy / frame.pitch_mm,
                                 by_y = area * wx * spline_slope(y - j) / frame.pitch_mm;
                    const std::size_t at = 3 * static_cast<std::size_t>(j * frame.width_px + i);
                    for (std::size_t ch = 0; ch < 3; ++ch) {
                        slopes[0][at + ch] += light_of[ch] * by_x;
                        slopes[1][at + ch] += light_of[ch] * by_y;
                        slopes[2][at + ch] += light_of[ch] * (by_y * x_mm - by_x * y_mm);
                    }
                }
        }
}

}  // namespace ghostlight
