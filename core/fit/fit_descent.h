#pragma once

#include <functional>

#include "core/fit/fit_evaluator.h"

namespace ghostlight {

/// What a descent is for: a place that is better, within few iterations (Levenberg and Marquardt),
/// or the minimum itself, whose place is a result (dogleg).
enum class DescentAim { better, minimum };

/// Iterations of Ceres' from where the evaluator stands.
struct Descent {
    /// At its end; infinite where it failed, which must not pass for the lowest.
    double cost = 0.0;
    int iterations = 0;
};
/// `go_on` is told each iteration's cost, and ends the descent by false. `held`: an unknown that
/// stays where it is; below 0 none does.
Descent descend(FitEvaluator& evaluator, FitLoss loss, double loss_scale, int iterations,
                const std::function<bool(double)>& go_on = {}, DescentAim aim = DescentAim::better,
                int held = -1);

/// Half of Σ ρ(squares of a sample's residuals), plus half of the priors' squares, there.
double cost_of(FitEvaluator& evaluator, FitLoss loss, double loss_scale);

}  // namespace ghostlight
