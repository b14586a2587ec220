#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"
#include "core/flare/plan_proof.h"

namespace ghostlight {

/// Something that a planned picture does not compute, or computes more simply.
struct Omission {
    std::string what, why;
    std::size_t ghosts = 0;
    /// What it can change in the ghost layer: L1 on the sensor over E0, mm²; none where nobody
    /// knows, or where it belongs to another layer.
    std::optional<double> bound_mm2;
    bool proven = false;  ///< else from the plan's own estimates, which are good to a factor of two
};

/// All of it, for one scene and light.
struct PlanReport {
    std::vector<Omission> omissions;
    double flux_mm2 = 0.0;    ///< of the ghost layer on the sensor
    double bound_mm2 = 0.0;   ///< sum of the bounds that are known, estimated ones too
    double proven_mm2 = 0.0;  ///< those of them that are proven
    double bound() const { return flux_mm2 > 0.0 ? bound_mm2 / flux_mm2 : 0.0; }
};

/// `request` is what the plan was made for. `proof` bounds the light that the search can have
/// missed; without it that is not bounded.
PlanReport plan_report(const FlareScene& scene, const FlareRequest& request, const FlarePlan& plan,
                       const PlanProof* proof = nullptr);

/// What the plan's own numbers say that its picture can be off by, over the light: bounds of what
/// is left out, and twice the estimates of the rest. What the search can have missed is not in it.
double bounded_error(const FlarePlan& plan);

/// A planned picture beside the reference.
struct MeasuredPlan {
    double error = 0.0;            ///< relative L1 of the picture
    double reference_error = 0.0;  ///< how far the reference's two pictures differ
    double reference_bound = 0.0;  ///< sum of its ghosts' differences
};
/// Returns nothing when stopped.
std::optional<MeasuredPlan> measure_plan(const Prescription& lens, const FlareRequest& request,
                                         const FlareImage& image, double reference_tolerance,
                                         std::stop_token stop = {},
                                         const std::function<void(double)>& progress = {});

}  // namespace ghostlight
