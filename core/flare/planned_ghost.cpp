#include "core/flare/planned_ghost.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/flare/ghost_measures.h"
#include "core/flare/grid_light.h"
#include "core/flare/picture_levels.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// Errors of ghosts cancel in part where they overlap, and the estimates are cautious: what is
/// granted in all, over what is asked.
constexpr double granted_share = 0.5;
constexpr double most_share = 0.5;  ///< of a ghost's own light
constexpr int probe_cells = 12;
constexpr int close_cells = 48;          ///< where hardly a ray of a probe passes
constexpr std::size_t few_passing = 12;  ///< of a probe's nodes
constexpr int finest_cells = 256;
constexpr int most_bands = 24;
/// How a ghost's allowance is shared among what its picture gets wrong.
constexpr double level_share = 0.45, grid_share = 0.2, band_share = 0.2, weight_share = 0.15;
/// Singular cells are split in ghosts that have this many times the light of their allowance.
constexpr double split_above = 5.0;
constexpr int split_cells = 4;        ///< across a singular cell
constexpr int most_rough_cells = 96;  ///< for the weights' sake
/// Of the bend times the contrast: only its part across an edge counts, and most of the contrast
/// is at rims, where chords follow the bend. Calibrated on all bundled lenses, see
/// docs/benchmarks.md.
constexpr double grid_factor = 0.3;
/// Of the shift between the outer geometry wavelengths times the contrast: most of the light lies
/// well within them, and shifts along a rim do not matter. Calibrated likewise.
constexpr double merging_factor = 0.02;

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

}  // namespace

GhostPlanner::GhostPlanner(const FlareScene& scene, const LightDirection& light,
                           const PixelFrame& frame, ProbeSearch search)
    : scene_(scene),
      frame_(frame),
      search_(search),
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
                int edge = 0;
                // Linear along the radius, unlike stop_margin: chords fit a rim better.
                if (stop_mask_.blades == 0)
                    nodes.clearances[1 + idx(s * edges + edge++)][k] =
                        1.0F - std::sqrt(u * u + v * v) * inverse_stop;
                for (; edge < edges; ++edge)
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
    const bool exact = scene_.coating_model == CoatingModel::exact;
    for (std::size_t k = 0; exact && k < rays.size(); ++k) {
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
    GhostProbe probe = probe_ghost(scene_.system(), trace, beam_, entrance_, probe_cells, search_);
    planned.rays = probe.rays;
    if (probe.empty) {
        planned.fate = GhostFate::nothing_passes;
        return result;
    }
    planned.box = probe.grid.box;
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
    MirrorGrid closer;
    if (probe.passing < few_passing) {
        closer = traced(planned, scene_.main, close_cells, Weights::none);
        planned.rays += closer.half.size();
    }
    const MirrorGrid& first = closer.cells > 0 ? closer : grid;
    MeshNodes nodes = place(first);
    interpolate(
        grid,
        light_of<gray_channels>(grid, result.weights, channel_shares<gray_channels>(scene_, 0, 1)),
        1, nodes.cells, nodes.weights);
    const FrameLight light = light_on_frame(nodes, frame_);
    planned.flux_mm2 = light.flux_mm2;
    planned.whole_flux_mm2 = light.whole_flux_mm2;
    if (!light.passes)
        planned.fate = GhostFate::nothing_passes;
    else if (!light.near_frame)
        planned.fate = GhostFate::off_sensor;
    else
        look(first, nodes, result);
    return result;
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
        interpolate(weight_grid,
                    light_of<C>(weight_grid, weights, channel_shares<C>(scene_, band, bands)), C,
                    nodes.cells, nodes.weights);
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
                      light_of<C>(weight_grid, weights, channel_shares<C>(scene_, 0, 1)), planned,
                      mesh);
}

