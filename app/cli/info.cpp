#include <fmt/format.h>

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/report.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"

namespace ghostlight::cli {
namespace {

struct InfoOptions {
    LensOptions lens;
    std::string wavelength = "587.5618";
    OutputOptions output;
};

struct Quantity {
    std::string name;
    Cell value;
    std::string meaning;
};

std::vector<Quantity> quantities(const OpticalSystem& system) {
    const FirstOrder first = first_order(system);
    const auto ghosts = static_cast<std::int64_t>(two_reflection_ghosts(system).size());
    return {
        {"efl_mm", first.efl_mm, "effective focal length"},
        {"bfd_mm", first.bfd_mm, "last vertex to rear focus"},
        {"ffd_mm", first.ffd_mm, "first vertex to front focus, signed"},
        {"f_number", first.f_number, "with the stop as it stands"},
        {"entrance_pupil_z_mm", first.entrance_pupil_z_mm, "from the first vertex"},
        {"entrance_pupil_radius_mm", first.entrance_pupil_radius_mm, ""},
        {"exit_pupil_z_mm", first.exit_pupil_z_mm, "from the last vertex"},
        {"exit_pupil_radius_mm", first.exit_pupil_radius_mm, ""},
        {"sensor_distance_mm", first.sensor_distance_mm, "last vertex to sensor"},
        {"paraxial_defocus_mm", first.paraxial_defocus_mm, "sensor - focus"},
        {"ghosts", ghosts, "pairs of two reflections"},
    };
}

std::string readable(const LoadedLens& loaded, double wavelength_nm,
                     const std::vector<Quantity>& values) {
    std::string text = lens_heading(loaded) + "\n";
    const auto line = [&](std::string_view label, std::string_view value) {
        if (!value.empty()) text += fmt::format("  {:<26}{}\n", label, value);
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
    text += '\n';
    for (const Quantity& quantity : values)
        text += fmt::format("  {:<26}{:>12}{}{}\n", quantity.name, readable_text(quantity.value),
                            quantity.meaning.empty() ? "" : "   ", quantity.meaning);
    return text;
}

void run(const InfoOptions& options) {
    const LoadedLens loaded = load_lens(options.lens);
    const double wavelength_nm = wavelength_value("--wavelength", options.wavelength);
    const auto values = quantities(compile(loaded.lens, wavelength_nm));

    if (!options.output.csv && !options.output.json) {
        std::string text = readable(loaded, wavelength_nm, values);
        for (const Note& note : loaded.notes)
            text += fmt::format("\n  {}: {}{}{}\n", severity_name(note.severity), note.where,
                                note.where.empty() ? "" : ": ", note.text);
        write_text(text, options.output);
        return;
    }
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
    report.table.rows.emplace_back();
    for (const Quantity& quantity : values) {
        report.table.columns.push_back(quantity.name);
        report.table.rows.front().push_back(quantity.value);
    }
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
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli info tessar_brendel_100_f2.8
  ghostlight-cli info my_lens.json --wavelength 486.1327 --f-number 8 --json)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
