#include <fmt/format.h>

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/flare/ghost_sweep.h"
#include "core/io/sweep_table.h"

namespace ghostlight::cli {
namespace {

struct SweepOptions {
    LensOptions lens;
    LightOptions light{.field = "0"};
    SpectrumOptions spectrum;
    std::string parameter = "field", values, tolerance = "0.01";
    OutputOptions output;
};

constexpr std::size_t most_values = 1000;

void run(const SweepOptions& options) {
    LoadedLens loaded = load_lens(options.lens);
    loaded.lens.configurations = read_lens(loaded.file).lens.configurations;
    SweepRequest request;
    request.parameter = read_option(
        "--parameter", [&] { return parse_sweep_parameter(options.parameter, loaded.lens); });
    request.values = list_value("--values", options.values, "numbers, A:B:STEP or a comma list",
                                [](double) { return true; });
    if (request.values.size() > most_values)
        throw bad_value("--values", options.values, fmt::format("at most {} values", most_values));
    request.table.light = light_direction(options.light);
    request.table.spectrum = spectrum_of(options.spectrum);
    request.table.tolerance =
        number_value("--tolerance", options.tolerance, "a share from 1e-6 to 1",
                     [](double share) { return share >= 1e-6 && share <= 1.0; });
    std::vector<SweepPoint> points;
    {
        ProgressLine progress("sweeping");
        double done = 0.0;
        points = *sweep(loaded.lens, request, {}, [&](const SweepPoint&) {
            progress(++done / static_cast<double>(request.values.size()));
        });
    }
    write_report({.lens = lens_fields(loaded),
                  .request = {{"command", json_string("sweep")},
                              {"parameter", json_string(name(request.parameter))},
                              {"field_deg", json_value(request.table.light.field_deg)},
                              {"azimuth_deg", json_value(request.table.light.azimuth_deg)},
                              {"spectrum", json_string(name(request.table.spectrum))},
                              {"tolerance", json_value(request.table.tolerance)}},
                  .heading = fmt::format("{}: {} over {} values", lens_heading(loaded),
                                         name(request.parameter), request.values.size()),
                  .table = sweep_table(request.parameter, points)},
                 options.output);
    for (const SweepPoint& point : points)
        if (!point.failure.empty())
            write_standard_error(fmt::format("warning: {} = {}: {}", name(request.parameter),
                                             point.value, point.failure));
}

}  // namespace

void add_sweep(CLI::App& program) {
    auto options = std::make_shared<SweepOptions>();
    CLI::App* command = program.add_subcommand(
        "sweep", "the ghosts while one number of the lens or the light is run through");
    add_lens(*command, options->lens)->required();
    add_text(*command, "--parameter", options->parameter, "NAME",
             "field, azimuth, f-number, position, or radius N, curvature N, thickness N,\n"
             "semi-diameter N, coating N (a factor on its layers)")
        ->capture_default_str();
    add_text(*command, "--values", options->values, "LIST", "A:B:STEP, or a comma list")
        ->required();
    add_light(*command, options->light)->capture_default_str();
    add_spectrum(*command, options->spectrum);
    add_text(*command, "--tolerance", options->tolerance, "X", "error allowed for each flux")
        ->capture_default_str();
    add_output(*command, options->output);
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