/// Traces singular cells of the half with u ≥ 0 on grids of their own, with films and polarisation
/// at the main wavelength and the colour of their surroundings.
template <int C>
GhostPlanner::SingularRays GhostPlanner::trace_singular(const MirrorGrid& grid,
                                                        const std::vector<int>& cells,
                                                        const MirrorGrid& weight_grid,
                                                        const std::vector<float>& light,
                                                        const PlannedGhost& planned) const {
    constexpr int side = split_cells + 1;
    const double du = (grid.box.u1_mm - grid.box.u0_mm) / grid.cells;
    const double dv = (grid.box.v1_mm - grid.box.v0_mm) / grid.cells;
    SingularRays result;
    Bundle<float>& rays = result.rays;
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
        for (std::size_t k = n * side * side; k < (n + 1) * side * side; ++k)
            for (int c = 0; c < C; ++c) result.weights.push_back(color[c] * rays.weight[k]);
    }
    return result;
}

/// Draws singular cells and their mirror images.
template <int C>
void GhostPlanner::draw_singular(const MirrorGrid& grid, const std::vector<int>& cells,
                                 const MirrorGrid& weight_grid, const std::vector<float>& light,
                                 const PlannedGhost& planned, ColorMesh<C>& mesh) const {
    constexpr int side = split_cells + 1;
    const auto [rays, weights] = trace_singular<C>(grid, cells, weight_grid, light, planned);
    const double cell_area_mm2 =
        grid.box.area_mm2() / (grid.cells * grid.cells * split_cells * split_cells);
    for (std::size_t n = 0; n < cells.size(); ++n)
        for (const float mirror : {1.0F, -1.0F}) {
            MeshNodes nodes = place(rays, split_cells, cell_area_mm2, [&](int a, int b) {
                return std::pair{n * side * side + idx(b * side + a), mirror};
            });
            const auto first = weights.begin() + static_cast<std::ptrdiff_t>(n * side * side * C);
            nodes.weights.assign(first, first + side * side * C);
            add_grid(nodes, frame_, mesh);
        }
}

MirrorGrid GhostPlanner::traced(const PlannedGhost& planned, std::size_t node, int cells,
                                Weights weights) const {
    MirrorGrid grid{planned.box, cells, {}};
    grid.half.keep_cosines = weights != Weights::none;
    trace_mirrored(trace_path<float>(scene_.geometry[node], planned.path), beam_, weights, grid);
    return grid;
}

/// What a plain drawing of the first grid would get wrong.
void GhostPlanner::look(const MirrorGrid& first, const MeshNodes& nodes, ProbedGhost& ghost) const {
    const double pixel_mm2 = frame_.pixel_area_mm2();
    ColorMesh<gray_channels> mesh;
    add_grid(nodes, frame_, mesh);
    const double contrast = mesh.edge_contrast * pixel_mm2;
    FirstErrors& errors = ghost.errors;
    errors.contrast_mm2 = contrast;
    errors.cells = first.cells;
    errors.area_px2 = mesh.area_px2;
    // The error of a bilinear map falls fourfold on doubling the grid.
    errors.grid_mm2 = grid_factor * contrast * bend_px(nodes, frame_);
    if (scene_.geometry.size() > 1)
        errors.merging_mm2 = merging_factor * contrast *
                             shift_px(place(ghost.grids.front()), place(ghost.grids.back()));
    const MirrorGrid& probe = ghost.grids[scene_.main];
    errors.weight_mm2 =
        ghost.planned.flux_mm2 *
        roughness(probe, light_of<gray_channels>(probe, ghost.weights,
                                                 channel_shares<gray_channels>(scene_, 0, 1)));
}

namespace {

/// Cells for which an error that falls fourfold on doubling them comes down to what is allowed.
int cells_for(int cells, double error_mm2, double allowed_mm2) {
    if (error_mm2 <= allowed_mm2) return cells;
    constexpr int most = 1024;
    const double wanted = cells * std::sqrt(error_mm2 / std::max(allowed_mm2, 1e-300));
    return wanted < most ? 4 * static_cast<int>(std::ceil(0.25 * wanted)) : most;
}

}  // namespace

