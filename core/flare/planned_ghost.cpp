#include "core/flare/planned_ghost.h"

#include <algorithm>
#include <cmath>

#include "core/flare/picture_levels.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr int probe_cells = 12;
constexpr int close_cells = 48;          ///< where hardly a ray of a probe passes
constexpr std::size_t few_passing = 12;  ///< of a probe's nodes
constexpr int finest_cells = 256;
constexpr int most_bands = 24;
/// How a ghost's allowance is shared among what its picture gets wrong.
constexpr double level_share = 0.5, grid_share = 0.2, band_share = 0.15, weight_share = 0.15;
/// Singular cells are split in ghosts that have this many times the light of their allowance.
constexpr double split_above = 5.0;
constexpr int split_cells = 4;        ///< across a singular cell
constexpr int most_rough_cells = 96;  ///< for the weights' sake
/// Of the bend times the contrast: only its part across an edge counts, and most of the contrast
/// is at rims, where chords follow the bend. Calibrated on all bundled lenses, see
/// docs/benchmarks.md.
constexpr double grid_factor = 0.3;
/// Light beyond the rim that a bend may be measured on, in units of a clearance.
constexpr double near_rim = -0.15;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// What misplacing by some pixels costs at most: all of a ghost's light in the wrong place counts
/// twice, once where it is and once where it should be.
double saturated(double error_mm2, double flux_mm2) {
    const double most = 2.0 * flux_mm2;
    return error_mm2 > 0.0 ? error_mm2 * most / (error_mm2 + most) : 0.0;
}
/// The error before saturation that comes to `allowed` after it.
double unsaturated(double allowed_mm2, double flux_mm2) {
    const double most = 2.0 * flux_mm2;
    return allowed_mm2 < most ? allowed_mm2 * most / (most - allowed_mm2) : 1e300;
}

/// 0 at the longest wavelength of the samples, 1 at the shortest, linear in 1/λ²: lateral colour
/// is nearly linear in it.
struct ColorAxis {
    double low, span;
    explicit ColorAxis(const std::vector<SpectralSample>& samples) {
        const double first = inverse_square(samples.front().wavelength_nm);
        const double last = inverse_square(samples.back().wavelength_nm);
        low = std::min(first, last);
        span = std::abs(last - first);
    }
    static double inverse_square(double nm) { return 1.0 / (nm * nm); }
    double at(double nm) const { return span > 0.0 ? (inverse_square(nm) - low) / span : 0.5; }
    double wavelength_nm(double t) const { return 1.0 / std::sqrt(low + t * span); }
};

/// What a band takes of a sample at `t`: hats about the bands' middles that add up to 1.
double band_weight(double t, int band, int bands) {
    const double at = std::clamp(t * bands - 0.5, 0.0, bands - 1.0);
    return std::max(0.0, 1.0 - std::abs(at - band));
}

/// Failed rays of a half grid take the mean of their valid neighbours, so that rims are not dark.
void fill_failed(const MirrorGrid& grid, int channels, std::vector<float>& values) {
    const int across = grid.half_side(), rows = grid.side();
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < across; ++i) {
            const int k = j * across + i;
            if (grid.half.margin[idx(k)] >= 0.0F) continue;
            int count = 0;
            for (int c = 0; c < channels; ++c) values[idx(k * channels + c)] = 0.0F;
            for (int n = std::max(0, j - 1); n <= std::min(rows - 1, j + 1); ++n)
                for (int m = std::max(0, i - 1); m <= std::min(across - 1, i + 1); ++m) {
                    const int other = n * across + m;
                    if (grid.half.margin[idx(other)] < 0.0F) continue;
                    ++count;
                    for (int c = 0; c < channels; ++c)
                        values[idx(k * channels + c)] += values[idx(other * channels + c)];
                }
            for (int c = 0; c < channels && count > 0; ++c)
                values[idx(k * channels + c)] /= static_cast<float>(count);
        }
}

