#include "core/fit/fit_evaluator.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {
namespace {

bool all_finite(const double* values, std::size_t count) {
    return std::all_of(values, values + count, [](double each) { return std::isfinite(each); });
}

/// The three residuals of a sample.
class SampleCost final : public ceres::CostFunction {
   public:
    SampleCost(const FitEvaluator& evaluator, std::size_t photo, std::size_t sample,
               std::size_t count)
        : evaluator_(evaluator), photo_(photo), sample_(sample), count_(count) {
        set_num_residuals(3);
        mutable_parameter_block_sizes()->push_back(static_cast<int>(count));
    }
    bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
        if (evaluator_.stopped()) return false;
        const double* from = &evaluator_.residuals(photo_)[3 * sample_];
        std::copy(from, from + 3, residuals);
        // Refused here, a point that is no number is stepped back from without a word on stderr.
        if (!all_finite(residuals, 3)) return false;
        if (jacobians != nullptr && jacobians[0] != nullptr) {
            const double* by = &evaluator_.jacobian(photo_)[3 * sample_ * count_];
            std::copy(by, by + 3 * count_, jacobians[0]);
            return all_finite(by, 3 * count_);
        }
        return true;
    }

   private:
    const FitEvaluator& evaluator_;
    std::size_t photo_, sample_, count_;
};

/// x itself: it is in units of the priors.
class PriorCost final : public ceres::CostFunction {
   public:
    explicit PriorCost(int count) {
        set_num_residuals(count);
        mutable_parameter_block_sizes()->push_back(count);
    }
    bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
        const int count = num_residuals();
        std::copy(x[0], x[0] + count, residuals);
        if (jacobians != nullptr && jacobians[0] != nullptr) {
            std::fill(jacobians[0], jacobians[0] + count * count, 0.0);
            for (int i = 0; i < count; ++i) jacobians[0][i * count + i] = 1.0;
        }
        return true;
    }
};

}  // namespace

FitEvaluator::FitEvaluator(const FitLayout& layout, std::vector<FitView>& views,
                           GhostWeights& weights, unsigned threads)
    : x(layout.count(), 0.0),
      linearised_at(layout.count(), 0.0),
      layout_(layout),
      views_(views),
      weights_(weights),
      threads_(threads),
      residuals_(views.size()),
      jacobians_(views.size()),
      models_(views.size()),
      pictures_(views.size()) {}

void FitEvaluator::set_weights(GhostWeights& weights) {
    weights_ = weights;
    pictured_at_.reset();
}

std::vector<double> FitEvaluator::coating_values() const {
    std::vector<double> values;
    for (std::size_t p = 0; p < layout_.coatings.size(); ++p)
        values.push_back(layout_.coatings[p].start + layout_.coatings[p].prior * x[p]);
    return values;
}

double FitEvaluator::gain(std::size_t photo, std::size_t channel) const {
    const double* own = &x[layout_.first_of(photo)];
    // Green's is the exposure; red and blue are balanced against it.
    const double balance = channel == 1 ? 0.0 : balance_prior * own[channel];
    return std::exp(views_[photo].log_gain_start + gain_prior * own[1] + balance);
}

void FitEvaluator::picture(bool slopes) {
    const std::vector<double> values = coating_values();
    if (values == pictured_at_ && (pictured_slopes_ || !slopes)) return;
    pictured_at_.reset();
    if (weights_.get().update(values, slopes, stop_))
        for (std::size_t i = 0; i < views_.size(); ++i)
            pictures_[i] = ghost_picture(views_[i].bases, weights_.get(), views_[i].data.frame,
                                         layout_.coatings.size(), slopes, threads_, stop_);
    stopped_ = stop_.stop_requested();
    if (stopped_) return;
    pictured_at_ = values;
    pictured_slopes_ = slopes;
}

void FitEvaluator::start_gains() {
    for (std::size_t i = 0; i < views_.size(); ++i) x[layout_.first_of(i) + 1] = 0.0;
    fit_gains();
    for (std::size_t i = 0; i < views_.size(); ++i) {
        double& exposure = x[layout_.first_of(i) + 1];
        views_[i].log_gain_start += gain_prior * exposure;
        exposure = 0.0;
    }
}

void FitEvaluator::fit_gains() {
    picture(false);
    if (stopped_) return;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        FitView& view = views_[i];
        double log_gain[3];
        for (std::size_t c = 0; c < 3; ++c) {
            double above = 0.0, below = 0.0;
            for (std::size_t s = 0; s < view.data.samples(); ++s) {
                if (!view.data.used[s]) continue;
                const double y = view.data.value[3 * s + c], m = *pictures_[i].at(s, c);
                const double sigma = view.scales[s].sigma(y);
                above += y * m / (sigma * sigma);
                below += m * m / (sigma * sigma);
            }
            log_gain[c] = below > 0.0 && above > 0.0 ? std::log(above / below) : 0.0;
        }
        double* own = &x[layout_.first_of(i)];
        own[1] = (log_gain[1] - view.log_gain_start) / gain_prior;
        own[0] = (log_gain[0] - log_gain[1]) / balance_prior;
        own[2] = (log_gain[2] - log_gain[1]) / balance_prior;
    }
}

