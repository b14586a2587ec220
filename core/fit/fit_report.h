#pragma once

#include <Eigen/Dense>

#include "core/fit/coating_search.h"
#include "core/fit/fit_evaluator.h"
#include "core/fit/flare_fit.h"

namespace ghostlight {

/// A fit that has come to its end, for its report.
struct FitOutcome {
    const FitLayout& layout;
    const std::vector<FitParameter>& not_felt;
    FitEvaluator& evaluator;            ///< with residuals, models and Jacobians there
    const Eigen::MatrixXd& covariance;  ///< of all unknowns, in units of their priors
    const Eigen::VectorXd& start_errors;
    /// Besides the one taken; their costs are χ² above its own.
    const std::vector<FitMinimum>& other_minima;
    double loss_scale = 4.0;
};

/// χ², outliers and by how much errors are widened; must come first, which fill_numbers() sees to.
void fill_misfit(const FitOutcome& outcome, FitReport& report);
void fill_numbers(const FitOutcome& outcome, FitReport& report);
void fill_photo(const FitOutcome& outcome, std::size_t photo, FitReport& report);
/// `before`: as given; `listed`: with the kinds of coating that were chosen, numbers at their
/// starts.
void fill_bands(const FitOutcome& outcome, const Prescription& before, const Prescription& listed,
                const Prescription& after, FitReport& report);
/// The verdict in words, and whether the lens explains the photographs.
void judge(const FitOutcome& outcome, FitReport& report);

double focal_length_mm(const OpticalSystem& system);

}  // namespace ghostlight
