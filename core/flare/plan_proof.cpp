#include "core/flare/plan_proof.h"

#include <atomic>
#include <chrono>
#include <limits>

#include "core/parallel.h"

namespace ghostlight {

double PlanProof::missed_share() const {
    if (missed_flux_bound_mm2 == 0.0) return 0.0;
    return flux_mm2 > 0.0 ? missed_flux_bound_mm2 / flux_mm2
                          : std::numeric_limits<double>::infinity();
}

std::optional<PlanProof> certify(const FlareScene& scene, const LightDirection& light,
                                 const FlarePlan& plan, const PlanProofRequest& request,
                                 std::stop_token stop,
                                 const std::function<void(double)>& progress) {
    const auto began = std::chrono::steady_clock::now();
    const BeamFrame frame = beam_frame({light.field_deg, 90.0});
    PlanProof result;
    result.flux_mm2 = plan.flux_mm2;
    result.ghosts.resize(plan.ghosts.size());
    const double enough_mm2 = plan.ghosts.empty() ? 0.0
                                                  : request.missed_share * plan.flux_mm2 /
                                                        static_cast<double>(plan.ghosts.size());
    const ProofEffort effort{
        .most_cells = request.most_cells, .enough_mm2 = enough_mm2, .on_sensor = true};
    std::atomic<std::size_t> done{0};
    const bool finished =
        parallel_for(plan.ghosts.size(), request.threads, stop, [&](std::size_t g) {
            const PlannedGhost& planned = plan.ghosts[g];
            GhostProof& ghost = result.ghosts[g];
            ghost.path = planned.path;
            const bool has_box =
                planned.fate != GhostFate::nothing_passes && planned.fate != GhostFate::off_sensor;
            const PupilBox claimed = has_box ? planned.box : PupilBox{};
            for (const OpticalSystem& system : scene.geometry) {
                const PupilProof at =
                    prove_pupil(system, planned.path, frame, claimed, effort, stop);
                if (at.cells > 0 && at.missed_flux_bound_mm2 >= ghost.missed_flux_bound_mm2())
                    ghost.proof = at;
            }
            ghost.certified = ghost.missed_flux_bound_mm2() <= enough_mm2;
            if (progress)
                progress(static_cast<double>(++done) / static_cast<double>(plan.ghosts.size()));
        });
    if (!finished || stop.stop_requested()) return std::nullopt;
    for (const GhostProof& ghost : result.ghosts) {
        result.certified += ghost.certified ? 1 : 0;
        result.missed_flux_bound_mm2 += ghost.missed_flux_bound_mm2();
    }
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return result;
}

}  // namespace ghostlight