/// Makes the mean of a cell's corners the mean over the cell, to fourth order: the second
/// differences tell how far the one is above the other.
void correct_means(const MirrorGrid& grid, int channels, std::vector<float>& values) {
    const std::vector<float> given = values;
    const int across = grid.half_side(), rows = grid.side();
    auto at = [&](int i, int j, int c) {
        return given[idx((j * across + std::abs(i)) * channels + c)];
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < across; ++i) {
            const int m = std::min(i, across - 2), n = std::clamp(j, 1, rows - 2);
            for (int c = 0; c < channels; ++c) {
                const float along = at(m - 1, j, c) - 2.0F * at(m, j, c) + at(m + 1, j, c);
                const float up = at(i, n - 1, c) - 2.0F * at(i, n, c) + at(i, n + 1, c);
                const float own = at(i, j, c);
                // Where the correction is large the values are too rough for it.
                values[idx((j * across + i) * channels + c)] =
                    own -
                    std::clamp((along + up) / 12.0F, -0.2F * std::abs(own), 0.2F * std::abs(own));
            }
        }
}

/// Values of a half grid at the nodes of a full grid over the same box, bilinearly.
void interpolate(const MirrorGrid& from, const std::vector<float>& values, int channels, int cells,
                 std::vector<float>& nodes) {
    const int across = from.half_side(), side = cells + 1;
    nodes.resize(idx(side * side * channels));
    for (int j = 0; j < side; ++j) {
        const float y = static_cast<float>(j * from.cells) / static_cast<float>(cells);
        const int j0 = std::min(static_cast<int>(y), from.cells - 1);
        const float fy = y - static_cast<float>(j0);
        for (int i = 0; i < side; ++i) {
            const float x =
                std::abs(static_cast<float>(i * from.cells) / static_cast<float>(cells) -
                         0.5F * static_cast<float>(from.cells));
            const int i0 = std::min(static_cast<int>(x), across - 2);
            const float fx = x - static_cast<float>(i0);
            const float* low = values.data() + (j0 * across + i0) * channels;
            const float* high = low + across * channels;
            float* to = nodes.data() + (j * side + i) * channels;
            for (int c = 0; c < channels; ++c)
                to[c] = std::lerp(std::lerp(low[c], low[channels + c], fx),
                                  std::lerp(high[c], high[channels + c], fx), fy);
        }
    }
}

bool is_within(const MeshNodes& nodes, std::size_t k, double least) {
    return nodes.margin[k] >= 0.0F && std::ranges::all_of(nodes.clearances, [&](const auto& c) {
               return static_cast<double>(c[k]) >= least;
           });
}

/// How far a grid's nodes are from the means of their neighbours, RMS over what passes and lands
/// near the frame: what a grid twice as coarse gets wrong, hence four times what this one does.
double bend_px(const MeshNodes& nodes, const PixelFrame& frame) {
    const int side = nodes.cells + 1;
    const double reach = 0.5 * std::hypot(frame.width_px, frame.height_px);
    double square = 0.0;
    int count = 0;
    auto look = [&](int k, int step) {
        for (const int n : {k - step, k, k + step})
            if (!is_within(nodes, idx(n), near_rim)) return;
        const auto at = [&](const std::vector<float>& values, int n) {
            return static_cast<double>(values[idx(n)]);
        };
        if (std::hypot(at(nodes.column, k) - 0.5 * frame.width_px,
                       at(nodes.row, k) - 0.5 * frame.height_px) > reach)
            return;
        for (const auto* values : {&nodes.column, &nodes.row}) {
            const double off =
                at(*values, k) - 0.5 * (at(*values, k - step) + at(*values, k + step));
            square += off * off;
        }
        ++count;
    };
    for (int j = 0; j < side; ++j)
        for (int i = 1; i < side; i += 2) {
            look(j * side + i, 1);
            look(i * side + j, side);
        }
    return count > 0 ? 0.25 * std::sqrt(square / count) : 0.0;
}

