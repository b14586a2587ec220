#include "core/fit/picture_slopes.h"

#include <algorithm>
#include <cmath>

#include "core/fit/bundle_polygon.h"
#include "core/fit/sloped_trace.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// Moves that are differentiated by in one trace.
constexpr int moves_at_once = 8;

/// Slopes of a grid's rays by N moves, at the nodes that something is made of.
template <int N>
struct GridSlopes {
    using Row = std::array<float, N>;
    std::vector<Row> x, y;
    std::vector<std::vector<Row>> clearances;
};

/// A ray that has failed has a root of 0 on its way, whose slope is no number: it moves nothing.
template <int N>
std::array<float, N> row_of(const SlopeJet<N>& jet) {
    std::array<float, N> row;
    for (int k = 0; k < N; ++k)
        row[static_cast<std::size_t>(k)] =
            std::isfinite(jet.v[k]) ? static_cast<float>(jet.v[k]) : 0.0F;
    return row;
}

template <int N>
SlopeJet<N> jet_of(float value, const std::array<float, N>& slopes) {
    SlopeJet<N> jet(static_cast<double>(value));
    for (int k = 0; k < N; ++k) jet.v[k] = static_cast<double>(slopes[static_cast<std::size_t>(k)]);
    return jet;
}

/// The moves of one batch, as one geometry wavelength sees them.
template <int N>
struct Batch {
    std::vector<const LensMove*> moves;
    SlopedBeam<N> beam;
    Batch(const LightDirection& light, const LensMoves& all, std::size_t first)
        : moves(taken(all, first)), beam(light, moves) {}
    static std::vector<const LensMove*> taken(const LensMoves& all, std::size_t first) {
        std::vector<const LensMove*> some;
        for (std::size_t k = first; k < all.moves.size() && k < first + N; ++k)
            some.push_back(&all.moves[k]);
        return some;
    }
    std::vector<SystemSides> at_node(std::size_t node) const {
        std::vector<SystemSides> sides;
        for (const LensMove* move : moves)
            sides.push_back(move->less.empty()
                                ? SystemSides{}
                                : SystemSides{&move->less[node], &move->more[node], move->width});
        return sides;
    }
    std::vector<SystemSides> at_sample(std::size_t k) const {
        std::vector<SystemSides> sides;
        for (const LensMove* move : moves)
            sides.push_back(
                move->film_less.empty()
                    ? SystemSides{}
                    : SystemSides{&move->film_less[k], &move->film_more[k], move->width});
        return sides;
    }
};

/// How far a place of the stop is inside one of its edges, both carried a little to either side.
template <int N>
std::array<float, N> stop_slopes(const OpticalSystem& system, const Batch<N>& batch,
                                 std::size_t node, int edge, const SlopeJet<N>& u,
                                 const SlopeJet<N>& v) {
    std::array<float, N> row{};
    for (std::size_t slot = 0; slot < batch.moves.size(); ++slot) {
        const LensMove& move = *batch.moves[slot];
        const double half = 0.5 * move.width, du = half * u.v[static_cast<int>(slot)],
                     dv = half * v.v[static_cast<int>(slot)];
        const bool stays = move.less.empty();
        const StopMask& less = stays ? system.stop_mask : move.less[node].stop_mask;
        const StopMask& more = stays ? system.stop_mask : move.more[node].stop_mask;
        const double slope = (stop_margin(more, edge, u.a + du - move.stop_more.x_mm,
                                          v.a + dv - move.stop_more.y_mm) -
                              stop_margin(less, edge, u.a - du - move.stop_less.x_mm,
                                          v.a - dv - move.stop_less.y_mm)) /
                             move.width;
        row[slot] = std::isfinite(slope) ? static_cast<float>(slope) : 0.0F;
    }
    return row;
}

