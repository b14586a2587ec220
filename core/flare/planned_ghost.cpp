#include "core/flare/planned_ghost.h"

#include <algorithm>
#include <bit>
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
/// Of a ghost's rays, that fail in some colours: fewer have no effect that shows.
constexpr double least_failing_share = 0.01;
/// For OpenGL, in all ghosts that have this many times the light of their allowance.
constexpr double split_above = 5.0;
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

namespace {

/// Cells for which an error that falls fourfold on doubling them comes down to what is allowed.
int cells_for(int cells, double error_mm2, double allowed_mm2) {
    if (error_mm2 <= allowed_mm2) return cells;
    constexpr int most = 1024;
    const double wanted = cells * std::sqrt(error_mm2 / std::max(allowed_mm2, 1e-300));
    return wanted < most ? 4 * static_cast<int>(std::ceil(0.25 * wanted)) : most;
}

}  // namespace

Fineness GhostPlanner::choose(const ProbedGhost& ghost) const {
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
    const double colors_allowed = band_share * spread / flux;
    chosen.bands = economies_.merged_colors
                       ? first.colors.bands_for(colors_allowed, most_bands)
                       : std::min(most_bands, static_cast<int>(scene_.samples.size()));
    // Weights come from the probe where they are smooth, else they are traced on the grid itself;
    // where rays begin to fail or reflect totally, on a grid for each cell.
    const double weight_allowed = weight_share * spread;
    chosen.rough = first.weight_mm2 > weight_allowed || !economies_.probed_light;
    if (chosen.rough)
        chosen.cells = std::max(
            chosen.cells,
            std::min(most_rough_cells, cells_for(probe, first.weight_mm2, weight_allowed)));
    chosen.polarised = chosen.rough && planned.look.shares->polarised.error * flux >
                                           polarised_share_of_weight * weight_allowed;
    auto fallen = [](double error, int from, int to) {
        return error * static_cast<double>(from * from) / (to * to);
    };
    // The cells along the edge grow fewer as they shrink, and a root's error with their size.
    const double shrunk = static_cast<double>(first.cells) / chosen.cells;
    const double singular_mm2 = first.singular_mm2 * shrunk * std::sqrt(shrunk);
    chosen.split = economies_.split_edges && singular_mm2 > singular_share * spread;
    // Where rays fail, and fail by colour, positions cannot be interpolated between the geometry's
    // wavelengths, and what is drawn by cells of its own would not fit the rest.
    chosen.own_colors =
        chosen.bands > 1 && (chosen.split || first.colors.failing_share > least_failing_share);
    if (chosen.own_colors)
        chosen.bands =
            std::min(FlareScene::most_own_bands,
                     static_cast<int>(std::bit_ceil(static_cast<unsigned>(chosen.bands))));
    chosen.error_mm2 = saturated(fallen(first.grid_mm2, first.cells, chosen.cells), flux) +
                       flux * first.colors.error(chosen.bands) +
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
        fine = traced(ghost, scene_.system(), planned.cells, own_weights,
                      chosen.polarised ? Weights::polarised : Weights::none);
        planned.rays += fine.half.size() + fine.other.size();
    }
    if (own_weights)
        fine_weights = ghost_weights(scene_, trace_path<float>(scene_.system(), planned.path), fine,
                                     *planned.look.shares);
    const MirrorGrid& weight_grid = own_weights ? fine : probe;
    const std::vector<float>& weights = own_weights ? fine_weights : ghost.weights;
    auto light = [&](int band, int bands) {
        return ray_light<color_channels>(scene_, weight_grid, weights,
                                         channel_shares<color_channels>(scene_, band, bands));
    };
    if (chosen.split) {
        const MirrorGrid& grid = planned.cells == probe.cells ? probe : fine;
        drawing.singular = singular_cells(grid, placement_.place(grid));
        drawing.singular_across = singular_cells_across;
        drawing.singular_light =
            trace_singular<color_channels>(ghost, planned.cells, drawing.singular, scene_.system(),
                                           channel_shares<color_channels>(scene_, 0, 1))
                .light;
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

}  // namespace ghostlight