/// The same of a half grid's light, as a share of it.
double roughness(const MirrorGrid& grid, const std::vector<float>& light) {
    const int across = grid.half_side();
    double change = 0.0, sum = 0.0;
    auto look = [&](int k, int step) {
        for (const int n : {k - step, k, k + step})
            if (grid.half.margin[idx(n)] < 0.0F || grid.half.r_rel[idx(n)] > 1.0F) return;
        change += std::abs(static_cast<double>(
            light[idx(k)] - 0.5F * (light[idx(k - step)] + light[idx(k + step)])));
        sum += static_cast<double>(light[idx(k)]);
    };
    for (int j = 0; j < grid.side(); ++j)
        for (int i = 1; i + 1 < across; i += 2) look(j * across + i, 1);
    for (int j = 1; j + 1 < grid.side(); j += 2)
        for (int i = 0; i < across; ++i) look(j * across + i, across);
    return sum > 0.0 ? 0.25 * change / sum : 0.0;
}

/// Cells, of the half with u ≥ 0, beside failing rays or the onset of total reflection, unless
/// something else stops all their light: there map and weight go as a square root.
std::vector<int> singular_cells(const MirrorGrid& grid, const MeshNodes& nodes) {
    std::vector<int> cells;
    const int side = grid.side();
    for (int j = 0; j < grid.cells; ++j)
        for (int i = grid.cells / 2; i < grid.cells; ++i) {
            const std::size_t rays[4] = {grid.of_node(i, j), grid.of_node(i + 1, j),
                                         grid.of_node(i, j + 1), grid.of_node(i + 1, j + 1)};
            auto range = [&](const std::vector<float>& values) {
                float low = values[rays[0]], high = low;
                for (const std::size_t k : rays) {
                    low = std::min(low, values[k]);
                    high = std::max(high, values[k]);
                }
                return std::pair{low, high};
            };
            const auto [low, high] = range(grid.half.margin);
            if (high < 0.0F) continue;
            bool singular = low <= high - low;
            for (const auto& onset : grid.half.onset) {
                const auto [least, most] = range(onset);
                singular = singular || (least <= most - least && most >= least - most);
            }
            if (!singular) continue;
            const bool stopped = std::ranges::any_of(nodes.clearances, [&](const auto& clearance) {
                float least = 1e30F, most = -1e30F;
                for (const int k : {0, 1, side, side + 1}) {
                    const float value = clearance[idx(j * side + i + k)];
                    least = std::min(least, value);
                    most = std::max(most, value);
                }
                return most + 0.5F * (most - least) < 0.0F;
            });
            if (!stopped) cells.push_back(j * grid.cells + i);
        }
    return cells;
}

/// What a probe says of the light that a ghost brings to the frame.
struct FrameLight {
    double flux_mm2 = 0.0;
    bool passes = false, near_frame = false;
};
FrameLight light_on_frame(const MeshNodes& nodes, const PixelFrame& frame) {
    /// A cell about the whole frame has no corner on it.
    constexpr double least_on_frame = 0.1;
    FrameLight light;
    const int side = nodes.cells + 1;
    const auto width = static_cast<float>(frame.width_px);
    const auto height = static_cast<float>(frame.height_px);
    std::vector<char> inside(idx(side * side));
    for (std::size_t k = 0; k < inside.size(); ++k)
        inside[k] = static_cast<char>(is_within(nodes, k, 0.0));
    for (int j = 0; j < nodes.cells; ++j)
        for (int i = 0; i < nodes.cells; ++i) {
            const int a = j * side + i;
            int passing = 0, on_frame = 0;
            float left = 1e30F, right = -1e30F, low = 1e30F, high = -1e30F;
            double weight = 0.0;
            for (const int k : {a, a + 1, a + side, a + side + 1}) {
                passing += inside[idx(k)];
                const float x = nodes.column[idx(k)], y = nodes.row[idx(k)];
                left = std::min(left, x);
                right = std::max(right, x);
                low = std::min(low, y);
                high = std::max(high, y);
                on_frame += x > 0.0F && y > 0.0F && x < width && y < height ? 1 : 0;
                weight += 0.25 * static_cast<double>(nodes.weights[idx(k)]);
            }
            if (passing == 0) continue;
            light.passes = true;
            if (right < 0.0F || high < 0.0F || left > width || low > height) continue;
            light.near_frame = true;
            light.flux_mm2 += weight * 0.25 * passing * nodes.cell_area_mm2 *
                              std::max(0.25 * on_frame, least_on_frame);
        }
    return light;
}

}  // namespace