GhostPlanner::Fineness GhostPlanner::choose(const ProbedGhost& ghost) const {
    const PlannedGhost& planned = ghost.planned;
    const FirstErrors& first = ghost.errors;
    const double flux = std::max(planned.flux_mm2, 1e-300);
    // A ghost of full size leaves its share for blurring to the others.
    const bool full_size =
        saturated(blur_px(1) * first.contrast_mm2, flux) > level_share * planned.allowance_mm2;
    const double spread =
        full_size ? planned.allowance_mm2 / (1.0 - level_share) : planned.allowance_mm2;
    auto allowed = [&](double share) { return unsaturated(share * spread, flux); };

    Fineness chosen;
    // Cells below half a pixel show nothing more. An even number of them, for mirror symmetry.
    const int finest = std::clamp(4 * static_cast<int>(0.5 * std::sqrt(first.area_px2)),
                                  2 * first.cells, finest_cells);
    chosen.cells = std::min(finest, cells_for(first.cells, first.grid_mm2, allowed(grid_share)));
    // Bands overlap by hats, so that what is left of merging falls fourfold on doubling them.
    chosen.bands = std::clamp(
        static_cast<int>(std::ceil(
            std::sqrt(std::min(first.merging_mm2 / std::max(allowed(band_share), 1e-300), 1e6)))),
        1, most_bands);
    // Weights come from the probe where they are smooth, else they are traced on the grid itself;
    // where rays begin to fail or reflect totally, on a grid for each cell.
    const double weight_allowed = weight_share * spread;
    chosen.rough = first.weight_mm2 > weight_allowed;
    if (chosen.rough)
        chosen.cells = std::max(
            chosen.cells,
            std::min(most_rough_cells, cells_for(probe_cells, first.weight_mm2, weight_allowed)));
    const MirrorGrid& probe = ghost.grids[scene_.main];
    chosen.split = scene_.coating_model == CoatingModel::exact &&
                   flux > split_above * planned.allowance_mm2 &&
                   !singular_cells(probe, place(probe)).empty();

    auto fallen = [](double error, int from, int to) {
        return error * static_cast<double>(from * from) / (to * to);
    };
    chosen.error_mm2 =
        saturated(fallen(first.grid_mm2, first.cells, chosen.cells), flux) +
        saturated(fallen(first.merging_mm2, 1, chosen.bands), flux) +
        std::min(flux, chosen.rough ? fallen(first.weight_mm2, probe_cells, chosen.cells)
                                    : first.weight_mm2);
    return chosen;
}

void GhostPlanner::choose_level(const Fineness& chosen, double contrast_mm2,
                                PlannedGhost& planned) const {
    const double flux = std::max(planned.flux_mm2, 1e-300);
    const double allowed =
        std::max(planned.allowance_mm2 - chosen.error_mm2, level_share * planned.allowance_mm2);
    auto level_error = [&](int level) { return saturated(blur_px(level) * contrast_mm2, flux); };
    planned.level = 0;
    while (planned.level + 1 < picture_levels && level_error(planned.level + 1) <= allowed)
        ++planned.level;
    planned.error_mm2 = chosen.error_mm2 + level_error(planned.level);
}

template <int C>
void GhostPlanner::draw(ProbedGhost& ghost, ColorMesh<C>& mesh) const {
    PlannedGhost& planned = ghost.planned;
    const Fineness chosen = choose(ghost);
    const auto [cells, bands, rough, split, error_mm2] = chosen;
    planned.cells = cells;
    planned.bands = bands;

    const MirrorGrid& probe = ghost.grids[scene_.main];
    std::vector<MirrorGrid> finer;
    std::vector<const MirrorGrid*> geometry;
    for (std::size_t g = 0; g < scene_.geometry.size(); ++g)
        if (bands > 1 || g == scene_.main) {
            if (cells == probe_cells)
                geometry.push_back(&ghost.grids[g]);
            else
                finer.push_back(
                    traced(planned, g, cells,
                           rough && g == scene_.main ? Weights::polarised : Weights::none));
        }
    for (const MirrorGrid& grid : finer) {
        geometry.push_back(&grid);
        planned.rays += grid.half.size();
    }
    const MirrorGrid& main = geometry.size() == 1 ? *geometry.front() : *geometry[scene_.main];
    if (rough && cells != probe_cells)
        draw_grids(geometry, main, weigh(trace_path<float>(scene_.system(), planned.path), main),
                   bands, split, planned, mesh);
    else
        draw_grids(geometry, probe, ghost.weights, bands, split, planned, mesh);
    choose_level(chosen, mesh.edge_contrast * frame_.pixel_area_mm2(), planned);
}