/// Traces what the visible cells of a grid stand on.
template <int N>
GridSlopes<N> grid_slopes(const BundleGrid<float>& grid, const std::vector<char>& rim,
                          const std::vector<char>& used, const TracePath<SlopeJet<N>>& path,
                          const OpticalSystem& system, const Batch<N>& batch, std::size_t node) {
    const std::size_t count = grid.field.rays.size();
    GridSlopes<N> slopes;
    slopes.x.resize(count);
    slopes.y.resize(count);
    slopes.clearances.resize(grid.field.clearances.size());
    for (auto& each : slopes.clearances) each.resize(count);
    const int edges = stop_edges(system.stop_mask);
    for (std::size_t i = 0; i < count; ++i) {
        if (!used[i]) continue;
        const SlopedRay<N> ray =
            sloped_ray<N>(path, batch.beam, static_cast<double>(grid.field.rays.u_mm[i]),
                          static_cast<double>(grid.field.rays.v_mm[i]));
        slopes.x[i] = row_of<N>(ray.x_mm);
        slopes.y[i] = row_of<N>(ray.y_mm);
        if (!rim[i]) continue;
        slopes.clearances[0][i] = row_of<N>(ray.margin);
        slopes.clearances[1][i] = row_of<N>(ray.clear);
        std::size_t which = 2;
        for (int k = 0; k < grid.field.rays.stop_crossings; ++k)
            for (int edge = 0; edge < edges; ++edge, ++which)
                slopes.clearances[which][i] = stop_slopes<N>(
                    system, batch, node, edge, ray.stop_u_mm[static_cast<std::size_t>(k)],
                    ray.stop_v_mm[static_cast<std::size_t>(k)]);
    }
    return slopes;
}

/// Rays and clearances of a grid with their slopes.
template <int N>
struct SlopedField {
    const RayField<float>& field;
    const GridSlopes<N>& slopes;
    SlopeJet<N> x(std::size_t node) const {
        return jet_of<N>(field.rays.x_mm[node], slopes.x[node]);
    }
    SlopeJet<N> y(std::size_t node) const {
        return jet_of<N>(field.rays.y_mm[node], slopes.y[node]);
    }
    SlopeJet<N> clearance(std::size_t k, std::size_t node) const {
        return jet_of<N>(field.clearances[k][node], slopes.clearances[k][node]);
    }
};

/// Which nodes of which grid (the base, then its finer parts) are asked for.
struct NodesUsed {
    std::vector<std::vector<char>> used, rim;
    NodesUsed(const SplitGrid<float>& grid, const PixelFrame& frame) {
        auto add = [&](const BundleGrid<float>& each) {
            used.emplace_back(each.field.rays.size(), 0);
            rim.emplace_back(each.field.rays.size(), 0);
        };
        add(grid.base);
        for (const auto& each : grid.splits) add(each);
        for_each_cell(grid, [&](const BundleGrid<float>& on, int cell) {
            const CellKind kind = cell_kind(on, cell);
            if (kind == CellKind::dark) return;
            const auto side = static_cast<std::size_t>(on.cells) + 1;
            const std::size_t a = static_cast<std::size_t>(cell / on.cells) * side +
                                  static_cast<std::size_t>(cell % on.cells);
            SensorBounds bounds;
            for (const std::size_t c : {a, a + 1, a + side, a + side + 1})
                bounds.add(static_cast<double>(on.field.rays.x_mm[c]),
                           static_cast<double>(on.field.rays.y_mm[c]));
            if (kind == CellKind::whole && !bounds.reaches(frame)) return;
            const std::size_t which = index(grid, on);
            for (const std::size_t c : {a, a + 1, a + side, a + side + 1}) {
                used[which][c] = 1;
                if (kind == CellKind::cut) rim[which][c] = 1;
            }
        });
    }
    static std::size_t index(const SplitGrid<float>& grid, const BundleGrid<float>& on) {
        return &on == &grid.base ? 0 : 1 + static_cast<std::size_t>(&on - grid.splits.data());
    }
};