GhostPlanner::GhostPlanner(const FlareScene& scene, const LightDirection& light,
                           const PixelFrame& frame)
    : scene_(scene),
      frame_(frame),
      beam_(beam_frame({light.field_deg, 90.0})),
      stop_mask_(scene.system().stop_mask),
      entrance_(entrance_box(scene.system(), beam_)) {
    const double turn = rad_from_deg(light.azimuth_deg - 90.0);
    cos_azimuth_ = std::cos(turn);
    sin_azimuth_ = std::sin(turn);
    stop_mask_.rotation_rad -= turn;
}

template <class RayOf>
MeshNodes GhostPlanner::place(const Bundle<float>& rays, int cells, double cell_area_mm2,
                              RayOf ray_of) const {
    MeshNodes nodes;
    nodes.cells = cells;
    nodes.cell_area_mm2 = cell_area_mm2;
    const int side = cells + 1;
    const std::size_t count = idx(side * side);
    nodes.column.resize(count);
    nodes.row.resize(count);
    nodes.margin.resize(count);
    const int edges = stop_edges(stop_mask_);
    nodes.clearances.assign(1 + idx(rays.stop_crossings * edges), std::vector<float>(count));
    const auto pitch = static_cast<float>(1.0 / frame_.pitch_mm);
    const auto xc = static_cast<float>(cos_azimuth_) * pitch;
    const auto xs = static_cast<float>(sin_azimuth_) * pitch;
    const auto left = static_cast<float>(-frame_.left_mm) * pitch;
    const auto bottom = static_cast<float>(-frame_.bottom_mm) * pitch;
    const auto inverse_stop = static_cast<float>(1.0 / stop_mask_.semi_diameter_mm);
    std::size_t k = 0;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i, ++k) {
            const auto [of, mirror] = ray_of(i, j);
            const float x = mirror * rays.x_mm[of], y = rays.y_mm[of];
            nodes.column[k] = xc * x - xs * y + left;
            nodes.row[k] = xs * x + xc * y + bottom;
            nodes.margin[k] = rays.margin[of];
            nodes.clearances[0][k] = 1.0F - rays.r_rel[of];
            for (int s = 0; s < rays.stop_crossings; ++s) {
                const float u = mirror * rays.stop_u_mm[idx(s)][of];
                const float v = rays.stop_v_mm[idx(s)][of];
                // Linear along the radius, unlike stop_margin: chords fit a rim better.
                if (stop_mask_.blades == 0) {
                    nodes.clearances[1 + idx(s)][k] =
                        1.0F - std::sqrt(u * u + v * v) * inverse_stop;
                    continue;
                }
                for (int edge = 0; edge < edges; ++edge)
                    nodes.clearances[1 + idx(s * edges + edge)][k] = static_cast<float>(stop_margin(
                        stop_mask_, edge, static_cast<double>(u), static_cast<double>(v)));
            }
        }
    for (auto& clearance : nodes.clearances) correct_curvature(cells, clearance);
    return nodes;
}

MeshNodes GhostPlanner::place(const MirrorGrid& grid) const {
    return place(grid.half, grid.cells, grid.box.area_mm2() / (grid.cells * grid.cells),
                 [&](int i, int j) {
                     return std::pair{grid.of_node(i, j), grid.is_mirrored(i) ? -1.0F : 1.0F};
                 });
}

