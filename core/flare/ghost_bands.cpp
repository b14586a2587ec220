// GhostPlanner's drawing of a ghost, band by band of the spectrum.
#include <algorithm>
#include <utility>

#include "core/flare/ghost_measures.h"
#include "core/flare/ghost_weights.h"
#include "core/flare/grid_light.h"
#include "core/flare/planned_ghost.h"

namespace ghostlight {
namespace {

constexpr int split_cells = singular_cells_across;
/// So many bands are narrow enough for polarisation at their middles to stand for all of each.
constexpr int bands_of_one_polarisation = 8;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// Leaves singular cells and their mirror images to grids of their own.
void skip(const std::vector<int>& singular, MeshNodes& nodes) {
    if (singular.empty()) return;
    nodes.skipped.assign(idx(nodes.cells * nodes.cells), 0);
    for (const int cell : singular) {
        const int i = cell % nodes.cells, j = cell / nodes.cells;
        nodes.skipped[idx(cell)] = 1;
        nodes.skipped[idx(j * nodes.cells + nodes.cells - 1 - i)] = 1;
    }
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
GhostPlanner::SingularRays GhostPlanner::trace_singular(const ProbedGhost& ghost, int cells,
                                                        const std::vector<int>& singular,
                                                        const OpticalSystem& system,
                                                        const std::vector<float>& shares) const {
    constexpr int side = split_cells + 1;
    const PupilBox& box = ghost.planned.box;
    const double du = (box.u1_mm - box.u0_mm) / cells, dv = (box.v1_mm - box.v0_mm) / cells;
    SingularRays result;
    Bundle<float>& rays = result.rays;
    for (const int cell : singular)
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) {
                const double u = cell % cells + static_cast<double>(i) / split_cells;
                const double v = cell / cells + static_cast<double>(j) / split_cells;
                rays.u_mm.push_back(static_cast<float>(box.u0_mm + du * u));
                rays.v_mm.push_back(static_cast<float>(box.v0_mm + dv * v));
            }
    rays.keep_cosines = true;
    trace(ghost, system, Weights::polarised, rays);
    result.light =
        bundle_light<C>(scene_, trace_path<float>(system, ghost.planned.path), rays, shares);
    return result;
}
template GhostPlanner::SingularRays GhostPlanner::trace_singular<gray_channels>(
    const ProbedGhost&, int, const std::vector<int>&, const OpticalSystem&,
    const std::vector<float>&) const;
template GhostPlanner::SingularRays GhostPlanner::trace_singular<color_channels>(
    const ProbedGhost&, int, const std::vector<int>&, const OpticalSystem&,
    const std::vector<float>&) const;

/// Draws singular cells and their mirror images.
template <int C>
void GhostPlanner::draw_singular(const ProbedGhost& ghost, int cells,
                                 const std::vector<int>& singular, const OpticalSystem& system,
                                 const std::vector<float>& shares, ColorMesh<C>& mesh) const {
    if (singular.empty()) return;
    constexpr int side = split_cells + 1;
    const auto [rays, light] = trace_singular<C>(ghost, cells, singular, system, shares);
    const double cell_area_mm2 =
        ghost.planned.box.area_mm2() / (cells * cells * split_cells * split_cells);
    for (std::size_t n = 0; n < singular.size(); ++n)
        for (const float mirror : {1.0F, -1.0F}) {
            MeshNodes nodes =
                placement_.place(rays, n * side * side, split_cells, cell_area_mm2, mirror);
            const auto first = light.begin() + static_cast<std::ptrdiff_t>(n * side * side * C);
            nodes.weights.assign(first, first + side * side * C);
            add_grid(nodes, placement_.frame(), mesh);
        }
}

GhostGrids GhostPlanner::lay_grids(ProbedGhost& ghost) const {
    PlannedGhost& planned = ghost.planned;
    GhostGrids grids;
    grids.fineness = choose(ghost);
    const auto& [cells, bands, rough, polarised, split, own_colors, error_mm2, cells_wanted] =
        grids.fineness;
    planned.cells = cells;
    planned.bands = bands;
    planned.look.cells_wanted = cells_wanted;

    const bool is_probe = cells == ghost.grid.cells;
    if (!is_probe) {
        grids.main = traced(ghost, scene_.system(), cells, rough,
                            polarised ? Weights::polarised : Weights::none);
        planned.rays += grids.main.half.size() + grids.main.other.size();
    }
    const MirrorGrid& main = is_probe ? ghost.grid : grids.main;
    if (rough && !is_probe)
        grids.weights = ghost_weights(scene_, trace_path<float>(scene_.system(), planned.path),
                                      main, *planned.look.shares);
    if (own_colors) {
        planned.rays += idx(bands) * main.half.size();
        return grids;
    }
    for (std::size_t g = 0; g < scene_.geometry.size(); ++g) {
        if (g == scene_.main) {
            grids.placed.push_back(placement_.place(main));
        } else if (bands > 1) {
            const MirrorGrid other = traced(ghost, scene_.geometry[g], cells);
            planned.rays += other.half.size() + other.other.size();
            grids.placed.push_back(placement_.place(other));
        }
    }
    if (split)
        grids.singular = singular_cells(
            main, grids.placed.size() == 1 ? grids.placed.front() : grids.placed[scene_.main]);
    return grids;
}

template <int C>
void GhostPlanner::draw_band(const ProbedGhost& ghost, const GhostGrids& grids, int band,
                             ColorMesh<C>& mesh) const {
    const auto& [cells, bands, rough, polarised, split, own_colors, error_mm2, cells_wanted] =
        grids.fineness;
    const std::vector<float> shares = channel_shares<C>(scene_, band, bands);
    MeshNodes nodes;
    if (own_colors) {
        const OpticalSystem& system = scene_.at_band(band, bands);
        // Beside total reflection the main colour's weights are not this one's.
        const bool own_weights = rough && bands >= bands_of_one_polarisation;
        const MirrorGrid grid = traced(ghost, system, cells, own_weights,
                                       own_weights ? Weights::polarised : Weights::none);
        nodes = placement_.place(grid);
        if (own_weights) {
            std::vector<float> own = bundle_light<C>(
                scene_, trace_path<float>(system, ghost.planned.path), grid.half, shares);
            fill_failed(grid, C, own);
            correct_means(grid, C, own);
            interpolate(grid, own, C, cells, nodes.weights);
        }
        if (split) {
            const std::vector<int> singular = singular_cells(grid, nodes);
            skip(singular, nodes);
            draw_singular(ghost, cells, singular, system, shares, mesh);
        }
    } else {
        nodes = at_wavelength(grids.placed,
                              ColorAxis(scene_.samples).wavelength_nm((band + 0.5) / bands));
        skip(grids.singular, nodes);
        draw_singular(ghost, cells, grids.singular, scene_.system(), shares, mesh);
    }
    if (nodes.weights.empty()) {
        const bool own_light = !grids.weights.empty();
        const MirrorGrid& grid = own_light ? grids.main : ghost.grid;
        interpolate(grid,
                    ray_light<C>(scene_, grid, own_light ? grids.weights : ghost.weights, shares),
                    C, nodes.cells, nodes.weights);
    }
    add_grid(nodes, placement_.frame(), mesh);
}

template <int C>
void GhostPlanner::draw(ProbedGhost& ghost, ColorMesh<C>& mesh) const {
    const GhostGrids grids = lay_grids(ghost);
    for (int band = 0; band < grids.fineness.bands; ++band) draw_band(ghost, grids, band, mesh);
    const double pixel_mm2 = placement_.frame().pixel_area_mm2();
    choose_level(grids.fineness, mesh.edge_contrast * pixel_mm2, mesh.slope_contrast * pixel_mm2,
                 ghost.planned);
}

void GhostPlanner::choose_level(const GhostGrids& grids, ProbedGhost& ghost) const {
    choose_level(grids.fineness, ghost.errors.contrast_mm2, ghost.errors.slopes_mm2, ghost.planned);
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

template void GhostPlanner::draw_band(const ProbedGhost&, const GhostGrids&, int,
                                      ColorMesh<gray_channels>&) const;
template void GhostPlanner::draw_band(const ProbedGhost&, const GhostGrids&, int,
                                      ColorMesh<color_channels>&) const;
template void GhostPlanner::draw(ProbedGhost&, ColorMesh<gray_channels>&) const;
template void GhostPlanner::draw(ProbedGhost&, ColorMesh<color_channels>&) const;
template ColorMesh<gray_channels> last_channel(const ColorMesh<gray_channels>&);
template ColorMesh<gray_channels> last_channel(const ColorMesh<color_channels>&);

}  // namespace ghostlight