/// Slopes of a basis' coefficients by the moves: [(node, term, channel)][N].
template <int N>
std::vector<std::array<double, N>> coefficient_slopes(const FitScene& scene,
                                                      const GhostBasis& basis, const LensMoves& all,
                                                      const Batch<N>& batch) {
    std::vector<std::array<double, N>> slopes(basis.width() * 3);
    if (batch.moves.empty()) return slopes;
    const std::size_t ray_count = basis.rays.size();
    for (std::size_t k = 0; k < scene.samples.size(); ++k) {
        const auto sides = batch.at_sample(k);
        const auto path = sloped_path<N>(all.film_now[k], scene.ghosts[basis.ghost], sides);
        const double channel[3] = {scene.colors[k].r, scene.colors[k].g, scene.colors[k].b};
        for (std::size_t r = 0; r < ray_count; ++r) {
            const auto& at = basis.grid.ray_places[r];
            const SlopeJet<N> weight = sloped_weight<N>(path, batch.beam, at[0], at[1]);
            for (std::size_t node = 0; node < basis.nodes; ++node) {
                const double share = basis.nodes == 1 ? 1.0 : scene.nodes[k][node];
                for (std::size_t t = 0; t < pupil_terms; ++t)
                    for (std::size_t c = 0; c < 3; ++c) {
                        const double f = share * basis.projection[t * ray_count + r] * channel[c];
                        auto& to = slopes[(node * pupil_terms + t) * 3 + c];
                        for (int s = 0; s < N; ++s)
                            if (std::isfinite(weight.v[s]))
                                to[static_cast<std::size_t>(s)] += f * weight.v[s];
                    }
            }
        }
    }
    return slopes;
}

/// Where a point falls between the samples, and its footprint there.
template <int N>
class Footprint {
   public:
    Footprint(const PixelFrame& frame, const FitPlace& place)
        : frame_(frame),
          place_(place),
          cosine_(std::cos(place.rotation_rad)),
          sine_(std::sin(place.rotation_rad)) {}

    /// `light`: of the point, its area included, by channel.
    void add(const PieceOf<SlopeJet<N>>& point, const std::array<SlopeJet<N>, 3>& light,
             std::size_t first, std::size_t count, ModelPicture& to) const {
        const SlopeJet<N> x_mm = cosine_ * point.x_mm - sine_ * point.y_mm,
                          y_mm = sine_ * point.x_mm + cosine_ * point.y_mm;
        const double x = frame_.column(x_mm.a + place_.shift_x_mm) - 0.5,
                     y = frame_.row(y_mm.a + place_.shift_y_mm) - 0.5;
        const int i0 = static_cast<int>(std::floor(x + 0.5)) - 1,
                  j0 = static_cast<int>(std::floor(y + 0.5)) - 1;
        for (int j = std::max(0, j0); j <= j0 + 2 && j < frame_.height_px; ++j)
            for (int i = std::max(0, i0); i <= i0 + 2 && i < frame_.width_px; ++i) {
                const double wx = spline(x - i), wy = spline(y - j), w = wx * wy;
                const double by_x = spline_slope(x - i) * wy / frame_.pitch_mm,
                             by_y = wx * spline_slope(y - j) / frame_.pitch_mm;
                const auto sample = static_cast<std::size_t>(j * frame_.width_px + i);
                for (std::size_t c = 0; c < 3; ++c) {
                    double* sums = to.at(sample, c);
                    if (first == 0) {
                        sums[0] += light[c].a * by_x;
                        sums[1] += light[c].a * by_y;
                        sums[2] += light[c].a * (by_y * x_mm.a - by_x * y_mm.a);
                    }
                    for (std::size_t k = 0; k < count; ++k) {
                        const int s = static_cast<int>(k);
                        sums[place_slopes + first + k] +=
                            light[c].v[s] * w + light[c].a * (by_x * x_mm.v[s] + by_y * y_mm.v[s]);
                    }
                }
            }
    }

   private:
    const PixelFrame& frame_;
    const FitPlace& place_;
    double cosine_, sine_;
};