MeshNodes GhostPlanner::at_wavelength(const std::vector<MeshNodes>& placed,
                                      double wavelength_nm) const {
    if (placed.size() == 1) return placed.front();
    std::vector<float> shares;
    for (const double share : scene_.interpolation(wavelength_nm))
        shares.push_back(static_cast<float>(share));
    MeshNodes nodes = placed[scene_.main];
    // Where a colour fails nothing can be interpolated: the main one stands for it.
    std::vector<char> valid(nodes.margin.size(), 1);
    for (const MeshNodes& at : placed)
        for (std::size_t k = 0; k < valid.size(); ++k)
            if (at.margin[k] < 0.0F) valid[k] = 0;
    auto mix = [&](std::vector<float>& to, auto&& values_of) {
        for (std::size_t k = 0; k < to.size(); ++k) {
            if (!valid[k]) continue;
            float sum = 0.0F;
            for (std::size_t g = 0; g < placed.size(); ++g)
                sum += shares[g] * values_of(placed[g])[k];
            to[k] = sum;
        }
    };
    mix(
        nodes.column, [](const MeshNodes& at) -> auto& { return at.column; });
    mix(
        nodes.row, [](const MeshNodes& at) -> auto& { return at.row; });
    for (std::size_t c = 0; c < nodes.clearances.size(); ++c)
        mix(
            nodes.clearances[c], [c](const MeshNodes& at) -> auto& { return at.clearances[c]; });
    return nodes;
}

std::vector<float> GhostPlanner::weigh(const TracePath<float>& trace,
                                       const MirrorGrid& grid) const {
    std::vector<float> weights;
    scene_.films.weights(trace, grid.half, weights);
    // Polarisation: its effect on the whole path, at one wavelength, ray by ray.
    const Bundle<float>& rays = grid.half;
    const std::size_t stride = scene_.films.stride();
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const float average = rays.weight_average[k];
        const float ratio = average > 0.0F ? rays.weight[k] / average : 0.0F;
        for (std::size_t w = 0; w < stride; ++w) weights[k * stride + w] *= ratio;
    }
    fill_failed(grid, static_cast<int>(stride), weights);
    return weights;
}

ProbedGhost GhostPlanner::probe(const GhostPath& path) const {
    ProbedGhost result;
    PlannedGhost& planned = result.planned;
    planned.path = path;
    const auto trace = trace_path<float>(scene_.system(), path);
    GhostProbe probe = probe_ghost(scene_.system(), trace, beam_, entrance_, probe_cells);
    planned.rays = probe.rays;
    if (probe.empty) {
        planned.fate = GhostFate::nothing_passes;
        return result;
    }
    planned.box = probe.grid.box;
    planned.cells = probe_cells;
    result.weights = weigh(trace, probe.grid);
    for (std::size_t g = 0; g < scene_.geometry.size(); ++g) {
        if (g == scene_.main) {
            result.grids.push_back(std::move(probe.grid));
            continue;
        }
        MirrorGrid& grid = result.grids.emplace_back();
        grid.box = planned.box;
        grid.cells = probe_cells;
        trace_mirrored(trace_path<float>(scene_.geometry[g], path), beam_, Weights::none, grid);
        planned.rays += grid.half.size();
    }

    const MirrorGrid& grid = result.grids[scene_.main];
    MeshNodes nodes;
    if (probe.passing < few_passing) {
        planned.cells = close_cells;
        MirrorGrid closer{planned.box, close_cells, {}};
        trace_mirrored(trace, beam_, Weights::none, closer);
        planned.rays += closer.half.size();
        nodes = place(closer);
    } else {
        nodes = place(grid);
    }
    interpolate(grid,
                light_of<gray_channels>(grid, result.weights, channel_shares<gray_channels>(0, 1)),
                1, nodes.cells, nodes.weights);
    const FrameLight light = light_on_frame(nodes, frame_);
    planned.flux_mm2 = light.flux_mm2;
    if (!light.passes)
        planned.fate = GhostFate::nothing_passes;
    else if (!light.near_frame)
        planned.fate = GhostFate::off_sensor;
    return result;
}

