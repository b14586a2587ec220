#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/ghosts/ghost_table.h"
#include "core/io/table_file.h"
#include "core/optics/paraxial.h"

namespace ghostlight::cli {
namespace {

struct GhostsOptions {
    LensOptions lens;
    LightOptions light;
    SpectrumOptions spectrum;
    std::string top, tolerance = "0.01", columns, four;
    bool paraxial = false;
    OutputOptions output;
};

std::vector<const GhostRow*> rows_of(const GhostTable& table) {
    std::vector<const GhostRow*> rows = {&table.direct};
    for (const GhostRow& row : table.ghosts) rows.push_back(&row);
    return rows;
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

Table table_of(const GhostsOptions& options, const GhostTable& ghosts) {
    if (options.columns.empty() || options.columns == "basic")
        return options.paraxial ? with_paraxial(ghosts) : ghost_rows(ghosts);
    const Table all = ghost_rows(ghosts, GhostColumns::all);
    if (options.columns == "all") return all;
    std::vector<std::string> names;
    for (const std::string_view column : split(options.columns, ',')) names.emplace_back(column);
    return read_option("--columns", [&] { return select_columns(all, names); });
}

Notes unconverged(const GhostTable& table) {
    const auto rows = rows_of(table);
    const auto count = std::count_if(rows.begin(), rows.end(),
                                     [](const GhostRow* row) { return !row->converged; });
    if (count == 0) return {};
    return {
        {Note::Severity::warning, "--tolerance",
         fmt::format("{} of {} fluxes did not reach it: see flux_error_mm2", count, rows.size())}};
}

void run(const GhostsOptions& options) {
    GhostTableRequest request;
    request.light = light_direction(options.light);
    request.spectrum = spectrum_of(options.spectrum);
    request.tolerance = number_value("--tolerance", options.tolerance, "a share from 1e-6 to 1",
                                     [](double share) { return share >= 1e-6 && share <= 1.0; });
    const long top = options.top.empty() ? -1
                                         : integer_value("--top", options.top,
                                                         "a whole number above 0", 1, 1'000'000);
    if (!options.four.empty())
        request.four_reflections = static_cast<std::size_t>(
            integer_value("--four", options.four, "a whole number from 0 to 100000", 0, 100'000));
    LoadedLens loaded = load_lens(options.lens);
    GhostTable ghosts = [&] {
        ProgressLine progress("tracing ghosts");
        return *ghost_table(loaded.lens, request, {}, [&](double share) { progress(share); });
    }();
    // Strongest first by contract; kept here too, since --top relies on it.
    std::stable_sort(ghosts.ghosts.begin(), ghosts.ghosts.end(),
                     [](const GhostRow& a, const GhostRow& b) { return a.flux_mm2 > b.flux_mm2; });
    if (top >= 0 && static_cast<std::size_t>(top) < ghosts.ghosts.size())
        ghosts.ghosts.resize(static_cast<std::size_t>(top));

    Report report;
    report.lens = lens_fields(loaded);
    report.request = {{"command", json_string("ghosts")},
                      {"field_deg", json_value(request.light.field_deg)},
                      {"azimuth_deg", json_value(request.light.azimuth_deg)},
                      {"spectrum", json_string(name(request.spectrum))},
                      {"tolerance", json_value(request.tolerance)}};
    report.heading = fmt::format("{}: {}, field {} deg, azimuth {} deg, sensor {:.6g} x {:.6g} mm",
                                 lens_heading(loaded), name(request.spectrum),
                                 request.light.field_deg, request.light.azimuth_deg,
                                 loaded.lens.sensor.width_mm, loaded.lens.sensor.height_mm);
    report.table = table_of(options, ghosts);
    if (options.paraxial || !options.columns.empty())
        report.request.emplace_back("paraxial_wavelength_nm",
                                    json_value(reference_wavelength_nm(request.spectrum)));
    write_report(report, options.output);
    print_notes(loaded.notes, Note::Severity::warning);
    print_notes(unconverged(ghosts), Note::Severity::warning);
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
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli ghosts tessar_brendel_100_f2.8 --field 15 --top 10
  ghostlight-cli ghosts double_gauss_tronnier_100_f2 --field 10 --azimuth 45 --spectrum D65 --csv
  ghostlight-cli ghosts my_lens.json --field 0 --paraxial --coating qw:550 --f-number 8 --json

Fluxes in mm2 per unit irradiance of the light, lengths in mm.)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
