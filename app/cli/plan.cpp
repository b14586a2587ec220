#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/plan_omissions.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/flare/planned_flare.h"

namespace ghostlight::cli {
namespace {

struct PlanOptions {
    LensOptions lens;
    LightOptions light{.field = "0"};
    SpectrumOptions spectrum;
    std::string tolerance = "0.02", width = "1280";
    bool measure = false;
    OutputOptions output;
};

/// What the reference may err by that a picture is measured with, of its tolerance.
constexpr double reference_share = 0.25;

std::string fate_name(GhostFate fate) {
    switch (fate) {
        case GhostFate::drawn:
            return "drawn";
        case GhostFate::off_sensor:
            return "beside the sensor";
        case GhostFate::nothing_passes:
            return "nothing passes";
        case GhostFate::left_out:
            return "left out";
    }
    return {};
}

void run(const PlanOptions& options) {
    FlareRequest request;
    request.light = light_direction(options.light);
    request.tolerance = number_value("--tolerance", options.tolerance, "a share from 1e-4 to 0.5",
                                     [](double share) { return share >= 1e-4 && share <= 0.5; });
    request.width_px = static_cast<int>(integer_value(
        "--width", options.width, "a whole number of pixels from 16 to 16384", 16, 16384));
    const LoadedLens loaded = load_lens(options.lens);
    const FlareScene scene = flare_scene(loaded.lens, spectrum_of(options.spectrum));
    const FlareImage image = *render_planned(scene, request);
    FlarePlan plan = image.plan;
    std::ranges::stable_sort(plan.ghosts, std::ranges::greater{}, &PlannedGhost::flux_mm2);

    Report report;
    report.lens = lens_fields(loaded);
    report.request = {{"command", json_string("plan")},
                      {"field_deg", json_value(request.light.field_deg)},
                      {"azimuth_deg", json_value(request.light.azimuth_deg)},
                      {"spectrum", json_string(name(scene.spectrum))},
                      {"tolerance", json_value(request.tolerance)},
                      {"estimated_error", json_value(plan.estimated_error())},
                      {"flux_on_sensor_mm2", json_value(plan.flux_mm2)},
                      {"rays", json_value(static_cast<std::int64_t>(image.rays))},
                      {"time_ms", json_value(image.times.total_ms)}};
    report.heading = fmt::format(
        "{}\n{} ghosts: {} drawn, {} beside the sensor, {} through which nothing was found to "
        "pass.\nWithin {:.2g} % of the ghosts' light, by the plan's own estimate ({:.2g} % "
        "asked); {} rays, {:.1f} ms.\n",
        lens_heading(loaded), plan.ghosts.size(), plan.count(GhostFate::drawn),
        plan.count(GhostFate::off_sensor), plan.count(GhostFate::nothing_passes),
        100.0 * plan.estimated_error(), 100.0 * plan.tolerance, image.rays, image.times.total_ms);
    report.table.columns = {"ghost",         "fate",      "flux_on_sensor_mm2",
                            "allowance_mm2", "error_mm2", "cells_across",
                            "size",          "bands",     "rays"};
    for (const PlannedGhost& ghost : plan.ghosts) {
        const bool drawn = ghost.fate == GhostFate::drawn;
        auto if_drawn = [&](auto value) { return drawn ? Cell(value) : Cell(); };
        report.table.rows.push_back(
            {name(ghost.path, loaded.lens.surfaces.size()), fate_name(ghost.fate),
             if_drawn(ghost.flux_mm2), if_drawn(ghost.allowance_mm2), if_drawn(ghost.error_mm2),
             if_drawn(static_cast<std::int64_t>(ghost.cells)),
             drawn
                 ? Cell(ghost.level == 0 ? std::string("1") : fmt::format("1/{}", 1 << ghost.level))
                 : Cell(),
             if_drawn(static_cast<std::int64_t>(ghost.bands)),
             static_cast<std::int64_t>(ghost.rays)});
    }
    std::optional<MeasuredPlan> measured;
    if (options.measure) {
        ProgressLine progress("measuring against the reference");
        request.spectrum = scene.spectrum;
        measured = measure_plan(loaded.lens, request, image, reference_share * request.tolerance,
                                {}, [&](double share) { progress(share); });
    }
    const PlanReport omitted = plan_report(scene, plan);
    report.heading += omissions_text(omitted, measured);
    for (auto& field : omission_fields(omitted, measured)) report.request.push_back(field);
    write_report(report, options.output);
    print_notes(loaded.notes, Note::Severity::warning);
}

}  // namespace

void add_plan(CLI::App& program) {
    const auto options = std::make_shared<PlanOptions>();
    CLI::App* command = program.add_subcommand(
        "plan", "how the picture's ghosts are drawn for a tolerance, and what is not");
    add_lens(*command, options->lens)->required();
    add_light(*command, options->light)->capture_default_str();
    add_spectrum(*command, options->spectrum);
    add_text(*command, "--tolerance", options->tolerance, "X",
             "L1 error of the ghosts' irradiance on the sensor over their light")
        ->capture_default_str();
    add_text(*command, "--width", options->width, "PX", "of the picture, pixels")
        ->capture_default_str();
    command->add_flag("--measure", options->measure,
                      "the picture's true error, by a reference; takes from seconds to minutes");
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli plan tessar_brendel_100_f2.8 --field 10
  ghostlight-cli plan tessar_brendel_100_f2.8 --field 10 --width 320 --measure
  ghostlight-cli plan nikon_zoom_80_200_f2.8 --field 8 --spectrum D65 --tolerance 0.04 --csv)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