/// What each spectral sample gives to each channel of a band.
template <int C>
std::vector<float> GhostPlanner::channel_shares(int band, int bands) const {
    const ColorAxis axis(scene_.samples);
    std::vector<float> shares;
    for (std::size_t w = 0; w < scene_.samples.size(); ++w) {
        const SpectralSample& s = scene_.samples[w];
        const double weight = s.weight * band_weight(axis.at(s.wavelength_nm), band, bands);
        const double color[4] = {scene_.colors[w].r, scene_.colors[w].g, scene_.colors[w].b, 1.0};
        for (int c = 0; c < C; ++c)
            shares.push_back(static_cast<float>(weight * color[C == 1 ? 3 : c]));
    }
    return shares;
}

/// Light per E0 in each channel, ray by ray of a half grid, made ready for interpolation.
template <int C>
std::vector<float> GhostPlanner::light_of(const MirrorGrid& grid, const std::vector<float>& weights,
                                          const std::vector<float>& shares) const {
    const std::size_t stride = scene_.films.stride();
    std::vector<float> light(grid.half.size() * C, 0.0F);
    for (std::size_t k = 0; k < grid.half.size(); ++k)
        for (std::size_t w = 0; w < scene_.samples.size(); ++w) {
            const float value = weights[k * stride + w];
            for (std::size_t c = 0; c < C; ++c) light[k * C + c] += shares[w * C + c] * value;
        }
    correct_means(grid, C, light);
    return light;
}

template <int C>
void GhostPlanner::draw_grids(const std::vector<const MirrorGrid*>& geometry,
                              const MirrorGrid& weight_grid, const std::vector<float>& weights,
                              int bands, bool split, const PlannedGhost& planned,
                              ColorMesh<C>& mesh) const {
    std::vector<MeshNodes> placed;
    for (const MirrorGrid* grid : geometry) placed.push_back(place(*grid));
    const MirrorGrid& main = geometry.size() == 1 ? *geometry.front() : *geometry[scene_.main];
    const std::vector<int> singular =
        split ? singular_cells(main, placed.size() == 1 ? placed.front() : placed[scene_.main])
              : std::vector<int>{};
    const ColorAxis axis(scene_.samples);
    for (int band = 0; band < bands; ++band) {
        MeshNodes nodes = at_wavelength(placed, axis.wavelength_nm((band + 0.5) / bands));
        interpolate(weight_grid, light_of<C>(weight_grid, weights, channel_shares<C>(band, bands)),
                    C, nodes.cells, nodes.weights);
        if (!singular.empty()) {
            nodes.skipped.assign(idx(nodes.cells * nodes.cells), 0);
            for (const int cell : singular) {
                const int i = cell % nodes.cells, j = cell / nodes.cells;
                nodes.skipped[idx(cell)] = 1;
                nodes.skipped[idx(j * nodes.cells + nodes.cells - 1 - i)] = 1;
            }
        }
        add_grid(nodes, frame_, mesh);
    }
    if (!singular.empty())
        draw_singular(main, singular, weight_grid,
                      light_of<C>(weight_grid, weights, channel_shares<C>(0, 1)), planned, mesh);
}

/// Traces singular cells of the half with u ≥ 0 on grids of their own, with films and polarisation
/// at the main wavelength and the colour of their surroundings; draws them and their mirror images.
template <int C>
void GhostPlanner::draw_singular(const MirrorGrid& grid, const std::vector<int>& cells,
                                 const MirrorGrid& weight_grid, const std::vector<float>& light,
                                 const PlannedGhost& planned, ColorMesh<C>& mesh) const {
    constexpr int side = split_cells + 1;
    const double du = (grid.box.u1_mm - grid.box.u0_mm) / grid.cells;
    const double dv = (grid.box.v1_mm - grid.box.v0_mm) / grid.cells;
    Bundle<float> rays;
    for (const int cell : cells)
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) {
                const double u = cell % grid.cells + static_cast<double>(i) / split_cells;
                const double v = cell / grid.cells + static_cast<double>(j) / split_cells;
                rays.u_mm.push_back(static_cast<float>(grid.box.u0_mm + du * u));
                rays.v_mm.push_back(static_cast<float>(grid.box.v0_mm + dv * v));
            }
    trace_bundle(trace_path<float>(scene_.system(), planned.path), beam_, Weights::polarised, rays);
    std::vector<float> around;
    interpolate(weight_grid, light, C, grid.cells, around);
    for (std::size_t n = 0; n < cells.size(); ++n) {
        const int i = cells[n] % grid.cells, j = cells[n] / grid.cells;
        float color[C] = {};
        for (const int corner : {0, 1, grid.side(), grid.side() + 1})
            for (int c = 0; c < C; ++c)
                color[c] += around[idx((j * grid.side() + i + corner) * C + c)];
        for (int c = 0; c < C; ++c) color[c] = color[C - 1] > 0.0F ? color[c] / color[C - 1] : 1.0F;
        color[C - 1] = 1.0F;
        for (const float mirror : {1.0F, -1.0F}) {
            MeshNodes nodes =
                place(rays, split_cells, du * dv / (split_cells * split_cells), [&](int a, int b) {
                    return std::pair{n * side * side + idx(b * side + a), mirror};
                });
            nodes.weights.resize(idx(side * side * C));
            for (std::size_t k = 0; k < idx(side * side); ++k)
                for (std::size_t c = 0; c < C; ++c)
                    nodes.weights[k * C + c] = color[c] * rays.weight[n * side * side + k];
            add_grid(nodes, frame_, mesh);
        }
    }
}

