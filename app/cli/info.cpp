#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/lens_data.h"
#include "app/cli/report.h"
#include "core/io/import_report.h"
#include "core/io/lens_quantities.h"

namespace ghostlight::cli {
namespace {

struct InfoOptions {
    LensOptions lens;
    std::string wavelength = "587.5618", points = "11";
    bool rays = false, curves = false;
    OutputOptions output;
};

/// A lens in one of its configurations.
struct Position {
    LoadedLens loaded;
    OpticalSystem system;
};

std::vector<Position> positions_of(const InfoOptions& options, double wavelength_nm) {
    std::vector<Position> positions;
    for (const std::string& configuration : configurations_of(options.lens)) {
        LensOptions one = options.lens;
        one.config = configuration;
        LoadedLens loaded = load_lens(one);
        OpticalSystem system = compile(loaded.lens, wavelength_nm);
        positions.push_back({std::move(loaded), std::move(system)});
    }
    return positions;
}

std::string lens_lines(const LoadedLens& loaded, double wavelength_nm) {
    std::string text = lens_heading(loaded) + "\n";
    const auto line = [&](std::string_view label, std::string_view value) {
        std::string_view head = label;
        for (const std::string_view row : split(value, '\n')) {
            if (!row.empty()) text += fmt::format("  {:<28}{}\n", head, row);
            head = {};
        }
    };
    const Prescription& lens = loaded.lens;
    line("source", lens.source);
    line("notes", lens.notes);
    line("file", loaded.file.string());
    line("configurations", joined(loaded.configurations, ", "));
    line("surfaces",
         fmt::format("{}, the stop is row {}", lens.surfaces.size(), lens.stop.surface + 1));
    line("sensor_mm", fmt::format("{:.6g} x {:.6g}", lens.sensor.width_mm, lens.sensor.height_mm));
    line("wavelength_nm", fmt::format("{}", wavelength_nm));
    return text;
}

/// What was found when the file was read.
std::string report_lines(const Notes& notes) {
    return notes.empty() ? std::string() : "\nimport report\n" + notes_text(notes);
}

/// What can be shown of a lens that cannot be traced; then the error.
[[noreturn]] void show_unfinished(const LoadedLens& loaded, double wavelength_nm,
                                  const OutputOptions& output) {
    write_text(lens_lines(loaded, wavelength_nm) + report_lines(loaded.notes), output);
    refuse_unfinished(loaded);
    throw Error("the lens cannot be traced");
}

/// One line a quantity, one column a position of the lens.
std::string readable(const std::vector<Position>& positions, double wavelength_nm) {
    std::string text = lens_lines(positions.front().loaded, wavelength_nm) + "\n";
    std::vector<std::vector<LensQuantity>> values;
    for (const Position& each : positions) values.push_back(lens_quantities(each.system));
    constexpr std::size_t width = 14;
    if (positions.size() > 1) {
        text += fmt::format("  {:<28}", "");
        for (const Position& each : positions)
            text += fmt::format("{:>{}}", each.loaded.configuration, width);
        text += '\n';
    }
    for (std::size_t k = 0; k < values.front().size(); ++k) {
        const LensQuantity& quantity = values.front()[k];
        text += fmt::format("  {:<28}", quantity.name);
        for (const auto& of_one : values)
            text += fmt::format("{:>{}}", readable_text(of_one[k].value), width);
        text += fmt::format("{}{}\n", quantity.meaning.empty() ? "" : "   ", quantity.meaning);
    }
    return text + report_lines(positions.front().loaded.notes);
}

Table one_row(const OpticalSystem& system) {
    Table table;
    table.rows.emplace_back();
    for (const LensQuantity& quantity : lens_quantities(system)) {
        table.columns.push_back(quantity.name);
        table.rows.front().push_back(quantity.value);
    }
    return table;
}

/// The tables of all positions below one another, their configurations in front.
Table together(const std::vector<Position>& positions, const std::vector<Table>& tables) {
    if (tables.size() == 1) return tables.front();
    Table all;
    all.columns = {"configuration"};
    all.columns.insert(all.columns.end(), tables.front().columns.begin(),
                       tables.front().columns.end());
    for (std::size_t k = 0; k < tables.size(); ++k)
        for (const auto& row : tables[k].rows) {
            auto& cells = all.rows.emplace_back();
            cells.emplace_back(positions[k].loaded.configuration);
            cells.insert(cells.end(), row.begin(), row.end());
        }
    return all;
}

void run(const InfoOptions& options) {
    const double wavelength_nm = wavelength_value("--wavelength", options.wavelength);
    const auto points = static_cast<int>(
        integer_value("--points", options.points, "a whole number from 2 to 1000", 2, 1000));
    const bool plain = !options.rays && !options.curves;
    if (plain && !options.output.csv && !options.output.json) {
        LensOptions as_it_is;
        as_it_is.lens = options.lens.lens;
        as_it_is.takes_unfinished = true;
        const LoadedLens loaded = load_lens(as_it_is);
        if (std::ranges::any_of(loaded.notes, [](const Note& note) {
                return note.severity == Note::Severity::error;
            }))
            show_unfinished(loaded, wavelength_nm, options.output);
    }
    const std::vector<Position> positions = positions_of(options, wavelength_nm);
    if (plain && !options.output.csv && !options.output.json) {
        write_text(readable(positions, wavelength_nm), options.output);
        return;
    }
    const LoadedLens& loaded = positions.front().loaded;
    Report report{.lens = lens_fields(loaded), .request = {}, .heading = {}, .table = {}};
    const Prescription& lens = loaded.lens;
    std::vector<std::string> names;
    for (const std::string& name : loaded.configurations) names.push_back(json_string(name));
    report.lens.emplace_back("source", json_string(lens.source));
    report.lens.emplace_back("configurations", fmt::format("[{}]", joined(names, ", ")));
    report.lens.emplace_back("surfaces", fmt::format("{}", lens.surfaces.size()));
    report.lens.emplace_back("stop_surface", fmt::format("{}", lens.stop.surface + 1));
    report.request = {{"command", json_string("info")},
                      {"wavelength_nm", json_value(wavelength_nm)}};
    report.heading = fmt::format("{}: {} nm", lens_heading(loaded), wavelength_nm);
    std::vector<Table> tables;
    for (const Position& each : positions)
        tables.push_back(options.rays     ? paraxial_ray_rows(each.system)
                         : options.curves ? field_curve_rows(each.system, points)
                                          : one_row(each.system));
    report.table = together(positions, tables);
    write_report(report, options.output);
    print_notes(loaded.notes, Note::Severity::info);
}

}  // namespace

void add_info(CLI::App& program) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* command = program.add_subcommand("info", "first-order data of a lens");
    add_lens(*command, options->lens)->required();
    add_text(*command, "--wavelength", options->wavelength, "NM", "wavelength, nm")
        ->capture_default_str();
    CLI::Option* rays = command->add_flag(
        "--rays", options->rays, "instead the paraxial marginal and chief rays, by surface");
    command
        ->add_flag("--curves", options->curves,
                   "instead distortion, vignetting and relative illumination over the field, by\n"
                   "real rays")
        ->excludes(rays);
    add_text(*command, "--points", options->points, "N", "field angles of --curves")
        ->capture_default_str();
    add_output(*command, options->output);
    command->footer(R"(--config takes a comma list, or all: then the data are given for each.

Examples:
  ghostlight-cli info tessar_brendel_100_f2.8
  ghostlight-cli info my_zoom.json --config all
  ghostlight-cli info my_lens.json --wavelength 486.1327 --f-number 8 --json
  ghostlight-cli info my_lens.json --curves --points 21 --csv)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
