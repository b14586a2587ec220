#include "app/cli/ghost_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

/// Each value of a list option as a text of its own; one empty text where it was not given.
std::vector<std::string> texts_of(std::string_view option, const std::string& text,
                                  std::string_view expected, bool (*accepts)(double)) {
    if (text.empty()) return {""};
    std::vector<std::string> texts;
    for (const double value : list_value(option, text, expected, accepts))
        texts.push_back(exact_text(value));
    return texts;
}

std::size_t column_of(const Table& table, const std::string& name) {
    const auto at = std::ranges::find(table.columns, name);
    return static_cast<std::size_t>(at - table.columns.begin());
}

/// A row's key and its state but for the field.
std::string group_of(const std::vector<Cell>& state, const Cell& key) {
    std::string group = exact_text(key);
    const auto names = state_columns();
    for (std::size_t c = 0; c < state.size(); ++c)
        if (names[c] != "field_deg") group += '\n' + exact_text(state[c]);
    return group;
}

void append_worst_field(Table& rows, const std::string& key) {
    const std::size_t states = state_columns().size();
    const std::size_t key_column = column_of(rows, key), flux = column_of(rows, "flux_mm2");
    const std::size_t field = column_of(rows, "field_deg");
    if (key_column == rows.columns.size() || flux == rows.columns.size()) return;
    struct Worst {
        double flux_mm2 = 0.0;
        Cell field_deg;
    };
    std::map<std::string, Worst> worst;
    std::vector<std::string> groups;
    for (const auto& row : rows.rows) {
        groups.push_back(group_of({row.begin(), row.begin() + static_cast<std::ptrdiff_t>(states)},
                                  row[key_column]));
        const auto* value = std::get_if<double>(&row[flux]);
        Worst& so_far = worst[groups.back()];
        if (value && *value > so_far.flux_mm2) so_far = {*value, row[field]};
    }
    rows.columns.emplace_back("worst_field_deg");
    for (std::size_t r = 0; r < rows.rows.size(); ++r)
        rows.rows[r].push_back(worst[groups[r]].field_deg);
}

}  // namespace

std::vector<GhostState> ghost_states(const LensOptions& lens, const LightOptions& light,
                                     const SpectrumOptions& spectrum) {
    const auto f_numbers = texts_of("--f-number", lens.f_number, "numbers above 0",
                                    [](double n) { return n > 0.0 && n <= 1e6; });
    const auto wavelengths = texts_of("--wavelength", spectrum.wavelength,
                                      "wavelengths in nm from 100 to 100000", is_usable_wavelength);
    const auto fields = texts_of("--field", light.field, "angles in degrees from -90 to 90",
                                 [](double deg) { return deg >= -90.0 && deg <= 90.0; });
    const auto azimuths =
        texts_of("--azimuth", light.azimuth, "angles in degrees", [](double) { return true; });
    const auto configurations = configurations_of(lens);
    const double count = static_cast<double>(f_numbers.size() * wavelengths.size()) *
                         static_cast<double>(fields.size() * azimuths.size()) *
                         static_cast<double>(configurations.size());
    if (count > 100'000.0)
        throw Error({.problem = "too many states",
                     .file = {},
                     .where = "--field, --azimuth, --wavelength, --f-number, --config",
                     .found = fmt::format("{}", count),
                     .expected = "at most 100000 together"});
    std::vector<GhostState> states;
    for (const std::string& configuration : configurations)
        for (const std::string& f_number : f_numbers) {
            LensOptions one = lens;
            one.config = configuration;
            one.f_number = f_number;
            GhostState state;
            state.loaded = load_lens(one);
            state.f_number = first_order(compile(state.loaded.lens, d_line_nm)).f_number;
            for (const std::string& wavelength : wavelengths) {
                state.spectrum =
                    spectrum_of({.wavelength = wavelength, .spectrum = spectrum.spectrum});
                for (const std::string& azimuth : azimuths)
                    for (const std::string& field : fields) {
                        state.light = light_direction({.field = field, .azimuth = azimuth});
                        states.push_back(state);
                    }
            }
        }
    return states;
}

std::vector<std::string> state_columns() {
    return {"configuration", "f_number", "spectrum", "wavelength_nm", "field_deg", "azimuth_deg"};
}

std::vector<Cell> state_cells(const GhostState& state) {
    const auto* line = std::get_if<Monochromatic>(&state.spectrum);
    const std::string& configuration = state.loaded.configuration;
    return {configuration.empty() ? Cell() : Cell(configuration),
            state.f_number,
            line ? Cell() : Cell(name(state.spectrum)),
            line ? Cell(line->wavelength_nm) : Cell(),
            state.light.field_deg,
            state.light.azimuth_deg};
}

Table tidy(const std::vector<StateTable>& states, const std::string& key) {
    Table all;
    all.columns = state_columns();
    for (const StateTable& each : states)
        for (const std::string& column : each.table.columns)
            if (column_of(all, column) == all.columns.size()) all.columns.push_back(column);
    bool several_fields = false;
    for (const StateTable& each : states) {
        several_fields =
            several_fields || each.state->light.field_deg != states.front().state->light.field_deg;
        std::vector<std::size_t> places;
        for (const std::string& column : each.table.columns)
            places.push_back(column_of(all, column));
        for (const auto& row : each.table.rows) {
            std::vector<Cell> cells = state_cells(*each.state);
            cells.resize(all.columns.size());
            for (std::size_t c = 0; c < row.size(); ++c) cells[places[c]] = row[c];
            all.rows.push_back(std::move(cells));
        }
    }
    if (several_fields) append_worst_field(all, key);
    return all;
}

Table wide(const std::vector<StateTable>& states, const std::string& key,
           const std::string& quantity) {
    const auto names = state_columns();
    std::vector<std::vector<Cell>> cells;
    for (const StateTable& each : states) cells.push_back(state_cells(*each.state));
    std::vector<bool> differs(names.size(), false);
    for (const auto& each : cells)
        for (std::size_t c = 0; c < names.size(); ++c)
            differs[c] = differs[c] || each[c] != cells.front()[c];
    Table all;
    all.columns = {key};
    std::map<std::string, std::size_t> row_of;
    for (std::size_t s = 0; s < states.size(); ++s) {
        std::string title = quantity;
        const char* separator = " at ";
        for (std::size_t c = 0; c < names.size(); ++c)
            if (differs[c]) {
                title += separator + names[c] + "=" + exact_text(cells[s][c]);
                separator = " ";
            }
        all.columns.push_back(title);
        for (const auto& row : select_columns(states[s].table, {key, quantity}).rows) {
            const auto [place, is_new] = row_of.try_emplace(exact_text(row[0]), all.rows.size());
            if (is_new) all.rows.push_back({row[0]});
            auto& whole = all.rows[place->second];
            whole.resize(s + 2);
            whole[s + 1] = row[1];
        }
    }
    for (auto& row : all.rows) row.resize(all.columns.size());
    return all;
}

}  // namespace ghostlight::cli
