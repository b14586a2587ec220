#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/flare/accuracy.h"

namespace ghostlight {

/// A frame to be timed.
struct AccuracyTrial {
    std::string method, knob;
    double setting = std::numeric_limits<double>::quiet_NaN();
    bool is_ablation = false;
    /// Makes what is kept between frames, and gives what draws one.
    std::function<std::function<std::optional<FlareImage>()>()> prepare;
};

// Where something else is varied.
inline constexpr int usual_trial_grid = 64;
inline constexpr double usual_trial_tolerance = 0.01;

/// All settings of all methods, one family a method, cheapest first in each, so that a budget cuts
/// off the dearest. Lens and request must outlive the trials.
std::vector<std::vector<AccuracyTrial>> accuracy_trials(const Prescription& lens,
                                                        const AccuracyRequest& request,
                                                        std::stop_token stop);

}  // namespace ghostlight
