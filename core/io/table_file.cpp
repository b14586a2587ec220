#include "core/io/table_file.h"

namespace ghostlight {
namespace {

// A surface's number, counted from 1.
Cell surface_number(const GhostPath& path, std::size_t reflection) {
    if (reflection >= path.reflections.size()) return {};
    return static_cast<std::int64_t>(path.reflections[reflection] + 1);
}

std::vector<Cell> cells(const GhostRow& row, bool has_image) {
    // The direct path reflects nowhere, so these do not exist there.
    const bool direct = row.path.is_direct();
    return {name(row.path),
            surface_number(row.path, 0),
            surface_number(row.path, 1),
            row.flux_mm2,
            row.flux_error_mm2,
            has_image ? Cell(row.relative_flux) : Cell(),
            row.peak_per_e0,
            row.centroid_x_mm,
            row.centroid_y_mm,
            row.rms_radius_mm,
            row.on_sensor,
            direct ? Cell() : Cell(row.reflectance_1),
            direct ? Cell() : Cell(row.reflectance_2),
            static_cast<std::int64_t>(row.rays)};
}

}  // namespace

Table ghost_rows(const GhostTable& table) {
    Table rows;
    rows.columns = {"ghost",          "surface_1",     "surface_2",   "flux_mm2",
                    "flux_error_mm2", "relative_flux", "peak_per_e0", "centroid_x_mm",
                    "centroid_y_mm",  "rms_radius_mm", "on_sensor",   "reflectance_1",
                    "reflectance_2",  "rays"};
    // Outside the lens's field there is no image to relate a ghost to.
    const bool has_image = table.direct.flux_mm2 > 0.0;
    rows.rows.push_back(cells(table.direct, has_image));
    for (const GhostRow& ghost : table.ghosts) rows.rows.push_back(cells(ghost, has_image));
    return rows;
}

std::string ghost_table_csv(const GhostTable& table) { return table_csv(ghost_rows(table)); }

std::string ghost_table_json(const GhostTable& table) {
    return table_json(ghost_rows(table)) + "\n";
}

}  // namespace ghostlight
