#pragma once

#include <ceres/ceres.h>

#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "core/fit/flare_fit.h"
#include "core/fit/photo_model.h"

namespace ghostlight {

/// One photograph inside of a fit.
struct FitView {
    FitData data;
    std::vector<double> stable;  ///< the data on their stable scale, 3 a sample
    std::vector<StableScale> scales;
    LightDirection light;  ///< as it stands, offset included
    FitPlace place;
    std::vector<GhostBasis> bases;
    /// ∂ picture / ∂ (geometry parameters in units of their priors, then the place's unknowns).
    std::vector<std::vector<double>> slopes;
    double background_unit = 1.0;  ///< a typical level: the unit of background coefficients
    double log_gain_start = 0.0;
    double curve_error = 0.0;  ///< of the photograph, see Photo::curve_error
};

/// Layout of the vector of unknowns, all in units of their priors about their starts: coatings,
/// geometry, then for each photograph gains, shading, background and place.
struct FitLayout {
    std::vector<FitParameter> coatings, geometry;
    std::size_t photos = 0;
    int background_terms = 0;
    bool shading = true, place = true;

    std::size_t lens_count() const { return coatings.size() + geometry.size(); }
    std::size_t photo_count() const {
        return 3 + (shading ? 1U : 0U) + 3 * static_cast<std::size_t>(background_terms) +
               (place ? place_unknowns : 0U);
    }
    std::size_t count() const { return lens_count() + photos * photo_count(); }
    std::size_t first_of(std::size_t photo) const { return lens_count() + photo * photo_count(); }
    std::size_t shading_of(std::size_t photo) const { return first_of(photo) + 3; }
    std::size_t background_of(std::size_t photo) const {
        return first_of(photo) + 3 + (shading ? 1U : 0U);
    }
    std::size_t place_of(std::size_t photo) const {
        return background_of(photo) + 3 * static_cast<std::size_t>(background_terms);
    }
};

/// Widths of the priors of what is not of the lens.
inline constexpr double gain_prior = 3.0;     ///< of ln exposure: nothing is known
inline constexpr double balance_prior = 0.7;  ///< of ln red/green and ln blue/green: a factor of 2
inline constexpr double shading_prior = 0.3;  ///< of the light in the corners
inline constexpr double background_prior = 1.0;  ///< in units of the typical level
inline constexpr double shift_prior_mm = 0.05;
inline constexpr double rotation_prior_rad = 0.0035;  ///< 0.2°
inline constexpr double field_prior_deg = 0.03;

/// Residuals and Jacobian of all photographs for Ceres: worked out once for each point, read
/// sample by sample.
class FitEvaluator final : public ceres::EvaluationCallback {
   public:
    FitEvaluator(const FitLayout& layout, std::vector<FitView>& views, GhostWeights& weights,
                 unsigned threads);

    std::vector<double> x;
    /// Where the geometry's and places' slopes hold.
    std::vector<double> linearised_at;

    /// Nothing is worked out any more once this is asked: every evaluation fails at once, which
    /// ends a solver that is under way.
    void set_stop(std::stop_token stop) { stop_ = std::move(stop); }
    bool stopped() const { return stopped_; }

    void PrepareForEvaluation(bool jacobians, bool new_point) override;

    const std::vector<double>& residuals(std::size_t photo) const { return residuals_[photo]; }
    const std::vector<double>& jacobian(std::size_t photo) const { return jacobians_[photo]; }
    /// The model's values after gains and background, 3 a sample.
    const std::vector<double>& model(std::size_t photo) const { return models_[photo]; }
    std::vector<double> coating_values() const;
    /// Gains by least squares for the coatings as they stand.
    void start_gains();
    /// The same without moving the prior's middle.
    void fit_gains();
    double gain(std::size_t photo, std::size_t channel) const;

    const FitLayout& layout() const { return layout_; }
    std::vector<FitView>& views() { return views_; }
    GhostWeights& weights() { return weights_; }
    void set_weights(GhostWeights& weights);

   private:
    FitLayout layout_;
    std::vector<FitView>& views_;
    std::reference_wrapper<GhostWeights> weights_;
    unsigned threads_;
    std::vector<std::vector<double>> residuals_, jacobians_, models_;
    std::vector<ModelPicture> pictures_;
    /// Coatings: a model without any to vary has a value, too.
    std::optional<std::vector<double>> pictured_at_;
    bool pictured_slopes_ = false;
    std::stop_token stop_;
    bool stopped_ = false;

    void picture(bool slopes);
};

/// The sample's loss.
std::unique_ptr<ceres::LossFunction> make_loss(FitLoss loss, double scale);

/// A problem with every used sample, the priors and the bounds.
std::unique_ptr<ceres::Problem> fit_problem(FitEvaluator& evaluator, FitLoss loss, double scale);

}  // namespace ghostlight
