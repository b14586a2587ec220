#include "core/io/table_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace ghostlight {
namespace {

struct Column {
    std::string name;
    std::function<Cell(const GhostRow&)> cell;
};

/// A column of something that exists at a reflection, counted from 0, of paths that have it.
Column at_turn(std::string name, std::size_t turn,
               const std::function<Cell(const GhostRow&, std::size_t)>& cell) {
    return {std::move(name), [turn, cell](const GhostRow& row) {
                return turn < row.path.reflections.size() ? cell(row, turn) : Cell();
            }};
}

Column surface(std::size_t turn) {
    return at_turn(fmt::format("surface_{}", turn + 1), turn,
                   [](const GhostRow& row, std::size_t k) -> Cell {
                       return static_cast<std::int64_t>(row.path.reflections[k] + 1);
                   });
}

Column reflectance(std::size_t turn) {
    return at_turn(
        fmt::format("reflectance_{}", turn + 1), turn,
        [](const GhostRow& row, std::size_t k) -> Cell { return row.turns[k].reflectance; });
}

std::vector<Column> basic_columns(const GhostTable& table) {
    // Outside the lens's field there is no image to relate a ghost to.
    const bool has_image = table.direct.flux_mm2 > 0.0;
    return {
        {"ghost", [&table](const GhostRow& r) { return name(r.path, table.surface_count); }},
        surface(0),
        surface(1),
        {"flux_mm2", [](const GhostRow& r) { return r.flux_mm2; }},
        {"flux_error_mm2", [](const GhostRow& r) { return r.flux_error_mm2; }},
        {"relative_flux",
         [has_image](const GhostRow& r) { return has_image ? Cell(r.relative_flux) : Cell(); }},
        {"peak_per_e0", [](const GhostRow& r) { return r.peak_per_e0; }},
        {"centroid_x_mm", [](const GhostRow& r) { return r.centroid_x_mm; }},
        {"centroid_y_mm", [](const GhostRow& r) { return r.centroid_y_mm; }},
        {"rms_radius_mm", [](const GhostRow& r) { return r.rms_radius_mm; }},
        {"on_sensor", [](const GhostRow& r) { return r.on_sensor; }},
        reflectance(0),
        reflectance(1),
        {"rays", [](const GhostRow& r) { return static_cast<std::int64_t>(r.rays); }},
    };
}

/// The media on either side of a reflection, first the one the light comes from.
std::string media_at(const GhostTable& table, const GhostRow& row, std::size_t turn) {
    const std::size_t surface = row.path.reflections[turn];
    if (surface >= table.media.size()) return {};
    const std::string& before = table.media[surface];
    const std::string& after =
        surface + 1 < table.media.size() ? table.media[surface + 1] : table.sensor_medium;
    return turn % 2 == 0 ? before + "|" + after : after + "|" + before;
}

void append_turns(std::vector<Column>& columns, const GhostTable& table) {
    std::size_t most = 2;
    for (const GhostRow& row : table.ghosts) most = std::max(most, row.path.reflections.size());
    columns.push_back({"reflections", [](const GhostRow& r) {
                           return static_cast<std::int64_t>(r.path.reflections.size());
                       }});
    for (std::size_t k = 2; k < most; ++k) columns.push_back(surface(k));
    for (std::size_t k = 2; k < most; ++k) columns.push_back(reflectance(k));
    for (std::size_t k = 0; k < most; ++k)
        columns.push_back(at_turn(fmt::format("media_{}", k + 1), k,
                                  [&table](const GhostRow& row, std::size_t turn) -> Cell {
                                      return media_at(table, row, turn);
                                  }));
    for (std::size_t k = 0; k < most; ++k)
        columns.push_back(at_turn(fmt::format("incidence_{}_deg", k + 1), k,
                                  [](const GhostRow& row, std::size_t turn) -> Cell {
                                      return row.turns[turn].incidence_deg;
                                  }));
    for (std::size_t k = 0; k < most; ++k)
        columns.push_back(at_turn(fmt::format("largest_incidence_{}_deg", k + 1), k,
                                  [](const GhostRow& row, std::size_t turn) -> Cell {
                                      return row.turns[turn].largest_incidence_deg;
                                  }));
}

Column edge(std::string name, double SensorBox::*side) {
    return {std::move(name),
            [side](const GhostRow& r) { return r.box.empty() ? Cell() : Cell(r.box.*side); }};
}

Column first_order(std::string name, double ParaxialGhost::*quantity) {
    return {std::move(name), [quantity](const GhostRow& r) { return r.paraxial.*quantity; }};
}

Column matrix(std::string name, double RayMatrix::*entry) {
    return {std::move(name), [entry](const GhostRow& r) { return r.paraxial.to_sensor.*entry; }};
}

void append_details(std::vector<Column>& columns, const GhostTable& table) {
    const std::vector<Column> more = {
        {"area_mm2", [](const GhostRow& r) { return r.area_mm2; }},
        {"pupil_area_mm2", [](const GhostRow& r) { return r.pupil_area_mm2; }},
        edge("x_min_mm", &SensorBox::x0_mm),
        edge("x_max_mm", &SensorBox::x1_mm),
        edge("y_min_mm", &SensorBox::y0_mm),
        edge("y_max_mm", &SensorBox::y1_mm),
        {"peak_per_sun_image",
         [&table](const GhostRow& r) { return r.peak_per_e0 / table.sun_image_per_e0; }},
        {"vignetting", [](const GhostRow& r) { return r.vignetting; }},
        {"cie_x", [](const GhostRow& r) { return r.color ? Cell(r.color->cie_x) : Cell(); }},
        {"cie_y", [](const GhostRow& r) { return r.color ? Cell(r.color->cie_y) : Cell(); }},
        {"srgb", [](const GhostRow& r) { return r.color ? Cell(r.color->srgb) : Cell(); }},
        {"converged", [](const GhostRow& r) { return r.converged ? "yes" : "no"; }},
        first_order("ghost_pupil_from_sensor_mm", &ParaxialGhost::pupil_from_sensor_mm),
        first_order("ghost_pupil_radius_mm", &ParaxialGhost::pupil_radius_mm),
        matrix("a", &RayMatrix::a),
        matrix("b", &RayMatrix::b),
        matrix("c", &RayMatrix::c),
        matrix("d", &RayMatrix::d),
        first_order("focus_from_sensor_mm", &ParaxialGhost::focus_from_sensor_mm),
        first_order("magnification", &ParaxialGhost::magnification),
        first_order("paraxial_diameter_mm", &ParaxialGhost::diameter_mm),
        first_order("fresnel_number", &ParaxialGhost::fresnel_number),
        {"stop_crossings",
         [](const GhostRow& r) { return static_cast<std::int64_t>(r.paraxial.stop_crossings); }},
    };
    columns.insert(columns.end(), more.begin(), more.end());
}

}  // namespace

