#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/fit/fit_descent.h"
#include "core/fit/fit_run.h"
#include "core/fit/fit_statistics.h"

namespace ghostlight {
namespace {

/// Distances from the fit in standard errors, to either side.
constexpr std::array<double, 6> steps = {0.5, 1.0, 1.5, 2.0, 2.5, 3.0};
constexpr double chi2_of_95_percent = 3.841;
/// To the minimum, along valleys that bend: after 8 iterations of Levenberg and Marquardt's a
/// bootstrap's numbers had gone a third to two thirds of their way, and its scatter was as small.
constexpr int profile_iterations = 60, bootstrap_iterations = 80;

/// Where a curve of √χ² crosses the 95 % line, going outwards; the last value where it does not.
double crossing(const std::vector<double>& values, const std::vector<double>& chi2) {
    for (std::size_t k = 1; k < values.size(); ++k) {
        if (chi2[k] < chi2_of_95_percent) continue;
        const double a = std::sqrt(chi2[k - 1]), b = std::sqrt(chi2[k]);
        const double t = b > a ? (std::sqrt(chi2_of_95_percent) - a) / (b - a) : 1.0;
        return std::lerp(values[k - 1], values[k], std::clamp(t, 0.0, 1.0));
    }
    return values.back();
}

/// Noise of samples that share pixels: white on four pixels a sample each way, under the spline;
/// of variance 1. One channel.
std::vector<double> sample_noise(const PixelFrame& frame, std::mt19937_64& random) {
    constexpr int pixels = 4, reach = 2 * pixels;
    std::normal_distribution<double> normal;
    const int width = frame.width_px * pixels + 2 * reach,
              height = frame.height_px * pixels + 2 * reach;
    std::vector<double> fine(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (double& each : fine) each = normal(random);
    std::array<double, 2 * reach> weights{};
    double squares = 0.0;
    for (int k = 0; k < 2 * reach; ++k) {
        weights[static_cast<std::size_t>(k)] = spline((k + 0.5 - reach) / pixels);
        squares += std::pow(weights[static_cast<std::size_t>(k)], 2);
    }
    // Along rows, then along columns; a sample's middle lies between two pixels.
    std::vector<double> half(static_cast<std::size_t>(frame.width_px) *
                             static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y)
        for (int i = 0; i < frame.width_px; ++i) {
            double sum = 0.0;
            for (int k = 0; k < 2 * reach; ++k)
                sum += weights[static_cast<std::size_t>(k)] *
                       fine[static_cast<std::size_t>(y * width + i * pixels + pixels / 2 + k)];
            half[static_cast<std::size_t>(y * frame.width_px + i)] = sum;
        }
    std::vector<double> noise;
    for (int j = 0; j < frame.height_px; ++j)
        for (int i = 0; i < frame.width_px; ++i) {
            double sum = 0.0;
            for (int k = 0; k < 2 * reach; ++k)
                sum += weights[static_cast<std::size_t>(k)] *
                       half[static_cast<std::size_t>(
                           (j * pixels + pixels / 2 + k) * frame.width_px + i)];
            noise.push_back(sum / squares);
        }
    return noise;
}

}  // namespace

void FitRun::profile(FitReport& report) {
    if (request_.profiled.empty()) return;
    const FitMinimum best = standing();
    const double best_cost = cost_now();
    std::vector<std::vector<double>> best_residuals;
    for (std::size_t i = 0; i < views_.size(); ++i)
        best_residuals.push_back(evaluator_->residuals(i));
    for (std::size_t p = 0; p < layout_.lens_count(); ++p) {
        const FitParameter& parameter = report.numbers[p].parameter;
        if (std::ranges::none_of(request_.profiled,
                                 [&](std::size_t k) { return request_.vary[k] == parameter; }))
            continue;
        FittedProfile& profile = report.profiles.emplace_back();
        profile.number = p;
        const double error = report.numbers[p].own_error / parameter.prior;
        const double low = (parameter.lower - parameter.start) / parameter.prior,
                     high = (parameter.upper - parameter.start) / parameter.prior;
        for (const double side : {-1.0, 1.0}) {
            std::vector<double> values = {report.numbers[p].value}, chi2 = {0.0};
            stand_at(best);
            for (const double step : steps) {
                const double to = best.x[p] + side * step * error;
                if (to < low || to > high) break;
                evaluator_->x[p] = to;
                const double cost =
                    descend(
                        *evaluator_, request_.loss, request_.loss_scale, profile_iterations,
                        [&](double) { return !stop_.stop_requested(); }, DescentAim::minimum,
                        static_cast<int>(p))
                        .cost;
                check_stop();
                evaluator_->PrepareForEvaluation(false, true);
                auto difference = best_residuals;
                for (std::size_t i = 0; i < difference.size(); ++i)
                    for (std::size_t r = 0; r < difference[i].size(); ++r)
                        difference[i][r] = evaluator_->residuals(i)[r] - difference[i][r];
                values.push_back(parameter.start + parameter.prior * to);
                chi2.push_back(std::max(
                    0.0, 2.0 * (cost - best_cost) /
                             scatter_of_difference(*evaluator_, difference, request_.ghost_error) /
                             (report.error_scale * report.error_scale)));
            }
            (side < 0.0 ? profile.low : profile.high) = crossing(values, chi2);
            if (side < 0.0) {
                std::ranges::reverse(values);
                std::ranges::reverse(chi2);
            } else {
                values.erase(values.begin());
                chi2.erase(chi2.begin());
            }
            profile.values.insert(profile.values.end(), values.begin(), values.end());
            profile.chi2.insert(profile.chi2.end(), chi2.begin(), chi2.end());
        }
    }
    stand_at(best);
    evaluator_->PrepareForEvaluation(true, true);
}

void FitRun::bootstrap(FitReport& report) {
    if (request_.bootstrap <= 0) return;
    std::mt19937_64 random(request_.seed + 0x9e3779b97f4a7c15ULL);
    std::normal_distribution<double> normal;
    const FitMinimum best = standing();
    std::vector<std::vector<double>> measured, models;
    std::vector<std::vector<ModelPicture>> ghosts(views_.size());
    for (std::size_t i = 0; i < views_.size(); ++i) {
        measured.push_back(views_[i].stable);
        models.push_back(evaluator_->model(i));
        for (const GhostBasis& basis : views_[i].bases)
            ghosts[i].push_back(one_ghost(basis, *weights_, views_[i].data.frame));
        check_stop();
    }
    const std::size_t count = layout_.lens_count();
    std::vector<std::vector<double>> drawn(count);
    for (int draw = 0; draw < request_.bootstrap; ++draw) {
        check_stop();
        stand_at(best);
        for (std::size_t i = 0; i < views_.size(); ++i) {
            FitView& view = views_[i];
            std::vector<double> light = models[i];
            const double off = std::hypot(request_.ghost_error, view.curve_error);
            const auto width = static_cast<std::size_t>(view.data.frame.width_px),
                       height = static_cast<std::size_t>(view.data.frame.height_px);
            for (const ModelPicture& ghost : ghosts[i]) {
                // As the errors have it: places matter where geometry is fitted.
                const double place = layout_.geometry.empty() ? 0.0 : place_error;
                const double by_x = place * normal(random), by_y = place * normal(random);
                for (std::size_t c = 0; c < 3; ++c) {
                    const double by = off * normal(random), gain = evaluator_->gain(i, c);
                    for (std::size_t y = 1; y + 1 < height; ++y)
                        for (std::size_t x = 1; x + 1 < width; ++x) {
                            const std::size_t s = y * width + x;
                            light[3 * s + c] +=
                                gain *
                                (by * *ghost.at(s, c) +
                                 0.5 * by_x * (*ghost.at(s + 1, c) - *ghost.at(s - 1, c)) +
                                 0.5 * by_y * (*ghost.at(s + width, c) - *ghost.at(s - width, c)));
                        }
                }
            }
            for (std::size_t c = 0; c < 3; ++c) {
                const auto noise = sample_noise(view.data.frame, random);
                for (std::size_t s = 0; s < view.data.samples(); ++s) {
                    const double value = light[3 * s + c];
                    view.stable[3 * s + c] =
                        view.scales[s].at(value) + report.error_scale * noise[s];
                }
            }
        }
        descend(
            *evaluator_, request_.loss, request_.loss_scale, bootstrap_iterations,
            [&](double) { return !stop_.stop_requested(); }, DescentAim::minimum);
        check_stop();
        for (std::size_t p = 0; p < count; ++p) {
            const FitParameter& each = report.numbers[p].parameter;
            drawn[p].push_back(each.start + each.prior * evaluator_->x[p]);
        }
    }
    for (std::size_t i = 0; i < views_.size(); ++i) views_[i].stable = measured[i];
    stand_at(best);
    evaluator_->PrepareForEvaluation(true, true);
    for (std::size_t p = 0; p < count; ++p) {
        std::ranges::sort(drawn[p]);
        BootstrappedNumber& number = report.bootstrap.emplace_back();
        number.number = p;
        double sum = 0.0, squares = 0.0;
        for (const double each : drawn[p]) sum += each;
        const double mean = sum / static_cast<double>(drawn[p].size());
        for (const double each : drawn[p]) squares += (each - mean) * (each - mean);
        number.mean = mean;
        number.scatter =
            std::sqrt(squares / std::max<double>(1.0, static_cast<double>(drawn[p].size()) - 1.0));
        auto quantile = [&](double share) {
            const double at = share * (static_cast<double>(drawn[p].size()) - 1.0);
            const auto k = static_cast<std::size_t>(at);
            return std::lerp(drawn[p][k], drawn[p][std::min(k + 1, drawn[p].size() - 1)],
                             at - static_cast<double>(k));
        };
        number.low = quantile(0.025);
        number.high = quantile(0.975);
    }
}

}  // namespace ghostlight
