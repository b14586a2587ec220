#pragma once

#include <Eigen/Dense>

#include <stop_token>
#include <vector>

#include "core/fit/fit_evaluator.h"

namespace ghostlight {

/// Of a sample: how well the model's points and chords place a ghost, and its rim.
inline constexpr double place_error = 0.02;

/// Information of the photographs at the evaluator's last point, in units of the priors.
struct FitInformation {
    Eigen::MatrixXd hessian;  ///< Jᵀ W J + 1, W the loss's weights
    /// Jᵀ √W C √W J + 1 with C the true covariance of the residuals: neighbouring samples share
    /// pixels, and each ghost's light may be off as a whole by `ghost_error`.
    Eigen::MatrixXd spread;
};
/// Needs PrepareForEvaluation(true, …) before. When stopped, what comes back is no information.
FitInformation information(const FitEvaluator& evaluator, FitLoss loss, double loss_scale,
                           double ghost_error, const std::stop_token& stop = {});

/// By how much the difference of two pictures' χ² scatters beyond that of independent samples:
/// δᵀ C δ / δᵀ δ, δ the difference of their residuals (3 a sample, by photograph), C the covariance
/// of the residuals with noise that neighbours share and ghosts' light that is off as a whole. The
/// evaluator stands at one of the two.
double scatter_of_difference(const FitEvaluator& evaluator,
                             const std::vector<std::vector<double>>& difference,
                             double ghost_error);

/// H⁻¹ M H⁻¹: the covariance of the estimate (White 1980), priors as further data.
Eigen::MatrixXd covariance_of(const FitInformation& information);

/// The same with H⁻¹ given, as Ceres' Covariance has it.
Eigen::MatrixXd covariance_of(const FitInformation& information, const Eigen::MatrixXd& inverse);

/// What the photographs say of the first `count` unknowns when the others are unknown too: the
/// Schur complement of the data's part of the Hessian, correlated noise allowed for by scaling it
/// to the covariance's own diagonal. Its eigenvectors are the directions, its eigenvalues λ say
/// that a direction's standard error is 1/√(1 + λ) of its prior's.
struct Directions {
    Eigen::VectorXd narrowed;  ///< ascending information: the least known first, share of the prior
    Eigen::MatrixXd vectors;   ///< in units of the priors, columns
};
Directions directions(const Eigen::MatrixXd& covariance, std::size_t count);

/// min |A g − b| with g ≥ 0 (Lawson and Hanson 1974), A by its normal equations AᵀA and Aᵀb.
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& normal,
                                           const Eigen::VectorXd& right);

}  // namespace ghostlight
