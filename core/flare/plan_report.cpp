#include "core/flare/plan_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/flare/diffraction_omissions.h"
#include "core/flare/picture_errors.h"
#include "core/flare/probe_all.h"
#include "core/flare/reference_image.h"

namespace ghostlight {
namespace {

/// What the plan's estimates are good to (flare_plan.h: half of a tolerance is granted).
constexpr double doubt = 2.0;

/// Ghosts of one fate, and the light that a proof leaves them.
struct OfFate {
    std::size_t ghosts = 0;
    double bound_mm2 = 0.0, missed_mm2 = 0.0, error_mm2 = 0.0;
};
OfFate sum_of(const FlarePlan& plan, const PlanProof* proof, GhostFate fate) {
    OfFate sum;
    for (std::size_t g = 0; g < plan.ghosts.size(); ++g) {
        if (plan.ghosts[g].fate != fate) continue;
        ++sum.ghosts;
        sum.bound_mm2 += plan.ghosts[g].bound_mm2;
        sum.error_mm2 += plan.ghosts[g].error_mm2;
        if (proof) sum.missed_mm2 += proof->ghosts[g].missed_flux_bound_mm2();
    }
    return sum;
}

/// What the estimates of all drawn ghosts may come to in the worst case: as they are for each,
/// without what they are taken to make up for each other.
double most_doubt(const FlarePlan& plan) {
    std::vector<double> fluxes_mm2;
    for (const PlannedGhost& ghost : plan.ghosts)
        if (ghost.fate == GhostFate::drawn) fluxes_mm2.push_back(ghost.flux_mm2);
    return doubt * made_up(fluxes_mm2);
}

}  // namespace

double bounded_error(const FlarePlan& plan) {
    const double light_mm2 = plan.flux_mm2 + plan.folded_mm2;
    if (!(light_mm2 > 0.0)) return 0.0;
    return (plan.left_out_mm2 + 2.0 * plan.folded_mm2 + most_doubt(plan) * plan.error_mm2) /
           light_mm2;
}

PlanReport plan_report(const FlareScene& scene, const FlareRequest& request, const FlarePlan& plan,
                       const PlanProof* proof) {
    PlanReport report;
    report.flux_mm2 = plan.flux_mm2 + plan.folded_mm2;
    auto add = [&](std::string what, std::string why, std::size_t ghosts,
                   std::optional<double> bound_mm2, bool proven) {
        if (ghosts == 0) return;
        report.omissions.push_back({std::move(what), std::move(why), ghosts, bound_mm2, proven});
        report.bound_mm2 += bound_mm2.value_or(0.0);
        if (proven) report.proven_mm2 += bound_mm2.value_or(0.0);
    };
    auto missed = [&](const OfFate& sum) {
        return proof ? std::optional(sum.missed_mm2) : std::nullopt;
    };
    const OfFate left_out = sum_of(plan, proof, GhostFate::left_out);
    add("ghosts left out", "the bound of their light is below their share of the error",
        left_out.ghosts, left_out.bound_mm2, true);
    const OfFate folded = sum_of(plan, proof, GhostFate::folded);
    // Light in the wrong place is missing from the right one too.
    add("ghosts folded into the veil", "too faint and broad to be seen by themselves",
        folded.ghosts, 2.0 * plan.folded_mm2, false);
    const OfFate beside = sum_of(plan, proof, GhostFate::off_sensor);
    add("ghosts beside the sensor", "none of the light that was found lands on it", beside.ghosts,
        missed(beside), true);
    const OfFate dark = sum_of(plan, proof, GhostFate::nothing_passes);
    add("ghosts through which nothing passes", "the stop, a rim or total reflection kills all rays",
        dark.ghosts, missed(dark), true);
    const OfFate drawn = sum_of(plan, proof, GhostFate::drawn);
    add("the entrance outside of the boxes", "no ray of the search passed there", drawn.ghosts,
        missed(drawn), true);
    add("half of each beam", "the lens is round: it is the mirror image", drawn.ghosts, 0.0, true);
    add("rays and pixels beyond the tolerance",
        "each ghost's grid and size of picture are as coarse as its share of the error allows",
        drawn.ghosts, most_doubt(plan) * drawn.error_mm2, false);
    const auto small =
        static_cast<std::size_t>(std::ranges::count_if(plan.ghosts, [](const PlannedGhost& ghost) {
            return ghost.fate == GhostFate::drawn && ghost.level > 0;
        }));
    add("of these, drawn at 1/2 to 1/16 of the size", "they are broad", small, std::nullopt, false);
    if (!scene.is_gray()) {
        const auto merged = static_cast<std::size_t>(
            std::ranges::count_if(plan.ghosts, [&](const PlannedGhost& ghost) {
                return ghost.fate == GhostFate::drawn &&
                       static_cast<std::size_t>(ghost.bands) < scene.samples.size();
            }));
        add(fmt::format("of these, with {} wavelengths merged into bands", scene.samples.size()),
            "colour shifts them by less than their share", merged, std::nullopt, false);
    }
    add("polarisation of every ray", "it is carried along few rays, and interpolated between them",
        scene.coating_model == CoatingModel::exact ? drawn.ghosts : 0, std::nullopt, false);
    for (Omission& each : diffraction_omissions(scene, request, plan)) {
        report.bound_mm2 += each.bound_mm2.value_or(0.0);
        report.omissions.push_back(std::move(each));
    }
    report.omissions.push_back({.what = "glare of dust and polish",
                                .why = "a layer of its own, the veil, where it is asked for",
                                .ghosts = 0,
                                .bound_mm2 = std::nullopt,
                                .proven = false});
    if (plan.not_modelled > 0.0)
        report.omissions.push_back(
            {.what = "ghosts of four and more reflections",
             .why = fmt::format("no picture has them; about {:.2g} % of the light of two",
                                100.0 * plan.not_modelled),
             .ghosts = 0,
             .bound_mm2 = std::nullopt,
             .proven = false});
    return report;
}

std::optional<MeasuredPlan> measure_plan(const Prescription& lens, const FlareRequest& request,
                                         const FlareImage& image, double reference_tolerance,
                                         std::stop_token stop,
                                         const std::function<void(double)>& progress) {
    ReferenceRequest reference;
    reference.light = request.light;
    reference.spectrum = request.spectrum;
    reference.width_px = request.width_px;
    reference.tolerance = reference_tolerance;
    reference.only = request.only;
    reference.threads = request.threads;
    const auto truth = render_reference(lens, reference, std::move(stop), progress);
    if (!truth) return std::nullopt;
    MeasuredPlan measured;
    measured.error = picture_errors(image.irradiance, truth->image.irradiance).relative_l1;
    measured.reference_bound = truth->relative_error();
    if (truth->image.flux_on_sensor_mm2 > 0.0)
        measured.reference_error = truth->disagreement_mm2 / truth->image.flux_on_sensor_mm2;
    return measured;
}

}  // namespace ghostlight