Table ghost_rows(const GhostTable& table, GhostColumns which) {
    std::vector<Column> columns = basic_columns(table);
    if (which == GhostColumns::all) {
        append_turns(columns, table);
        append_details(columns, table);
    }
    Table rows;
    for (const Column& column : columns) rows.columns.push_back(column.name);
    auto add = [&](const GhostRow& row) {
        std::vector<Cell>& cells = rows.rows.emplace_back();
        for (const Column& column : columns) cells.push_back(column.cell(row));
    };
    add(table.direct);
    for (const GhostRow& ghost : table.ghosts) add(ghost);
    if (table.not_traced.count > 0) {
        std::vector<Cell>& cells = rows.rows.emplace_back(columns.size());
        cells.front() = fmt::format("not traced ({}), at most", table.not_traced.count);
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (columns[c].name == "flux_mm2") cells[c] = table.not_traced.flux_bound_mm2;
            if (columns[c].name == "relative_flux" && table.direct.flux_mm2 > 0.0)
                cells[c] = table.not_traced.flux_bound_mm2 / table.direct.flux_mm2;
            if (columns[c].name == "reflections") cells[c] = std::int64_t{4};
        }
    }
    return rows;
}

std::string ghost_table_csv(const GhostTable& table, GhostColumns columns) {
    return table_csv(ghost_rows(table, columns));
}

std::string ghost_table_json(const GhostTable& table, GhostColumns columns) {
    return table_json(ghost_rows(table, columns)) + "\n";
}

}  // namespace ghostlight
