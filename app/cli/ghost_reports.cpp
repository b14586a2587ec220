#include "app/cli/ghost_reports.h"

#include "core/ghosts/ghost_sums.h"
#include "core/ghosts/sensitivity.h"
#include "core/parallel.h"

namespace ghostlight::cli {
namespace {

std::string surface_name(std::size_t surface, std::size_t count) {
    return surface == count ? "sensor" : std::to_string(surface + 1);
}

/// flux_mm2, relative_flux, share, on_sensor_mm2, veiling_fraction, ghosts.
void append(std::vector<Cell>& cells, const GhostSum& sum, const GhostTable& ghosts) {
    const double image = ghosts.direct.flux_mm2, all = sum_of(ghosts).flux_mm2;
    cells.insert(cells.end(), {sum.flux_mm2, image > 0.0 ? Cell(sum.flux_mm2 / image) : Cell(),
                               all > 0.0 ? Cell(sum.flux_mm2 / all) : Cell(), sum.on_sensor_mm2,
                               image > 0.0 ? Cell(sum.on_sensor_mm2 / image) : Cell(),
                               static_cast<std::int64_t>(sum.ghosts)});
}

const std::vector<std::string> sum_columns = {"flux_mm2",      "relative_flux",    "share",
                                              "on_sensor_mm2", "veiling_fraction", "ghosts"};

}  // namespace

Table rows_by_surface(const GhostTable& ghosts, const Prescription& lens) {
    Table table;
    table.columns = {"surface", "element", "media", "coating"};
    table.columns.insert(table.columns.end(), sum_columns.begin(), sum_columns.end());
    const auto elements = elements_of(lens);
    const std::size_t count = lens.surfaces.size();
    for (const SurfaceSum& each : sums_by_surface(ghosts)) {
        const std::string& after =
            each.surface < count ? ghosts.media[each.surface + 1] : ghosts.sensor_medium;
        auto& cells = table.rows.emplace_back();
        cells = {
            surface_name(each.surface, count), elements[each.surface],
            ghosts.media[each.surface] + "|" + after,
            each.surface < count ? Cell(describe(lens.surfaces[each.surface].coating)) : Cell()};
        append(cells, each.sum, ghosts);
    }
    auto& all = table.rows.emplace_back();
    all = {"all", Cell(), Cell(), Cell()};
    append(all, sum_of(ghosts), ghosts);
    return table;
}

Table rows_by_element(const GhostTable& ghosts, const Prescription& lens) {
    Table table;
    table.columns = {"elements", "element_1", "element_2"};
    table.columns.insert(table.columns.end(), sum_columns.begin(), sum_columns.end());
    for (const ElementSum& each : sums_by_element(ghosts, lens)) {
        auto& cells = table.rows.emplace_back();
        cells = {each.first + "-" + each.second, each.first, each.second};
        append(cells, each.sum, ghosts);
    }
    auto& all = table.rows.emplace_back();
    all = {"all", Cell(), Cell()};
    append(all, sum_of(ghosts), ghosts);
    return table;
}

Table rows_of_sensitivities(const GhostTable& ghosts, const GhostState& state) {
    const Prescription& lens = state.loaded.lens;
    const double wavelength_nm = reference_wavelength_nm(state.spectrum);
    const auto parameters = coating_parameters(lens, wavelength_nm);
    std::vector<std::vector<double>> slopes(ghosts.ghosts.size());
    parallel_for(slopes.size(), 0, {}, [&](std::size_t g) {
        if (ghosts.ghosts[g].flux_mm2 > 0.0)
            slopes[g] = flux_sensitivities(lens, state.spectrum, state.light, ghosts.ghosts[g].path,
                                           parameters);
    });
    Table table;
    table.columns = {"ghost",
                     "flux_mm2",
                     "surface",
                     "parameter",
                     "unit",
                     "value",
                     "d_flux_mm2_per_unit",
                     "d_ln_flux_per_unit"};
    for (std::size_t g = 0; g < slopes.size(); ++g) {
        const GhostRow& ghost = ghosts.ghosts[g];
        for (std::size_t k = 0; k < slopes[g].size(); ++k)
            table.rows.push_back({name(ghost.path, lens.surfaces.size()), ghost.flux_mm2,
                                  surface_name(parameters[k].surface, lens.surfaces.size()),
                                  name(parameters[k]), unit(parameters[k]), parameters[k].value,
                                  ghost.flux_mm2 * slopes[g][k], slopes[g][k]});
    }
    return table;
}

}  // namespace ghostlight::cli
