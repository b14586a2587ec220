#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/plan_omissions.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/flare/plan_proof.h"
#include "core/flare/planned_flare.h"

namespace ghostlight::cli {
namespace {

struct PlanOptions {
    LensOptions lens;
    LightOptions light{.field = "0"};
    SpectrumOptions spectrum;
    std::string tolerance = "0.02", width = "1280", cells;
    bool certify = false, measure = false;
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
        case GhostFate::folded:
            return "in the veil";
    }
    return {};
}

/// What is said of a proof, above the table.
std::string heading_of(const PlanProof& proof) {
    return fmt::format(
        "Outside of where these ghosts are looked for, light on the sensor comes to at most {:.2g} "
        "% "
        "of theirs: proven for {} of {} ghosts to within {:.2g} % in all, in {:.1f} s{}\n",
        100.0 * proof.missed_share(), proof.certified, proof.ghosts.size(),
        100.0 * PlanProofRequest{}.missed_share, proof.seconds,
        proof.certified == proof.ghosts.size() ? "." : "; for the others, more --cells may do.");
}

void run(const PlanOptions& options) {
    FlareRequest request;
    request.light = light_direction(options.light);
    request.tolerance = number_value("--tolerance", options.tolerance, "a share from 1e-4 to 0.5",
                                     [](double share) { return share >= 1e-4 && share <= 0.5; });
    request.width_px = static_cast<int>(integer_value(
        "--width", options.width, "a whole number of pixels from 16 to 16384", 16, 16384));
    PlanProofRequest proving;
    if (!options.cells.empty()) {
        if (!options.certify) throw Error("--cells: goes with --certify");
        proving.most_cells = static_cast<std::size_t>(integer_value(
            "--cells", options.cells, "a whole number from 1 to 10000000", 1, 10'000'000));
    }
    const LoadedLens loaded = load_lens(options.lens);
    const FlareScene scene = flare_scene(loaded.lens, spectrum_of(options.spectrum));
    const FlareImage image = *render_planned(scene, request);
    FlarePlan plan = image.plan;
    const auto strength = [](const PlannedGhost& ghost) {
        return ghost.fate == GhostFate::left_out ? 0.0 : ghost.flux_mm2;
    };
    std::ranges::stable_sort(plan.ghosts, std::ranges::greater{}, strength);
    std::optional<PlanProof> proof;
    if (options.certify) {
        ProgressLine progress("proving bounds");
        proof = certify(scene, request.light, plan, proving, {},
                        [&](double share) { progress(share); });
    }

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
                      {"time_ms", json_value(image.times.total_ms)},
                      {"left_out_share", json_value(plan.left_out_share())},
                      {"not_modelled_share", json_value(plan.not_modelled)}};
    if (proof) {
        report.request.push_back({"missed_share", json_value(proof->missed_share())});
        report.request.push_back(
            {"certified", json_value(static_cast<std::int64_t>(proof->certified))});
    }
    report.heading = fmt::format(
        "{}\n{} ghosts: {} drawn, {} beside the sensor, {} through which nothing was found to "
        "pass, {} left out (at most {:.2g} % of the light).\nWithin {:.2g} % of the ghosts' light, "
        "by the plan's own estimate ({:.2g} % asked); {} rays, {:.1f} ms.\nNot modelled: light of "
        "four and more reflections, about {:.2g} % of that of two (surfaces taken as plane).\n",
        lens_heading(loaded), plan.ghosts.size(), plan.count(GhostFate::drawn),
        plan.count(GhostFate::off_sensor), plan.count(GhostFate::nothing_passes),
        plan.count(GhostFate::left_out), 100.0 * plan.left_out_share(),
        100.0 * plan.estimated_error(), 100.0 * plan.tolerance, image.rays, image.times.total_ms,
        100.0 * plan.not_modelled);
    if (proof) report.heading += heading_of(*proof);
    report.table.columns = {
        "ghost", "fate", "flux_on_sensor_mm2", "allowance_mm2", "error_mm2", "cells_across", "size",
        "bands", "rays", "bound_mm2"};
    if (proof) report.table.columns.push_back("missed_bound_mm2");
    for (std::size_t g = 0; g < plan.ghosts.size(); ++g) {
        const PlannedGhost& ghost = plan.ghosts[g];
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
             static_cast<std::int64_t>(ghost.rays),
             ghost.fate == GhostFate::nothing_passes ? Cell() : Cell(ghost.bound_mm2)});
        if (proof) report.table.rows.back().push_back(proof->ghosts[g].missed_flux_bound_mm2());
    }
    std::optional<MeasuredPlan> measured;
    if (options.measure) {
        ProgressLine progress("measuring against the reference");
        request.spectrum = scene.spectrum;
        measured = measure_plan(loaded.lens, request, image, reference_share * request.tolerance,
                                {}, [&](double share) { progress(share); });
    }
    const PlanReport omitted = plan_report(scene, request, plan, proof ? &*proof : nullptr);
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
    command->add_flag("--certify", options->certify,
                      "prove how much light the search for ghosts can have missed; takes seconds");
    add_text(
        *command, "--cells", options->cells, "N",
        "with --certify: cells that a ghost's proof may take at each wavelength; default 1000");
    command->add_flag("--measure", options->measure,
                      "the picture's true error, by a reference; takes from seconds to minutes");
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli plan tessar_brendel_100_f2.8 --field 10
  ghostlight-cli plan tessar_brendel_100_f2.8 --field 10 --width 320 --measure
  ghostlight-cli plan nikon_zoom_80_200_f2.8 --field 8 --spectrum D65 --tolerance 0.04 --csv
  ghostlight-cli plan cooke_triplet_50_f5 --field 10 --certify)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