void FitEvaluator::PrepareForEvaluation(bool jacobians, bool) {
    picture(jacobians);
    if (stopped_) return;
    const std::size_t count = layout_.count(), coatings = layout_.coatings.size(),
                      geometry = layout_.geometry.size();
    for (std::size_t i = 0; i < views_.size(); ++i) {
        FitView& view = views_[i];
        const ModelPicture& picture = pictures_[i];
        const std::size_t samples = view.data.samples();
        residuals_[i].assign(3 * samples, 0.0);
        models_[i].assign(3 * samples, 0.0);
        if (jacobians) jacobians_[i].assign(3 * samples * count, 0.0);
        const std::size_t first = layout_.first_of(i), place = layout_.place_of(i);
        // The moves since the slopes were worked out.
        std::vector<double> moves(view.slopes.size(), 0.0);
        for (std::size_t q = 0; q < view.slopes.size(); ++q) {
            const std::size_t at = q < geometry ? coatings + q : place + q - geometry;
            moves[q] = x[at] - linearised_at[at];
        }
        const double gains[3] = {gain(i, 0), gain(i, 1), gain(i, 2)};
        const double shade = layout_.shading ? shading_prior * x[layout_.shading_of(i)] : 0.0;
        for (std::size_t s = 0; s < samples; ++s) {
            if (!view.data.used[s]) continue;
            const double r2 = corner_distance2(view.data.frame, s);
            const auto polynomials = background_functions(view.data.frame, s);
            for (std::size_t c = 0; c < 3; ++c) {
                const double* from = picture.at(s, c);
                double light = from[0];
                for (std::size_t q = 0; q < moves.size(); ++q)
                    light += moves[q] * view.slopes[q][3 * s + c];
                const double scale = gains[c] * (1.0 - shade * r2);
                double value = scale * light;
                for (int t = 0; t < layout_.background_terms; ++t)
                    value += view.background_unit *
                             x[layout_.background_of(i) + 3 * static_cast<std::size_t>(t) + c] *
                             background_prior * polynomials[static_cast<std::size_t>(t)];
                models_[i][3 * s + c] = value;
                residuals_[i][3 * s + c] = view.scales[s].at(value) - view.stable[3 * s + c];
                if (!jacobians) continue;
                const double inverse = 1.0 / view.scales[s].sigma(value);
                double* row = &jacobians_[i][(3 * s + c) * count];
                for (std::size_t p = 0; p < coatings; ++p)
                    row[p] = inverse * scale * from[1 + p] * layout_.coatings[p].prior;
                for (std::size_t q = 0; q < moves.size(); ++q)
                    row[q < geometry ? coatings + q : place + q - geometry] =
                        inverse * scale * view.slopes[q][3 * s + c];
                row[first + 1] = inverse * scale * light * gain_prior;
                if (c != 1) row[first + c] = inverse * scale * light * balance_prior;
                if (layout_.shading)
                    row[layout_.shading_of(i)] = -inverse * gains[c] * light * r2 * shading_prior;
                for (int t = 0; t < layout_.background_terms; ++t)
                    row[layout_.background_of(i) + 3 * static_cast<std::size_t>(t) + c] =
                        inverse * view.background_unit * background_prior *
                        polynomials[static_cast<std::size_t>(t)];
            }
        }
    }
}

std::unique_ptr<ceres::LossFunction> make_loss(FitLoss loss, double scale) {
    switch (loss) {
        case FitLoss::none:
            return nullptr;
        case FitLoss::huber:
            return std::make_unique<ceres::HuberLoss>(scale);
        case FitLoss::cauchy:
            return std::make_unique<ceres::CauchyLoss>(scale);
        case FitLoss::tukey:
            return std::make_unique<ceres::TukeyLoss>(scale);
    }
    return nullptr;
}

std::unique_ptr<ceres::Problem> fit_problem(FitEvaluator& evaluator, FitLoss loss, double scale) {
    ceres::Problem::Options options;
    options.evaluation_callback = &evaluator;
    auto problem = std::make_unique<ceres::Problem>(options);
    const FitLayout& layout = evaluator.layout();
    const std::size_t count = layout.count();
    problem->AddParameterBlock(evaluator.x.data(), static_cast<int>(count));
    // One loss for all samples: the problem owns each loss once.
    ceres::LossFunction* shared = make_loss(loss, scale).release();
    for (std::size_t i = 0; i < evaluator.views().size(); ++i) {
        const FitData& data = evaluator.views()[i].data;
        for (std::size_t s = 0; s < data.samples(); ++s)
            if (data.used[s])
                problem->AddResidualBlock(new SampleCost(evaluator, i, s, count), shared,
                                          evaluator.x.data());
    }
    problem->AddResidualBlock(new PriorCost(static_cast<int>(count)), nullptr, evaluator.x.data());
    auto bound = [&](const FitParameter& p, std::size_t at) {
        problem->SetParameterLowerBound(evaluator.x.data(), static_cast<int>(at),
                                        (p.lower - p.start) / p.prior);
        problem->SetParameterUpperBound(evaluator.x.data(), static_cast<int>(at),
                                        (p.upper - p.start) / p.prior);
    };
    for (std::size_t p = 0; p < layout.coatings.size(); ++p) bound(layout.coatings[p], p);
    for (std::size_t q = 0; q < layout.geometry.size(); ++q)
        bound(layout.geometry[q], layout.coatings.size() + q);
    return problem;
}

}  // namespace ghostlight
