#include "core/fit/fit_run.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "core/elapsed.h"
#include "core/error.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// Places and geometry are linearised again until they move by less than this, in priors.
constexpr double settled = 0.02;
constexpr int most_linearisations = 4;
constexpr double field_step_deg = 0.02;
constexpr double geometry_step = 0.3;  ///< of a prior
/// First guesses for all λ0 together, nm.
constexpr std::array<double, 5> alike_nm = {550.0, 490.0, 620.0, 440.0, 690.0};
constexpr int start_iterations = 8, final_iterations = 30, jump_iterations = 4;
/// A jump must lower the cost by so much to be more than rounding.
constexpr double least_gain = 0.5;

}  // namespace

std::vector<double> FitRun::picture_of(const FittedLens& lens, std::size_t photo,
                                       const LightDirection& light, bool main_only) {
    const FittedLens whole = with_coatings(lens);
    FitScene scene = fit_scene(whole, request_.spectrum, request_.spectral_samples);
    scene.ghosts = scene_->ghosts;
    const FitView& view = views_[photo];
    const auto bases =
        ghost_bases(scene, light, view.data.frame, view.place, main_only, request_.threads, stop_);
    check_stop();
    std::vector<const GhostBasis*> all;
    for (const GhostBasis& basis : bases) {
        all.push_back(&basis);
        report_.rays += basis.traced;
    }
    const GhostWeights weights(scene, all, {}, request_.threads);
    return ghost_picture(bases, weights, view.data.frame, 0, false, request_.threads).values;
}

void FitRun::linearise() {
    weights_->update(evaluator_->coating_values(), false);
    const FittedLens now = current_geometry();
    for (std::size_t i = 0; i < views_.size(); ++i) {
        FitView& view = views_[i];
        view.slopes.clear();
        for (std::size_t q = 0; q < layout_.geometry.size(); ++q) {
            const FitParameter& p = layout_.geometry[q];
            auto moved = [&](double by) {
                FittedLens lens = listed_;
                for (std::size_t k = 0; k < layout_.geometry.size(); ++k) {
                    const FitParameter& each = layout_.geometry[k];
                    const double at =
                        evaluator_->x[layout_.coatings.size() + k] + (k == q ? by : 0.0);
                    set(lens, each, each.start + each.prior * at);
                }
                return picture_of(lens, i, view.light, true);
            };
            auto more = moved(geometry_step), less = moved(-geometry_step);
            for (std::size_t k = 0; k < more.size(); ++k)
                more[k] = (more[k] - less[k]) / (2.0 * geometry_step);
            view.slopes.push_back(std::move(more));
            check_stop();
            (void)p;
        }
        if (!layout_.place) continue;
        std::array<std::vector<double>, 3> place;
        for (auto& each : place) each.assign(3 * view.data.samples(), 0.0);
        // In a fixed order, whatever the number of threads: ghosts in parts, then summed.
        const std::size_t parts = std::min<std::size_t>(16, view.bases.size());
        std::vector<std::array<std::vector<double>, 3>> partial(parts);
        parallel_for(parts, request_.threads, stop_, [&](std::size_t part) {
            for (auto& each : partial[part]) each.assign(3 * view.data.samples(), 0.0);
            std::vector<double> coefficients;
            for (std::size_t g = part; g < view.bases.size(); g += parts) {
                weights_->coefficients(view.bases[g], coefficients, nullptr);
                add_place_slopes(*scene_, view.bases[g], view.light, view.data.frame, view.place,
                                 coefficients, partial[part]);
            }
        });
        check_stop();
        for (const auto& each : partial)
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t s = 0; s < place[k].size(); ++s) place[k][s] += each[k][s];
        const double units[3] = {shift_prior_mm, shift_prior_mm, rotation_prior_rad};
        for (std::size_t k = 0; k < 3; ++k) {
            for (double& value : place[k]) value *= units[k];
            view.slopes.push_back(std::move(place[k]));
        }
        LightDirection more = view.light, less = view.light;
        more.field_deg += field_step_deg;
        less.field_deg -= field_step_deg;
        auto upper = picture_of(now, i, more, true), lower = picture_of(now, i, less, true);
        for (std::size_t k = 0; k < upper.size(); ++k)
            upper[k] = (upper[k] - lower[k]) * field_prior_deg / (2.0 * field_step_deg);
        view.slopes.push_back(std::move(upper));
    }
    evaluator_->linearised_at = evaluator_->x;
}

double FitRun::cost_now() {
    evaluator_->PrepareForEvaluation(false, true);
    const auto rho = make_loss(request_.loss, request_.loss_scale);
    double cost = 0.0;
    for (std::size_t i = 0; i < views_.size(); ++i)
        for (std::size_t s = 0; s < views_[i].data.samples(); ++s) {
            if (!views_[i].data.used[s]) continue;
            double squares = 0.0;
            for (std::size_t c = 0; c < 3; ++c)
                squares += std::pow(evaluator_->residuals(i)[3 * s + c], 2);
            double out[3] = {squares, 1.0, 0.0};
            if (rho) rho->Evaluate(squares, out);
            cost += 0.5 * out[0];
        }
    for (const double each : evaluator_->x) cost += 0.5 * each * each;
    return cost;
}

double FitRun::explained() {
    double left = 0.0, all = 0.0;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const FitView& view = views_[i];
        for (std::size_t s = 0; s < view.data.samples(); ++s) {
            if (!view.data.used[s]) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                left += std::pow(evaluator_->residuals(i)[3 * s + c], 2);
                all += std::pow(view.stable[3 * s + c], 2);
            }
        }
    }
    return all > 0.0 ? 1.0 - left / all : 0.0;
}

