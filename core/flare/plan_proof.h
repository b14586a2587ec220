#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/flare_plan.h"
#include "core/flare/flare_scene.h"
#include "core/ghosts/pupil_proof.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// What a plan's ghost can have lost.
struct GhostProof {
    GhostPath path;
    bool certified = false;  ///< the bound is within the ghost's share of what may be missed
    PupilProof proof;        ///< of the geometry wavelength where the bound is largest
    double missed_flux_bound_mm2() const { return proof.missed_flux_bound_mm2; }
};

/// What all of a plan's ghosts can have lost outside their boxes, on the sensor, over E0.
struct PlanProof {
    std::vector<GhostProof> ghosts;  ///< in the plan's order
    std::size_t certified = 0;
    double missed_flux_bound_mm2 = 0.0;  ///< sum over the ghosts
    double flux_mm2 = 0.0;               ///< of the plan
    double seconds = 0.0;
    /// Of the plan's flux; infinite when that is 0 and something may be missed.
    double missed_share() const;
};

struct PlanProofRequest {
    double missed_share = 1e-3;     ///< of the plan's flux; shared out among its ghosts evenly
    std::size_t most_cells = 1000;  ///< of a ghost at one wavelength
    unsigned threads = 0;           ///< 0 = all cores; the result does not depend on it
};

/// Proves a plan made for this scene and light: ghosts drawn, folded or left out are dark outside
/// their boxes, those through which nothing passes dark everywhere, those off the sensor send no
/// light to it. For every wavelength at which the scene's geometry is traced. What is left out
/// inside its box is FlarePlan::left_out_mm2. Returns nothing when stopped; `progress` is called
/// from any thread with the share done.
std::optional<PlanProof> certify(const FlareScene& scene, const LightDirection& light,
                                 const FlarePlan& plan, const PlanProofRequest& request = {},
                                 std::stop_token stop = {},
                                 const std::function<void(double)>& progress = {});

}  // namespace ghostlight
