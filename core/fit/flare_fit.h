#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/fit/fit_data.h"
#include "core/fit/fit_parameters.h"
#include "core/fit/photo.h"
#include "core/flare/spectrum.h"
#include "core/optics/prescription.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// A photograph, where its pixels are, and where its light comes from.
struct FitPhoto {
    Photo photo;
    PhotoPlace place;
    LightDirection light;
};

/// How far samples that the model cannot explain count. ρ(s) of Ceres' losses, s the sum of the
/// squares of a sample's three residuals.
enum class FitLoss { none, huber, cauchy, tukey };
std::string name(FitLoss loss);

struct FitLook;

/// A kind of coating that a surface may have: its λ0 (or thickness, or reflectance) is fitted.
struct CoatingKind {
    std::string name;
    Coating coating;
};

struct FitRequest {
    Spectrum spectrum = StandardLight{};
    std::vector<FitParameter> vary;
    FitLoss loss = FitLoss::cauchy;
    double loss_scale = 4.0;  ///< in standard deviations of a sample
    /// Of the model, relative, of each sample: what is left of quadratures.
    double model_error = 0.003;
    /// Of the model, relative, of each ghost's light in each channel as a whole: spectral sampling,
    /// polarisation over the pupil, and a camera whose responses are no matrix of the CIE curves.
    double ghost_error = 0.004;
    int across = 96;            ///< samples over the sensor's width
    int spectral_samples = 11;  ///< of weights
    int background_terms = 3;   ///< 0, 1, 3 or 6 polynomials a channel
    bool fit_place = true;      ///< shift, rotation, and the light's field
    bool fit_shading = true;
    int starts = 6;                     ///< first guesses of the coatings, the lens's own first
    std::vector<std::string> left_out;  ///< ghosts by name that do not count
    /// To choose from on each surface, the strongest first; empty: kinds stay as they are listed.
    std::vector<CoatingKind> kinds = {};
    std::vector<std::size_t> kind_rows = {};  ///< where, from 0; empty: where coatings are varied
    /// Numbers of `vary` whose profile likelihood is wanted.
    std::vector<std::size_t> profiled = {};
    int bootstrap = 0;            ///< photographs drawn from the fitted model, 0: none
    std::size_t suggestions = 0;  ///< light angles tried for the next photograph
    std::uint64_t seed = 1;
    unsigned threads = 0;
    /// Called after every iteration, on the fit's thread; may wait, which pauses the fit.
    std::function<void(const FitLook&)> look = {};
    /// Told which part of the work begins, in words, on the fit's thread.
    std::function<void(const std::string&)> stage = {};
};

/// How well a number is known.
enum class FitKnowledge {
    determined,  ///< the photographs narrow its prior to less than a half
    weak,        ///< narrowed, but by less
    prior,       ///< the photographs say next to nothing: its prior's width
    not_felt,    ///< held: no visible ghost feels it
    at_bound,    ///< ran into its bound: its error means little
};
std::string name(FitKnowledge knowledge);

struct FittedNumber {
    FitParameter parameter;
    double value = 0.0;
    double standard_error = 0.0;
    /// About the minimum that was taken, as if there were no other; what profiles and bootstraps
    /// are to be compared with.
    double own_error = 0.0;
    double low = 0.0, high = 0.0;  ///< 95 %: ± 1.96 standard errors, within the bounds
    double start_error = 0.0;      ///< expected at the start, from the Jacobian there
    FitKnowledge knowledge = FitKnowledge::prior;
    /// In other minima of the cost that explain the photographs nearly as well; the error allows
    /// for them, and the interval reaches to those whose share is more than 2.5 %.
    std::vector<double> other_values = {};
};

/// χ² against one number with all others fitted to it: intervals that need not be symmetric.
struct FittedProfile {
    std::size_t number = 0;
    std::vector<double> values, chi2;  ///< above the fit's own, rising values
    double low = 0.0, high = 0.0;      ///< where it is 3.84: 95 %; where looking ended, if before
};

/// A number in fits to photographs that were drawn from the fitted model and its errors.
struct BootstrappedNumber {
    std::size_t number = 0;
    double mean = 0.0, scatter = 0.0;
    double low = 0.0, high = 0.0;  ///< the middle 95 % of the draws
};

/// Another minimum of the cost that the photographs do not exclude.
struct OtherMinimum {
    double chi2_above = 0.0;  ///< by which its χ² is higher, of independent samples
    double share = 0.0;       ///< of the probability: exp(−χ²/2) over the sum of all
};

/// A combination of numbers that the photographs do not determine.
struct UnknownDirection {
    double narrowed = 1.0;                              ///< its standard error over its prior's
    std::vector<std::pair<std::size_t, double>> parts;  ///< number, share; largest first
};

