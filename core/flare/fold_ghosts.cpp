#include "core/flare/fold_ghosts.h"

#include <algorithm>
#include <numbers>

#include "core/flare/veiling_glare.h"

namespace ghostlight {
namespace {

/// Ghosts whose kernel is narrower than this share of the sensor's width are always drawn: people
/// see their shapes, and the series would need many orders.
constexpr double narrowest_folded = 1.0 / 40.0;

}  // namespace

std::vector<std::size_t> foldable(std::span<const GhostSpot> ghosts, double share,
                                  double sensor_width_mm, double sensor_height_mm) {
    struct Candidate {
        std::size_t index;
        double irradiance;
    };
    std::vector<Candidate> candidates;
    double all = 0.0;
    for (std::size_t g = 0; g < ghosts.size(); ++g) {
        const GhostSpot& ghost = ghosts[g];
        if (!reaches_sensor(ghost, sensor_width_mm, sensor_height_mm)) continue;
        all += ghost.flux();
        const auto [narrow, broad] = ghost.sigmas_mm();
        if (narrow >= narrowest_folded * sensor_width_mm)
            candidates.push_back({g, ghost.flux() / (4.0 * std::numbers::pi * narrow * broad)});
    }
    std::ranges::stable_sort(candidates, {}, &Candidate::irradiance);
    std::vector<std::size_t> chosen;
    double sum = 0.0;
    for (const Candidate& candidate : candidates) {
        sum += ghosts[candidate.index].flux();
        if (sum > share * all) break;
        chosen.push_back(candidate.index);
    }
    return chosen;
}

void fold_ghosts(const GhostPlanner& planner, double share, std::vector<ProbedGhost>& ghosts) {
    if (!(share > 0.0)) return;
    std::vector<GhostSpot> spots;
    for (const ProbedGhost& ghost : ghosts)
        spots.push_back(ghost.planned.fate == GhostFate::drawn ? ghost.planned.spot : GhostSpot{});
    const PixelFrame& frame = planner.placement().frame();
    for (const std::size_t g : foldable(spots, share, frame.width_px * frame.pitch_mm,
                                        frame.height_px * frame.pitch_mm)) {
        ghosts[g].planned.fate = GhostFate::folded;
        ghosts[g].planned.spot = planner.spot(ghosts[g]);
    }
}

std::vector<GhostSpot> folded_spots(const FlarePlan& plan) {
    std::vector<GhostSpot> spots;
    for (const PlannedGhost& ghost : plan.ghosts)
        if (ghost.fate == GhostFate::folded) spots.push_back(ghost.spot);
    return spots;
}

}  // namespace ghostlight