GhostDrawing GhostPlanner::prepare(ProbedGhost& ghost) const {
    PlannedGhost& planned = ghost.planned;
    const Fineness chosen = choose(ghost);
    planned.cells = chosen.cells;
    planned.bands = chosen.bands;
    choose_level(chosen, ghost.errors.contrast_mm2, planned);

    GhostDrawing drawing;
    const MirrorGrid& probe = ghost.grids[scene_.main];
    const bool own_weights = chosen.rough && planned.cells != probe_cells;
    MirrorGrid fine;
    std::vector<float> fine_weights;
    if (planned.cells != probe_cells && (own_weights || chosen.split)) {
        fine = traced(planned, scene_.main, planned.cells,
                      own_weights ? Weights::polarised : Weights::none);
        planned.rays += fine.half.size();
    }
    if (own_weights) fine_weights = weigh(trace_path<float>(scene_.system(), planned.path), fine);
    const MirrorGrid& weight_grid = own_weights ? fine : probe;
    const std::vector<float>& weights = own_weights ? fine_weights : ghost.weights;
    auto light = [&](int band, int bands) {
        return light_of<color_channels>(weight_grid, weights,
                                        channel_shares<color_channels>(scene_, band, bands));
    };
    if (chosen.split) {
        const MirrorGrid& grid = planned.cells == probe_cells ? probe : fine;
        drawing.singular = singular_cells(grid, place(grid));
        drawing.singular_across = split_cells;
        drawing.singular_light = trace_singular<color_channels>(grid, drawing.singular, weight_grid,
                                                                light(0, 1), planned)
                                     .weights;
    }
    const ColorAxis axis(scene_.samples);
    drawing.light_cells = weight_grid.cells;
    for (int band = 0; band < planned.bands; ++band) {
        const std::vector<float> own = light(band, planned.bands);
        drawing.light.insert(drawing.light.end(), own.begin(), own.end());
        drawing.band_nm.push_back(axis.wavelength_nm((band + 0.5) / planned.bands));
    }
    drawing.planned = planned;
    return drawing;
}

std::optional<std::vector<ProbedGhost>> probe_all(const FlareScene& scene,
                                                  const GhostPlanner& planner,
                                                  const FlareRequest& request,
                                                  std::stop_token stop) {
    const std::vector<GhostPath>& ghosts = request.only.empty() ? scene.ghosts : request.only;
    std::vector<ProbedGhost> probed(ghosts.size());
    const bool finished =
        parallel_for(probed.size(), request.threads, std::move(stop),
                     [&](std::size_t g) { probed[g] = planner.probe(ghosts[g]); });
    if (!finished) return std::nullopt;
    std::vector<ErrorShare> shares;
    double total = 0.0;
    for (const ProbedGhost& ghost : probed) {
        const bool drawn = ghost.planned.fate == GhostFate::drawn;
        shares.push_back({drawn ? ghost.planned.flux_mm2 : 0.0,
                          ghost.errors.grid_mm2 + ghost.errors.merging_mm2});
        total += shares.back().flux_mm2;
    }
    const std::vector<double> allowance =
        share_out(shares, granted_share * request.tolerance * total, most_share);
    for (std::size_t g = 0; g < probed.size(); ++g) probed[g].planned.allowance_mm2 = allowance[g];
    return probed;
}

template <int C>
ColorMesh<gray_channels> last_channel(const ColorMesh<C>& mesh) {
    ColorMesh<gray_channels> gray;
    gray.cells = mesh.cells;
    gray.edge_contrast = mesh.edge_contrast;
    gray.reaches_past_right = mesh.reaches_past_right;
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
