#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/ghost_reports.h"
#include "app/cli/html_report.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "core/flare/mask_raster.h"
#include "core/ghosts/ghost_query.h"
#include "core/ghosts/ghost_table.h"
#include "core/io/table_file.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

struct GhostsOptions {
    LensOptions lens;
    LightOptions light;
    SpectrumOptions spectrum;
    std::string top, tolerance = "0.01", columns, four, by, wide, html, where;
    std::string command;  ///< as typed, for the report
    bool paraxial = false, tidy = false, sensitivities = false;
    OutputOptions output;
};

/// Quoted for a shell where it has to be.
std::string shell_word(const std::string& text) {
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,=+@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

/// What one state's table is made of.
struct Plan {
    GhostTableRequest request;  ///< but for the light
    std::optional<std::size_t> top;
};

Plan plan_of(const GhostsOptions& options) {
    Plan plan;
    plan.request.tolerance =
        number_value("--tolerance", options.tolerance, "a share from 1e-6 to 1",
                     [](double share) { return share >= 1e-6 && share <= 1.0; });
    if (!options.top.empty())
        plan.top = static_cast<std::size_t>(
            integer_value("--top", options.top, "a whole number above 0", 1, 1'000'000));
    if (!options.four.empty())
        plan.request.four_reflections = static_cast<std::size_t>(
            integer_value("--four", options.four, "a whole number from 0 to 100000", 0, 100'000));
    if (!options.html.empty() && !options.by.empty())
        throw bad_value("--html", options.html, "no --by: the page has the sums by surface");
    if (!options.by.empty() && options.by != "surface" && options.by != "element")
        throw bad_value("--by", options.by, "surface or element");
    // Peaks cost the most: only where they are shown.
    const std::string& shown = options.wide.empty() ? options.columns : options.wide;
    const bool all = shown.empty() || shown == "basic" || shown == "all";
    plan.request.peaks = options.by.empty() && !options.sensitivities &&
                         (all || shown.find("peak") != std::string::npos || !options.html.empty());
    return plan;
}

/// The command line again, from what the parser took.
std::string typed_command(const CLI::App& command) {
    std::string text = "ghostlight-cli " + command.get_name();
    for (const CLI::Option* option : command.parse_order()) {
        if (option->get_positional()) continue;
        text += " " + option->get_name(false, false);
        for (const std::string& value : option->results())
            if (option->get_items_expected_max() > 0) text += " " + shell_word(value);
    }
    for (const CLI::Option* option : command.get_options())
        if (option->get_positional() && !option->results().empty())
            text += " " + shell_word(option->results().front());
    return text;
}

/// The first-order columns at the end of `all`, behind the basic ones.
Table with_paraxial(const GhostTable& ghosts) {
    constexpr std::array names = {"a",
                                  "b",
                                  "c",
                                  "d",
                                  "focus_from_sensor_mm",
                                  "magnification",
                                  "paraxial_diameter_mm",
                                  "fresnel_number",
                                  "stop_crossings"};
    std::vector<std::string> wanted = ghost_rows(ghosts, GhostColumns::basic).columns;
    wanted.insert(wanted.end(), names.begin(), names.end());
    return select_columns(ghost_rows(ghosts, GhostColumns::all), wanted);
}

Table table_of(const GhostsOptions& options, const GhostTable& ghosts, const GhostState& state) {
    if (options.by == "surface") return rows_by_surface(ghosts, state.loaded.lens);
    if (options.by == "element") return rows_by_element(ghosts, state.loaded.lens);
    if (options.sensitivities) return rows_of_sensitivities(ghosts, state);
    if (!options.wide.empty()) return ghost_rows(ghosts, GhostColumns::all);
    if (options.columns.empty() || options.columns == "basic")
        return options.paraxial ? with_paraxial(ghosts) : ghost_rows(ghosts);
    const Table all = ghost_rows(ghosts, GhostColumns::all);
    if (options.columns == "all") return all;
    std::vector<std::string> names;
    for (const std::string_view column : split(options.columns, ',')) names.emplace_back(column);
    return read_option("--columns", [&] { return select_columns(all, names); });
}

/// What tells the rows of one state apart.
std::string key_of(const GhostsOptions& options) {
    if (options.by == "surface") return "surface";
    if (options.by == "element") return "elements";
    return "ghost";
}

/// Leaves the ghosts that a query in words is about.
void keep_wanted(const std::string& where, GhostTable& table) {
    const GhostQuery query =
        read_option("--where", [&] { return parse_ghost_query(where, table.surface_count); });
    const GhostTable all = table;
    std::erase_if(table.ghosts, [&](const GhostRow& row) { return !passes(query, row, all); });
}

void count_unconverged(const GhostTable& table, std::size_t& unconverged, std::size_t& rows) {
    unconverged += table.direct.converged ? 0 : 1;
    for (const GhostRow& row : table.ghosts) unconverged += row.converged ? 0 : 1;
    rows += table.ghosts.size() + 1;
}

/// A list option in the request of a JSON answer: a number where there is one only.
std::string json_list(const std::vector<GhostState>& states, double (*value)(const GhostState&)) {
    std::vector<double> values;
    for (const GhostState& state : states)
        if (std::ranges::find(values, value(state)) == values.end()) values.push_back(value(state));
    if (values.size() == 1) return json_value(values.front());
    std::vector<std::string> texts;
    for (const double each : values) texts.push_back(json_value(each));
    return "[" + joined(texts, ", ") + "]";
}

JsonFields request_fields(const GhostsOptions& options, const Plan& plan,
                          const std::vector<GhostState>& states) {
    std::vector<std::string> spectra;
    for (const GhostState& state : states) {
        const std::string each = json_string(name(state.spectrum));
        if (std::ranges::find(spectra, each) == spectra.end()) spectra.push_back(each);
    }
    JsonFields fields = {
        {"command", json_string("ghosts")},
        {"field_deg", json_list(states, [](const GhostState& s) { return s.light.field_deg; })},
        {"azimuth_deg", json_list(states, [](const GhostState& s) { return s.light.azimuth_deg; })},
        {"spectrum", spectra.size() == 1 ? spectra.front() : "[" + joined(spectra, ", ") + "]"},
        {"tolerance", json_value(plan.request.tolerance)},
        {"f_number", json_list(states, [](const GhostState& s) { return s.f_number; })},
        {"four_reflections", std::to_string(plan.request.four_reflections)}};
    if (options.paraxial || !options.columns.empty())
        fields.emplace_back("paraxial_wavelength_nm", json_list(states, [](const GhostState& s) {
                                return reference_wavelength_nm(s.spectrum);
                            }));
    return fields;
}

std::string heading_of(const std::vector<GhostState>& states, const GhostTable& first) {
    const GhostState& state = states.front();
    const Sensor& sensor = state.loaded.lens.sensor;
    if (states.size() > 1)
        return fmt::format("{}: {} states, sensor {:.6g} x {:.6g} mm", state.loaded.lens.name,
                           states.size(), sensor.width_mm, sensor.height_mm);
    std::string text =
        fmt::format("{}: {}, field {} deg, azimuth {} deg, sensor {:.6g} x {:.6g} mm",
                    lens_heading(state.loaded), name(state.spectrum), state.light.field_deg,
                    state.light.azimuth_deg, sensor.width_mm, sensor.height_mm);
    const StopDirt& dirt = state.loaded.lens.stop.dirt;
    if (!dirt.is_clean())
        text += fmt::format(
            "\nwithout the dirt on the stop, which leaves {:.4g} of the light of each crossing",
            clear_share(compile(state.loaded.lens, d_line_nm).stop_mask, dirt));
    if (first.veiling_fraction >= 0.0)
        text += fmt::format("\nall ghosts on the sensor over the image: {:.4g}",
                            first.veiling_fraction);
    return text;
}

void run(const GhostsOptions& options) {
    const Plan plan = plan_of(options);
    const std::vector<GhostState> states =
        ghost_states(options.lens, options.light, options.spectrum);
    std::vector<StateTable> tables;
    GhostTable first;
    std::size_t unconverged = 0, rows = 0;
    if (!options.html.empty() && states.size() > 1)
        throw bad_value("--html", options.html, "one state of lens and light");
    {
        ProgressLine progress("tracing ghosts");
        for (const GhostState& state : states) {
            GhostTableRequest request = plan.request;
            request.light = state.light;
            request.spectrum = state.spectrum;
            const double before =
                static_cast<double>(tables.size()) / static_cast<double>(states.size());
            GhostTable ghosts = *ghost_table(state.loaded.lens, request, {}, [&](double share) {
                progress(before + share / static_cast<double>(states.size()));
            });
            count_unconverged(ghosts, unconverged, rows);
            if (tables.empty()) first = ghosts;
            if (!options.where.empty()) keep_wanted(options.where, ghosts);
            // Sums are over all of them, whatever is shown.
            if (plan.top && options.by.empty() && *plan.top < ghosts.ghosts.size())
                ghosts.ghosts.resize(*plan.top);
            tables.push_back({&state, table_of(options, ghosts, state)});
        }
    }

    if (!options.html.empty())
        write_file_safely(options.html,
                          html_report({.state = &states.front(),
                                       .ghosts = &first,
                                       .shown = plan.top.value_or(0),
                                       .command = options.command,
                                       .settings = request_fields(options, plan, states)}));

    Report report;
    const LoadedLens& loaded = states.front().loaded;
    report.lens = lens_fields(loaded);
    report.request = request_fields(options, plan, states);
    report.heading = heading_of(states, first);
    if (!options.wide.empty())
        report.table =
            read_option("--wide", [&] { return wide(tables, key_of(options), options.wide); });
    else if (options.tidy || states.size() > 1)
        report.table = tidy(tables, key_of(options));
    else
        report.table = std::move(tables.front().table);
    write_report(report, options.output);
    print_notes(loaded.notes, Note::Severity::warning);
    if (unconverged > 0)
        write_standard_error(fmt::format(
            "warning: --tolerance: {} of {} fluxes did not reach it: see flux_error_mm2",
            unconverged, rows));
}

}  // namespace

void add_ghosts(CLI::App& program) {
    const auto options = std::make_shared<GhostsOptions>();
    CLI::App* command = program.add_subcommand(
        "ghosts", "the ghosts of a lens, strongest first, after the direct path");
    add_lens(*command, options->lens)->required();
    add_light(*command, options->light)->required();
    add_spectrum(*command, options->spectrum);
    add_text(*command, "--top", options->top, "N", "the N strongest only");
    add_text(
        *command, "--where", options->where, "WORDS",
        "those alone that meet this, such as \"touches 7 and above 1e-6\"; sums are over them");
    add_text(*command, "--tolerance", options->tolerance, "X",
             "error allowed for each flux, as a share of it (or 1e-6 of the strongest\nghost, if "
             "that is larger)")
        ->capture_default_str();
    command->add_flag("--paraxial", options->paraxial,
                      "add first-order data; with a spectrum at 587.5618 nm");
    add_text(*command, "--columns", options->columns, "basic|all|NAME,...",
             "which columns; all of them and what they mean: docs/command-line.md");
    add_text(*command, "--four", options->four, "N",
             "trace also the N ghosts of four reflections that can be the strongest; the\n"
             "others are bounded together in the last row");
    auto* by =
        add_text(*command, "--by", options->by, "surface|element",
                 "sums instead of ghosts: the flux that each surface feeds, or that of each\n"
                 "pair of elements");
    auto* sensitivities = command->add_flag(
        "--sensitivities", options->sensitivities,
        "instead of ghosts what their fluxes do as a coating's thickness, centre\n"
        "wavelength or reflectance changes");
    sensitivities->excludes(by);
    command->add_flag("--tidy", options->tidy,
                      "columns for the state in front, as with several of them");
    add_text(*command, "--wide", options->wide, "NAME",
             "one row a ghost, one column a state, of the column NAME");
    add_text(*command, "--html", options->html, "FILE",
             "write also one self-contained page: lens, layout, reflectances, ghosts, picture");
    add_output(*command, options->output);
    command->footer(
        R"(Several states: --field, --azimuth, --wavelength and --f-number take A:B:STEP or a comma list,
--config a comma list or all. One row for each ghost of each state, the state in front.

Examples:
  ghostlight-cli ghosts tessar_brendel_100_f2.8 --field 15 --top 10
  ghostlight-cli ghosts double_gauss_tronnier_100_f2 --field 10 --azimuth 45 --spectrum D65 --csv
  ghostlight-cli ghosts my_lens.json --field 0 --paraxial --coating qw:550 --f-number 8 --json
  ghostlight-cli ghosts my_lens.json --field 0:20:2 --f-number 2.8,8 --csv > sweep.csv
  ghostlight-cli ghosts my_lens.json --field 10 --by surface

Fluxes in mm2 per unit irradiance of the light, lengths in mm.)");
    command->callback([options, command] {
        options->command = typed_command(*command);
        run(*options);
    });
}

}  // namespace ghostlight::cli
