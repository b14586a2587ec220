#include <fmt/format.h>

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "core/io/lens_file.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

std::vector<Cell> row_of(const BundledLens& bundled) {
    const Prescription lens = read_lens(bundled.file).lens;
    std::vector<std::string> configurations;
    for (const Configuration& configuration : lens.configurations)
        configurations.push_back(configuration.name);
    const OpticalSystem system = compile(lens, d_line_nm);
    const FirstOrder first = first_order(system);
    return {short_name(bundled),
            bundled.name,
            first.efl_mm,
            first.f_number,
            static_cast<std::int64_t>(lens.surfaces.size()),
            static_cast<std::int64_t>(two_reflection_ghosts(system).size()),
            joined(configurations, " "),
            bundled.file.string()};
}

void run(const OutputOptions& output) {
    Report report;
    report.request = {{"command", json_string("lenses")}};
    report.table.columns = {"lens",     "name",   "efl_mm",         "f_number",
                            "surfaces", "ghosts", "configurations", "file"};
    for (const BundledLens& bundled : bundled_lenses()) {
        try {
            report.table.rows.push_back(row_of(bundled));
        } catch (const Error& error) {
            // One bad file must not hide the others.
            write_standard_error(fmt::format("warning: {}", error.what()));
        }
    }
    write_report(report, output);
}

}  // namespace

void add_lenses(CLI::App& program) {
    const auto output = std::make_shared<OutputOptions>();
    CLI::App* command = program.add_subcommand("lenses", "list the bundled lenses");
    add_output(*command, *output);
    command->footer("Any of the names works as LENS in the other commands.");
    command->callback([output] { run(*output); });
}

}  // namespace ghostlight::cli
