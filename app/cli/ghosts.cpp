#include <fmt/format.h>

#include <algorithm>
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
    std::string top, tolerance = "0.01";
    bool paraxial = false;
    OutputOptions output;
};

std::vector<const GhostRow*> rows_of(const GhostTable& table) {
    std::vector<const GhostRow*> rows = {&table.direct};
    for (const GhostRow& row : table.ghosts) rows.push_back(&row);
    return rows;
}

void append_paraxial(Table& table, const GhostTable& ghosts, const OpticalSystem& system) {
    table.columns.insert(table.columns.end(),
                         {"a", "b", "c", "d", "focus_from_sensor_mm", "magnification",
                          "paraxial_diameter_mm", "fresnel_number", "stop_crossings"});
    const auto rows = rows_of(ghosts);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        // Paths end travelling towards the sensor, so dy/ds is dy/dz at both ends.
        const ParaxialGhost first = paraxial_ghost(system, rows[i]->path);
        const RayMatrix& matrix = first.to_sensor;
        table.rows[i].insert(table.rows[i].end(),
                             {matrix.a, matrix.b, matrix.c, matrix.d, first.focus_from_sensor_mm,
                              first.magnification, first.diameter_mm, first.fresnel_number,
                              static_cast<std::int64_t>(first.stop_crossings)});
    }
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
    report.table = ghost_rows(ghosts);
    if (options.paraxial) {
        const double wavelength_nm = reference_wavelength_nm(request.spectrum);
        report.request.emplace_back("paraxial_wavelength_nm", json_value(wavelength_nm));
        append_paraxial(report.table, ghosts, compile(loaded.lens, wavelength_nm));
    }
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
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli ghosts tessar_brendel_100_f2.8 --field 15 --top 10
  ghostlight-cli ghosts double_gauss_tronnier_100_f2 --field 10 --azimuth 45 --spectrum D65 --csv
  ghostlight-cli ghosts my_lens.json --field 0 --paraxial --coating qw:550 --f-number 8 --json

Fluxes in mm2 per unit irradiance of the light, lengths in mm.)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