template <int C>
void GhostPlanner::draw(ProbedGhost& ghost, ColorMesh<C>& mesh) const {
    PlannedGhost& planned = ghost.planned;
    const double pixel_mm2 = frame_.pixel_area_mm2();
    const double flux = std::max(planned.flux_mm2, 1e-300);
    const MirrorGrid& probe = ghost.grids[scene_.main];
    auto trace_grid = [&](std::size_t node, int cells, Weights weights) {
        MirrorGrid grid{planned.box, cells, {}};
        grid.half.keep_cosines = weights != Weights::none;
        trace_mirrored(trace_path<float>(scene_.geometry[node], planned.path), beam_, weights,
                       grid);
        planned.rays += grid.half.size();
        return grid;
    };
    MirrorGrid closer;
    if (planned.cells != probe_cells)
        closer = trace_grid(scene_.main, planned.cells, Weights::none);
    const MirrorGrid& first = planned.cells == probe_cells ? probe : closer;
    draw_grids({&first}, probe, ghost.weights, 1, false, planned, mesh);

    // The grid: the error of a bilinear map falls fourfold on doubling it.
    const MeshNodes first_nodes = place(first);
    const double contrast = mesh.edge_contrast * pixel_mm2;
    double grid_error = grid_factor * contrast * bend_px(first_nodes, frame_);
    const double grid_allowed =
        std::max(unsaturated(grid_share * planned.allowance_mm2, flux), 1e-300);
    int cells = planned.cells;
    if (grid_error > grid_allowed)
        cells = std::min(finest_cells,
                         4 * static_cast<int>(std::ceil(0.25 * planned.cells *
                                                        std::sqrt(grid_error / grid_allowed))));

    // The bands: what is left of the shift of colours. Light is spread over about the shift between
    // the outer nodes, and lands a quarter of a band's share of it from where it should on average.
    const double shift_px = scene_.geometry.size() > 1 ? color_shift_px(ghost) : 0.0;
    const double band_error = 0.25 * shift_px * contrast;
    const double band_allowed =
        std::max(unsaturated(band_share * planned.allowance_mm2, flux), 1e-300);
    const int bands =
        std::clamp(static_cast<int>(std::ceil(band_error / band_allowed)), 1, most_bands);

    // The weights: from the probe where they are smooth, else traced on the grid itself; where rays
    // begin to fail or reflect totally, on a grid for each cell.
    const double weight_allowed = weight_share * planned.allowance_mm2;
    double weight_error =
        flux * roughness(probe, light_of<gray_channels>(probe, ghost.weights,
                                                        channel_shares<gray_channels>(0, 1)));
    const bool rough = weight_error > weight_allowed;
    if (rough)
        cells = std::max(
            cells,
            std::min(most_rough_cells,
                     4 * static_cast<int>(std::ceil(0.25 * probe_cells *
                                                    std::sqrt(weight_error / weight_allowed)))));
    const bool split =
        flux > split_above * planned.allowance_mm2 && !singular_cells(probe, place(probe)).empty();

    if (cells != planned.cells || bands > 1 || rough || split) {
        const double finer = static_cast<double>(planned.cells) / cells;
        grid_error *= finer * finer;
        if (rough) weight_error *= static_cast<double>(probe_cells * probe_cells) / (cells * cells);
        planned.cells = cells;
        planned.bands = bands;
        MirrorGrid main =
            trace_grid(scene_.main, cells, rough ? Weights::polarised : Weights::none);
        std::vector<MirrorGrid> others;
        if (bands > 1)
            for (std::size_t g = 0; g < scene_.geometry.size(); ++g)
                if (g != scene_.main) others.push_back(trace_grid(g, cells, Weights::none));
        std::vector<const MirrorGrid*> geometry{&main};
        if (bands > 1) {
            geometry.clear();
            for (const MirrorGrid& grid : others) geometry.push_back(&grid);
            geometry.insert(geometry.begin() + static_cast<std::ptrdiff_t>(scene_.main), &main);
        }
        mesh.clear();
        if (rough)
            draw_grids(geometry, main,
                       weigh(trace_path<float>(scene_.system(), planned.path), main), bands, split,
                       planned, mesh);
        else
            draw_grids(geometry, probe, ghost.weights, bands, split, planned, mesh);
    }

    const double so_far = saturated(grid_error, flux) + saturated(band_error / bands, flux) +
                          std::min(weight_error, flux);
    const double level_allowed =
        std::max(planned.allowance_mm2 - so_far, level_share * planned.allowance_mm2);
    const double final_contrast = mesh.edge_contrast * pixel_mm2;
    auto level_error = [&](int level) { return saturated(blur_px(level) * final_contrast, flux); };
    planned.level = 0;
    while (planned.level + 1 < picture_levels && level_error(planned.level + 1) <= level_allowed)
        ++planned.level;
    planned.error_mm2 = so_far + level_error(planned.level);
}