template <int N>
void add_batch(const FitScene& scene, const GhostBasis& basis, const LightDirection& light,
               const PixelFrame& frame, const FitPlace& place,
               const std::vector<double>& coefficients, const LensMoves& all, std::size_t first,
               ModelPicture& to) {
    using Jet = SlopeJet<N>;
    const GhostPath& ghost = scene.ghosts[basis.ghost];
    const GhostGrid& on = basis.grid;
    const Batch<N> batch(light, all, first);
    const auto by = coefficient_slopes<N>(scene, basis, all, batch);
    const Footprint<N> footprint(frame, place);
    for (std::size_t n = 0; n < on.nodes.size(); ++n) {
        const std::size_t node = on.nodes[n];
        const OpticalSystem& system = scene.geometry[node];
        const SplitGrid<float> grid = traced_grid(scene, node, ghost, beam_frame(light), on);
        const NodesUsed nodes(grid, frame);
        const auto sides = batch.at_node(node);
        const auto path = sloped_path<N>(system, ghost, sides);
        std::vector<GridSlopes<N>> slopes;
        slopes.push_back(
            grid_slopes<N>(grid.base, nodes.rim[0], nodes.used[0], path, system, batch, node));
        for (std::size_t k = 0; k < grid.splits.size(); ++k)
            slopes.push_back(grid_slopes<N>(grid.splits[k], nodes.rim[k + 1], nodes.used[k + 1],
                                            path, system, batch, node));
        auto take = [&](const PieceOf<Jet>& point) {
            const auto terms = pupil_functions<Jet>(point.u / on.u_half_mm,
                                                    (point.v - on.v_mid_mm) / on.v_half_mm);
            const Jet area = point.area_mm2 / frame.pixel_area_mm2();
            std::array<Jet, 3> shines;
            for (std::size_t c = 0; c < 3; ++c) {
                Jet sum(0.0);
                for (std::size_t t = 0; t < pupil_terms; ++t) {
                    const std::size_t at = (n * pupil_terms + t) * 3 + c;
                    sum += coefficients[at] * terms[t];
                    for (int s = 0; s < N; ++s)
                        sum.v[s] += terms[t].a * by[at][static_cast<std::size_t>(s)];
                }
                shines[c] = area * sum;
            }
            footprint.add(point, shines, first, batch.moves.size(), to);
        };
        for_each_cell(grid, [&](const BundleGrid<float>& cells, int cell) {
            const SlopedField<N> field{cells.field, slopes[NodesUsed::index(grid, cells)]};
            for_each_point<Jet>(cells, field, cell, frame, on.point_spacing, take);
        });
    }
}

}  // namespace

void add_picture_slopes(const FitScene& scene, const GhostBasis& basis, const LightDirection& light,
                        const PixelFrame& frame, const FitPlace& place,
                        const std::vector<double>& coefficients, const LensMoves& moves,
                        ModelPicture& to) {
    if (basis.empty()) return;
    // The light's direction alone is what most fits move: cheaper by itself.
    if (moves.moves.size() <= 1) {
        add_batch<1>(scene, basis, light, frame, place, coefficients, moves, 0, to);
        return;
    }
    for (std::size_t first = 0; first < moves.moves.size(); first += moves_at_once)
        add_batch<moves_at_once>(scene, basis, light, frame, place, coefficients, moves, first, to);
}

ModelPicture picture_slopes(const FitScene& scene, const std::vector<GhostBasis>& bases,
                            const GhostWeights& weights, const LightDirection& light,
                            const PixelFrame& frame, const FitPlace& place, const LensMoves& moves,
                            unsigned threads, std::stop_token stop) {
    // In a fixed order, whatever the number of threads: ghosts in parts, then summed.
    constexpr std::size_t most_parts = 16;
    const std::size_t parts = std::min(most_parts, bases.size());
    ModelPicture sum;
    sum.columns = place_slopes + moves.moves.size();
    sum.values.assign(3 * sum.columns * static_cast<std::size_t>(frame.width_px) *
                          static_cast<std::size_t>(frame.height_px),
                      0.0);
    std::vector<ModelPicture> partial(parts);
    if (!parallel_for(parts, threads, stop,
                      [&](std::size_t part) {
                          partial[part] = sum;
                          std::vector<double> coefficients;
                          for (std::size_t g = part; g < bases.size() && !stop.stop_requested();
                               g += parts) {
                              weights.coefficients(bases[g], coefficients, nullptr);
                              add_picture_slopes(scene, bases[g], light, frame, place, coefficients,
                                                 moves, partial[part]);
                          }
                      }) ||
        stop.stop_requested())
        return {};
    for (const ModelPicture& each : partial)
        for (std::size_t k = 0; k < sum.values.size(); ++k) sum.values[k] += each.values[k];
    return sum;
}

}  // namespace ghostlight