double FitRun::solve(int iterations) {
    check_stop();
    const auto problem = fit_problem(*evaluator_, request_.loss, request_.loss_scale);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = iterations;
    options.function_tolerance = 1e-8;
    options.parameter_tolerance = 1e-8;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    options.update_state_every_iteration = static_cast<bool>(request_.look);
    struct Watch final : ceres::IterationCallback {
        FitRun& fit;
        explicit Watch(FitRun& of) : fit(of) {}
        ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
            fit.cost_ = s.cost;
            fit.report_.cost_curve.push_back(s.cost);
            fit.tell(0.5);
            if (fit.request_.look) fit.show_look();
            return fit.stop_.stop_requested() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                              : ceres::SOLVER_CONTINUE;
        }
    } watch(*this);
    options.callbacks.push_back(&watch);
    ceres::Solver::Summary summary;
    const auto began = Clock::now();
    ceres::Solve(options, problem.get(), &summary);
    const int done = std::max(1, static_cast<int>(summary.iterations.size()) - 1);
    report_.iterations += done;
    report_.iteration_ms = ms_since(began) / done;
    // A failed solve has a cost of -1, which must not pass for the lowest.
    return summary.IsSolutionUsable() ? summary.final_cost
                                      : std::numeric_limits<double>::infinity();
}

void FitRun::solve_coatings() {
    // Reflectances come back as centres move: several starts, the lens's own first.
    std::mt19937_64 random(request_.seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const std::vector<double> own = evaluator_->x;
    std::vector<double> best = own, best_gains(views_.size(), 0.0);
    double lowest = std::numeric_limits<double>::infinity();
    const std::size_t count = layout_.coatings.size();
    for (int start = 0; start < std::max(1, request_.starts); ++start) {
        if (start > 0 && count == 0) break;
        evaluator_->x = own;
        for (std::size_t p = 0; p < count && start > 0; ++p) {
            const FitParameter& each = layout_.coatings[p];
            const double low = (each.lower - each.start) / each.prior,
                         high = (each.upper - each.start) / each.prior;
            // All λ0 alike, as one shop makes them, then each for itself.
            double to = 1.2 * uniform(random);
            if (each.kind == FitKind::center && start <= static_cast<int>(alike_nm.size()))
                to = (alike_nm[static_cast<std::size_t>(start) - 1] - each.start) / each.prior;
            evaluator_->x[p] = std::clamp(to, 0.95 * low, 0.95 * high);
        }
        evaluator_->start_gains();
        const double cost = solve(start_iterations);
        if (cost < lowest) {
            lowest = cost;
            best = evaluator_->x;
            best_gains.clear();
            for (const FitView& view : views_) best_gains.push_back(view.log_gain_start);
        }
        check_stop();
        tell(0.1 + 0.4 * (start + 1) / std::max(1, request_.starts));
    }
    if (!std::isfinite(lowest))
        throw Error({.problem = "the fit found no finite picture of this lens",
                     .file = photos_.front().photo.file,
                     .where = "--vary",
                     .found = "values or slopes that are not numbers from every first guess",
                     .expected = "other bounds, or fewer variables"});
    evaluator_->x = best;
    for (std::size_t i = 0; i < views_.size(); ++i) views_[i].log_gain_start = best_gains[i];
    solve(final_iterations);
    for (int round = 0; round < 3; ++round) {
        if (!jump_centers()) break;
        solve(final_iterations);
    }
}

bool FitRun::jump_centers() {
    bool improved = false;
    double lowest = cost_now();
    std::vector<double> best = evaluator_->x;
    for (std::size_t p = 0; p < layout_.coatings.size(); ++p) {
        const FitParameter& each = layout_.coatings[p];
        if (each.kind != FitKind::center) continue;
        const double before = best[p];
        for (const double by_nm : {-100.0, -50.0, 50.0, 100.0}) {
            const double at = before + by_nm / each.prior;
            if (at * each.prior + each.start < each.lower ||
                at * each.prior + each.start > each.upper)
                continue;
            evaluator_->x = best;
            evaluator_->x[p] = at;
            evaluator_->fit_gains();
            const double cost = solve(jump_iterations);
            if (cost < lowest - least_gain) {
                lowest = cost;
                best = evaluator_->x;
                improved = true;
                break;
            }
        }
        check_stop();
    }
    evaluator_->x = best;
    return improved;
}

void FitRun::settle() {
    if (layout_.geometry.empty() && !layout_.place) return;
    for (int turn = 0; turn < most_linearisations; ++turn) {
        double moved = 0.0;
        for (std::size_t k = layout_.coatings.size(); k < layout_.count(); ++k)
            if (is_linearised(k))
                moved = std::max(moved, std::abs(evaluator_->x[k] - evaluator_->linearised_at[k]));
        build();
        evaluator_->linearised_at = evaluator_->x;
        if (turn > 0 && moved < settled) {
            solve(final_iterations);
            break;
        }
        linearise();
        solve(final_iterations);
        tell(0.6 + 0.1 * turn);
    }
}

bool FitRun::is_linearised(std::size_t k) const {
    if (k < layout_.lens_count()) return true;
    if (!layout_.place) return false;
    for (std::size_t i = 0; i < layout_.photos; ++i)
        if (k >= layout_.place_of(i) && k < layout_.place_of(i) + place_unknowns) return true;
    return false;
}

}  // namespace ghostlight
