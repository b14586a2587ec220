#include "core/flare/planned_ghost.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/flare/ghost_measures.h"
#include "core/flare/ghost_spot.h"
#include "core/flare/ghost_weights.h"
#include "core/flare/grid_light.h"
#include "core/flare/picture_levels.h"

namespace ghostlight {
namespace {

constexpr int finest_cells = 256;
constexpr int most_bands = 24;
/// How a ghost's allowance is shared among what its picture gets wrong.
constexpr double level_share = 0.45, grid_share = 0.2, band_share = 0.2, weight_share = 0.15;
/// Singular cells are split where what they get wrong is more than this share of the allowance.
constexpr double singular_share = 0.1;
/// For OpenGL, in all ghosts that have this many times the light of their allowance.
constexpr double split_above = 5.0;
constexpr int split_cells = 4;  ///< across a singular cell
/// Polarisation is traced anew where interpolating it costs more than this share of what weights
/// may.
constexpr double polarised_share_of_weight = 0.3;
constexpr int most_rough_cells = 96;  ///< for the weights' sake
/// One of so many nodes of a probe is to pass, for fewer of them to be enough.
constexpr std::size_t share_passing = 4;

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

template <int C>
void GhostPlanner::draw_grids(const std::vector<const MirrorGrid*>& geometry,
                              const MirrorGrid& weight_grid, const std::vector<float>& weights,
                              int bands, bool split, const ProbedGhost& ghost,
                              ColorMesh<C>& mesh) const {
    std::vector<MeshNodes> placed;
    for (const MirrorGrid* grid : geometry) placed.push_back(placement_.place(*grid));
    const MirrorGrid& main = geometry.size() == 1 ? *geometry.front() : *geometry[scene_.main];
    const std::vector<int> singular =
        split ? singular_cells(main, placed.size() == 1 ? placed.front() : placed[scene_.main])
              : std::vector<int>{};
    const ColorAxis axis(scene_.samples);
    for (int band = 0; band < bands; ++band) {
        MeshNodes nodes = at_wavelength(placed, axis.wavelength_nm((band + 0.5) / bands));
        interpolate(
            weight_grid,
            ray_light<C>(scene_, weight_grid, weights, channel_shares<C>(scene_, band, bands)), C,
            nodes.cells, nodes.weights);
        if (!singular.empty()) {
            nodes.skipped.assign(idx(nodes.cells * nodes.cells), 0);
            for (const int cell : singular) {
                const int i = cell % nodes.cells, j = cell / nodes.cells;
                nodes.skipped[idx(cell)] = 1;
                nodes.skipped[idx(j * nodes.cells + nodes.cells - 1 - i)] = 1;
            }
        }
        add_grid(nodes, placement_.frame(), mesh);
    }
    if (!singular.empty())
        draw_singular(main, singular, weight_grid,
                      ray_light<C>(scene_, weight_grid, weights, channel_shares<C>(scene_, 0, 1)),
                      ghost, mesh);
}

/// Traces singular cells of the half with u ≥ 0 on grids of their own, with films and polarisation
/// at the main wavelength and the colour of their surroundings.
template <int C>
GhostPlanner::SingularRays GhostPlanner::trace_singular(const MirrorGrid& grid,
                                                        const std::vector<int>& cells,
                                                        const MirrorGrid& weight_grid,
                                                        const std::vector<float>& light,
                                                        const ProbedGhost& ghost) const {
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
    trace(ghost, scene_.main, Weights::polarised, rays);
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
                                 const ProbedGhost& ghost, ColorMesh<C>& mesh) const {
    constexpr int side = split_cells + 1;
    const auto [rays, weights] = trace_singular<C>(grid, cells, weight_grid, light, ghost);
    const double cell_area_mm2 =
        grid.box.area_mm2() / (grid.cells * grid.cells * split_cells * split_cells);
    for (std::size_t n = 0; n < cells.size(); ++n)
        for (const float mirror : {1.0F, -1.0F}) {
            MeshNodes nodes =
                placement_.place(rays, n * side * side, split_cells, cell_area_mm2, mirror);
            const auto first = weights.begin() + static_cast<std::ptrdiff_t>(n * side * side * C);
            nodes.weights.assign(first, first + side * side * C);
            add_grid(nodes, placement_.frame(), mesh);
        }
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
        !economies_.smaller_sizes ||
        saturated(blur_px(1) * first.contrast_mm2 + blur_px2(1) * first.slopes_mm2, flux) >
            level_share * planned.allowance_mm2;
    const double spread =
        full_size ? planned.allowance_mm2 / (1.0 - level_share) : planned.allowance_mm2;
    auto allowed = [&](double share) { return unsaturated(share * spread, flux); };

    Fineness chosen;
    const int probe = ghost.grid.cells;
    // Cells below half a pixel show nothing more. An even number of them, for mirror symmetry.
    const int finest = std::clamp(4 * static_cast<int>(0.5 * std::sqrt(first.area_px2)),
                                  2 * first.cells, finest_cells);
    chosen.cells = std::min(finest, cells_for(first.cells, first.grid_mm2, allowed(grid_share)));
    // Bands overlap by hats, so that what is left of merging falls fourfold on doubling them.
    chosen.bands = std::clamp(
        static_cast<int>(std::ceil(
            std::sqrt(std::min(first.merging_mm2 / std::max(allowed(band_share), 1e-300), 1e6)))),
        1, most_bands);
    if (!economies_.merged_colors)
        chosen.bands = std::min(most_bands, static_cast<int>(scene_.samples.size()));
    // Weights come from the probe where they are smooth, else they are traced on the grid itself;
    // where rays begin to fail or reflect totally, on a grid for each cell.
    const double weight_allowed = weight_share * spread;
    chosen.rough = first.weight_mm2 > weight_allowed || !economies_.probed_light;
    if (chosen.rough)
        chosen.cells = std::max(
            chosen.cells,
            std::min(most_rough_cells, cells_for(probe, first.weight_mm2, weight_allowed)));
    chosen.polarised =
        chosen.rough && ghost.polarised.error * flux > polarised_share_of_weight * weight_allowed;
    auto fallen = [](double error, int from, int to) {
        return error * static_cast<double>(from * from) / (to * to);
    };
    // The cells along the edge grow fewer as they shrink, and a root's error with their size.
    const double shrunk = static_cast<double>(first.cells) / chosen.cells;
    const double singular_mm2 = first.singular_mm2 * shrunk * std::sqrt(shrunk);
    chosen.split = economies_.split_edges && singular_mm2 > singular_share * spread;
    chosen.error_mm2 = saturated(fallen(first.grid_mm2, first.cells, chosen.cells), flux) +
                       saturated(fallen(first.merging_mm2, 1, chosen.bands), flux) +
                       std::min(flux, chosen.rough ? fallen(first.weight_mm2, probe, chosen.cells)
                                                   : first.weight_mm2) +
                       (chosen.split ? 0.0 : std::min(flux, singular_mm2));
    // What a probe of fewer nodes would say of a ghost that few of these pass is worth little.
    if (ghost.passing * share_passing >= idx(probe * probe) && !chosen.split)
        chosen.cells_wanted =
            std::max({first.cells * std::sqrt(first.grid_mm2 / allowed(grid_share)),
                      probe * std::sqrt(first.weight_mm2 / weight_allowed),
                      first.cells * std::pow(singular_mm2 / (singular_share * spread), 2.0 / 3.0)});
    return chosen;
}

void GhostPlanner::choose_level(const Fineness& chosen, double contrast_mm2, double slopes_mm2,
                                PlannedGhost& planned) const {
    const double flux = std::max(planned.flux_mm2, 1e-300);
    const double allowed =
        std::max(planned.allowance_mm2 - chosen.error_mm2, level_share * planned.allowance_mm2);
    auto level_error = [&](int level) {
        return saturated(blur_px(level) * contrast_mm2 + blur_px2(level) * slopes_mm2, flux);
    };
    planned.level = 0;
    while (economies_.smaller_sizes && planned.level + 1 < picture_levels &&
           level_error(planned.level + 1) <= allowed)
        ++planned.level;
    planned.error_mm2 = chosen.error_mm2 + level_error(planned.level);
}

std::size_t GhostPlanner::cells_to_draw(const ProbedGhost& ghost) const {
    if (ghost.planned.fate != GhostFate::drawn) return 0;
    const Fineness chosen = choose(ghost);
    return idx(chosen.cells) * idx(chosen.cells) * idx(chosen.bands);
}

template <int C>
void GhostPlanner::draw(ProbedGhost& ghost, ColorMesh<C>& mesh) const {
    PlannedGhost& planned = ghost.planned;
    const Fineness chosen = choose(ghost);
    const auto [cells, bands, rough, polarised, split, error_mm2, cells_wanted] = chosen;
    planned.cells = cells;
    planned.bands = bands;
    planned.look.cells_wanted = cells_wanted;

    const MirrorGrid& probe = ghost.grid;
    std::vector<MirrorGrid> finer;
    std::vector<const MirrorGrid*> geometry;
    for (std::size_t g = 0; g < scene_.geometry.size(); ++g)
        if (bands > 1 || g == scene_.main) {
            const bool is_probe = g == scene_.main && cells == probe.cells;
            if (!is_probe)
                finer.push_back(
                    traced(ghost, g, cells, rough && g == scene_.main,
                           polarised && g == scene_.main ? Weights::polarised : Weights::none));
        }
    for (const MirrorGrid& grid : finer) planned.rays += grid.half.size() + grid.other.size();
    auto next = finer.begin();
    for (std::size_t g = 0; g < scene_.geometry.size(); ++g)
        if (bands > 1 || g == scene_.main)
            geometry.push_back(g == scene_.main && cells == probe.cells ? &probe : &*next++);
    const MirrorGrid& main = geometry.size() == 1 ? *geometry.front() : *geometry[scene_.main];
    if (rough && cells != probe.cells)
        draw_grids(geometry, main,
                   ghost_weights(scene_, trace_path<float>(scene_.system(), planned.path), main,
                                 ghost.polarised, ghost.colors),
                   bands, split, ghost, mesh);
    else
        draw_grids(geometry, probe, ghost.weights, bands, split, ghost, mesh);
    const double pixel_mm2 = placement_.frame().pixel_area_mm2();
    choose_level(chosen, mesh.edge_contrast * pixel_mm2, mesh.slope_contrast * pixel_mm2, planned);
}

GhostSpot GhostPlanner::spot(const ProbedGhost& ghost) const {
    MeshNodes nodes = placement_.place(ghost.grid);
    interpolate(ghost.grid,
                ray_light<color_channels>(scene_, ghost.grid, ghost.weights,
                                          channel_shares<color_channels>(scene_, 0, 1)),
                color_channels, nodes.cells, nodes.weights);
    return spot_of(nodes, color_channels, placement_.frame());
}

GhostDrawing GhostPlanner::prepare(ProbedGhost& ghost) const {
    PlannedGhost& planned = ghost.planned;
    Fineness chosen = choose(ghost);
    // Margins are interpolated pixel by pixel there: beside failing rays that is worse than what
    // the estimate knows.
    chosen.split = chosen.split || (ghost.errors.singular_mm2 > 0.0 &&
                                    planned.flux_mm2 > split_above * planned.allowance_mm2);
    planned.cells = chosen.cells;
    planned.bands = chosen.bands;
    planned.look.cells_wanted = chosen.cells_wanted;
    choose_level(chosen, ghost.errors.contrast_mm2, ghost.errors.slopes_mm2, planned);

    GhostDrawing drawing;
    const MirrorGrid& probe = ghost.grid;
    const bool own_weights = chosen.rough && planned.cells != probe.cells;
    MirrorGrid fine;
    std::vector<float> fine_weights;
    if (planned.cells != probe.cells && (own_weights || chosen.split)) {
        fine = traced(ghost, scene_.main, planned.cells, own_weights,
                      chosen.polarised ? Weights::polarised : Weights::none);
        planned.rays += fine.half.size() + fine.other.size();
    }
    if (own_weights)
        fine_weights = ghost_weights(scene_, trace_path<float>(scene_.system(), planned.path), fine,
                                     ghost.polarised, ghost.colors);
    const MirrorGrid& weight_grid = own_weights ? fine : probe;
    const std::vector<float>& weights = own_weights ? fine_weights : ghost.weights;
    auto light = [&](int band, int bands) {
        return ray_light<color_channels>(scene_, weight_grid, weights,
                                         channel_shares<color_channels>(scene_, band, bands));
    };
    if (chosen.split) {
        const MirrorGrid& grid = planned.cells == probe.cells ? probe : fine;
        drawing.singular = singular_cells(grid, placement_.place(grid));
        drawing.singular_across = split_cells;
        drawing.singular_light =
            trace_singular<color_channels>(grid, drawing.singular, weight_grid, light(0, 1), ghost)
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

template <int C>
ColorMesh<gray_channels> last_channel(const ColorMesh<C>& mesh) {
    ColorMesh<gray_channels> gray;
    gray.cells = mesh.cells;
    gray.edge_contrast = mesh.edge_contrast;
    gray.slope_contrast = mesh.slope_contrast;
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