/// One kind of coating on one surface, everything else fitted with it.
struct KindTried {
    std::string name;
    std::size_t numbers = 0;  ///< of the coating that are fitted
    double chi2_above = 0.0;  ///< by which χ² is higher than of the kind with the lowest
    double bic_above = 0.0;   ///< χ² + numbers × ln(values) over that of the best (Schwarz 1978)
    double share = 0.0;       ///< of the odds: exp(−BIC/2) over the sum of all
};
struct SurfaceKinds {
    std::size_t row = 0;
    double signal_to_noise = 0.0;  ///< of the ghosts that turn there
    std::vector<KindTried> tried;  ///< the best first
};

/// What one ghost does in the fit.
struct FittedGhost {
    std::string name;
    std::size_t photo = 0;
    double signal_to_noise = 0.0;  ///< √Σ (m/σ)² over its samples, after the fit
    double share_before = 0.0, share_after = 0.0;  ///< of the light on the samples
    /// Its light in the photograph over the model's, non-negative least squares on all ghosts
    /// together; NaN where it is merged with another.
    double gain_before = 1.0, gain_after = 1.0, gain_error = 0.0;
    std::string merged_with;  ///< a ghost whose picture it cannot be told from (overlap > 0.98)
};

/// A ghost that is not carried along, being below the noise.
struct LeftOutGhost {
    std::string name;
    std::size_t photo = 0;
    /// Its signal to noise is not above this, even where its coatings are six times as bright as at
    /// the start.
    double at_most = 0.0;
};

/// R of a coated surface that was varied, light from the air's side, normal incidence.
struct ReflectanceBand {
    std::size_t row = 0;
    std::vector<double> wavelengths_nm, before, after, error;
};

struct FittedPhoto {
    std::string file;
    LightDirection light;                        ///< as given or found
    double field_deg = 0.0;                      ///< as fitted
    std::array<double, 3> gain{}, gain_error{};  ///< of the channels; errors relative
    double shading = 0.0;
    double shift_x_mm = 0.0, shift_y_mm = 0.0, rotation_deg = 0.0;
    std::size_t samples = 0;
    double chi2 = 0.0;  ///< Σ residual², 3 × samples expected
    /// On the fit's scale: photograph, model before and after, residuals in σ; 3 a sample.
    PixelFrame frame;
    std::vector<char> used;
    std::vector<double> measured, before, after, residuals;
};

struct Suggestion {
    LightDirection light;
    std::size_t number = 0;  ///< the worst known number now
    double error_now = 0.0, error_then = 0.0;
};

struct FitReport {
    std::vector<FittedNumber> numbers;
    std::vector<FittedProfile> profiles;        ///< those asked for
    std::vector<BootstrappedNumber> bootstrap;  ///< empty where none was asked for
    FitLoss loss = FitLoss::cauchy;             ///< and its scale, standard deviations of a sample
    double loss_scale = 4.0;
    std::vector<double> correlation;  ///< numbers × numbers, of those not held
    std::vector<double> covariance;
    std::vector<UnknownDirection> unknown;
    std::vector<OtherMinimum> other_minima;  ///< the likeliest first
    std::size_t rank = 0;                    ///< directions that the photographs determine
    std::vector<SurfaceKinds> kinds;         ///< where kinds were chosen, the strongest first
    std::vector<FittedGhost> ghosts;         ///< visible ones, strongest first
    std::size_t ghosts_left_out = 0;
    double left_out_signal_to_noise = 0.0;  ///< of all of those together, at the start
    std::vector<LeftOutGhost> left_out;     ///< those, strongest first
    std::vector<ReflectanceBand> bands;
    std::vector<FittedPhoto> photos;
    std::vector<double> histogram;  ///< of residuals in σ: shares of bins of 0.5 from −5 to 5
    double chi2 = 0.0, cost_before = 0.0, cost_after = 0.0;
    std::size_t residuals = 0;
    double explained_before = 0.0, explained_after = 0.0;  ///< share of Σ (y/σ)²
    double outliers = 0.0;     ///< share of samples beyond the loss's scale
    double error_scale = 1.0;  ///< by which errors were widened for the misfit
    std::vector<double> cost_curve;
    int iterations = 0;
    std::size_t rays = 0;
    FittedLens lens;
    bool usable = false;  ///< the lens explains the photographs
    std::string verdict;  ///< in words
    std::vector<std::string> remarks;
    std::vector<Suggestion> suggestions;
    double seconds = 0.0, iteration_ms = 0.0, basis_ms = 0.0;
};

/// A fit as it stands while it goes on.
struct FitLook {
    double cost = 0.0;
    std::vector<FittedNumber> numbers;  ///< values alone, of those that are felt
    FittedLens lens;
    std::vector<FittedPhoto> photos;  ///< frame, used, measured and after alone
};

using FitProgress = std::function<void(double share, double cost)>;

/// Fits a lens to photographs of its flare. Deterministic for a seed, the same for any number of
/// threads. Throws Error where there is nothing to fit: no ghost visible, more numbers than data.
/// Nothing when stopped before there is a first result.
std::optional<FitReport> fit_flare(const Prescription& lens, const std::vector<FitPhoto>& photos,
                                   const FitRequest& request, std::stop_token stop = {},
                                   const FitProgress& progress = {});

}  // namespace ghostlight