/// RMS distance on the sensor between the outer geometry wavelengths.
double GhostPlanner::color_shift_px(const ProbedGhost& ghost) const {
    const MeshNodes first = place(ghost.grids.front()), last = place(ghost.grids.back());
    double square = 0.0;
    int count = 0;
    for (std::size_t k = 0; k < first.column.size(); ++k) {
        if (first.margin[k] < 0.0F || last.margin[k] < 0.0F) continue;
        if (std::ranges::any_of(first.clearances, [&](const auto& c) {
                return static_cast<double>(c[k]) < near_rim;
            }))
            continue;
        const auto dx = static_cast<double>(first.column[k] - last.column[k]);
        const auto dy = static_cast<double>(first.row[k] - last.row[k]);
        square += dx * dx + dy * dy;
        ++count;
    }
    return count > 0 ? std::sqrt(square / count) : 0.0;
}

template <int C>
ColorMesh<gray_channels> last_channel(const ColorMesh<C>& mesh) {
    ColorMesh<gray_channels> gray;
    gray.cells = mesh.cells;
    gray.edge_contrast = mesh.edge_contrast;
    gray.flux_mm2[0] = mesh.flux_mm2[C - 1];
    for (const ColorEdge<C>& e : mesh.edges)
        gray.edges.push_back({e.x0, e.y0, e.x1, e.y1, {e.e[C - 1]}, {e.gx[C - 1]}, {e.gy[C - 1]}});
    for (const ColorPoint<C>& p : mesh.points) gray.points.push_back({p.x, p.y, {p.flux[C - 1]}});
    return gray;
}

template void GhostPlanner::draw(ProbedGhost&, ColorMesh<gray_channels>&) const;
template void GhostPlanner::draw(ProbedGhost&, ColorMesh<color_channels>&) const;
template ColorMesh<gray_channels> last_channel(const ColorMesh<gray_channels>&);
template ColorMesh<gray_channels> last_channel(const ColorMesh<color_channels>&);

}  // namespace ghostlight
