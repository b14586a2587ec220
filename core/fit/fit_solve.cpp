#include "core/fit/fit_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>

#include "core/elapsed.h"
#include "core/error.h"
#include "core/fit/fit_descent.h"
#include "core/fit/picture_slopes.h"

namespace ghostlight {
namespace {

/// Places and geometry are linearised again until they move by less than this, in priors.
constexpr double settled = 0.02;
/// Of a prior, to either side: numbers that a lens is compiled into are smooth, and this keeps what
/// is left out (its square) and what rounding leaves below 1e-6.
constexpr double move_step = 1e-3;
/// By which the cost may rise from one linearisation to the next: other points, other rounding.
constexpr double most_worse = 2.0;
constexpr int most_halvings = 4;
/// First guesses for all λ0 together, nm.
constexpr std::array<double, 5> alike_nm = {550.0, 490.0, 620.0, 440.0, 690.0};
constexpr int start_iterations = 10, final_iterations = 100, jump_iterations = 40;
/// Minima whose χ² is higher by more than this are excluded: their odds are 1 : 400.
constexpr double most_chi2_above = 12.0;
constexpr std::size_t most_minima = 5;

}  // namespace

LensMoves FitRun::moves_of(std::size_t photo) const {
    const FitView& view = views_[photo];
    LensMoves all;
    all.film_now = compiled_films(*scene_, with_coatings(current_geometry()).lens);
    for (std::size_t q = 0; q < layout_.geometry.size(); ++q)
        all.moves.push_back(lens_move(*scene_, with_coatings(geometry_moved(q, -move_step)),
                                      with_coatings(geometry_moved(q, move_step)), view.light,
                                      2.0 * move_step));
    if (layout_.place) {
        LightDirection less = view.light, more = view.light;
        less.field_deg -= move_step * field_prior_deg;
        more.field_deg += move_step * field_prior_deg;
        all.moves.push_back(light_move(*scene_, less, more, 2.0 * move_step));
    }
    return all;
}

void FitRun::linearise() {
    weights_->update(evaluator_->coating_values(), false);
    const std::size_t geometry = layout_.geometry.size();
    for (std::size_t i = 0; i < views_.size(); ++i) {
        FitView& view = views_[i];
        view.slopes.clear();
        if (geometry == 0 && !layout_.place) continue;
        const LensMoves moves = moves_of(i);
        const ModelPicture by =
            picture_slopes(*scene_, view.bases, *weights_, view.light, view.data.frame, view.place,
                           moves, request_.threads, stop_);
        check_stop();
        auto take = [&](std::size_t column, double unit) {
            std::vector<double>& to = view.slopes.emplace_back(3 * view.data.samples());
            for (std::size_t k = 0; k < to.size(); ++k)
                to[k] = unit * by.values[k * by.columns + column];
        };
        for (std::size_t q = 0; q < geometry; ++q) take(place_slopes + q, 1.0);
        if (!layout_.place) continue;
        take(0, shift_prior_mm);
        take(1, shift_prior_mm);
        take(2, rotation_prior_rad);
        take(place_slopes + geometry, 1.0);
    }
    evaluator_->linearised_at = evaluator_->x;
}

double FitRun::cost_now() { return cost_of(*evaluator_, request_.loss, request_.loss_scale); }

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
    const auto began = Clock::now();
    const Descent descent = descend(
        *evaluator_, request_.loss, request_.loss_scale, iterations,
        [&](double cost) {
            cost_ = cost;
            report_.cost_curve.push_back(cost);
            tell(share_);
            if (request_.look) show_look();
            return !stop_.stop_requested();
        },
        DescentAim::minimum);
    report_.iterations += descent.iterations;
    report_.iteration_ms = ms_since(began) / descent.iterations;
    check_stop();
    return descent.cost;
}

void FitRun::stand_at(const FitMinimum& minimum) {
    evaluator_->x = minimum.x;
    for (std::size_t i = 0; i < views_.size(); ++i) views_[i].log_gain_start = minimum.log_gains[i];
}

void FitRun::show_search() {
    if (request_.look) {
        cost_ = cost_now();
        check_stop();
        report_.cost_curve.push_back(cost_);
        show_look();
    }
    tell(share_);
}

FitMinimum FitRun::standing() const {
    FitMinimum minimum{.x = evaluator_->x, .log_gains = {}, .cost = cost_};
    for (const FitView& view : views_) minimum.log_gains.push_back(view.log_gain_start);
    return minimum;
}

void FitRun::solve_coatings() {
    // Reflectances come back as centres move: several starts, the lens's own first.
    std::mt19937_64 random(request_.seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const std::size_t count = layout_.coatings.size();
    std::vector<std::vector<double>> points = {evaluator_->x};
    for (int start = 1; start < request_.starts && count > 0; ++start) {
        std::vector<double>& x = points.emplace_back(evaluator_->x);
        for (std::size_t p = 0; p < count; ++p) {
            const FitParameter& each = layout_.coatings[p];
            const double low = (each.lower - each.start) / each.prior,
                         high = (each.upper - each.start) / each.prior;
            // All λ0 alike, as one shop makes them, then each for itself.
            double to = 1.2 * uniform(random);
            if (each.kind == FitKind::center && start <= static_cast<int>(alike_nm.size()))
                to = (alike_nm[static_cast<std::size_t>(start) - 1] - each.start) / each.prior;
            x[p] = std::clamp(to, 0.95 * low, 0.95 * high);
        }
    }
    CoatingSearch search(layout_, views_, *weights_, request_.loss, request_.loss_scale,
                         request_.threads);
    const auto found = search.descend_all(points, start_iterations, stop_);
    check_stop();
    report_.iterations += search.iterations();
    const FitMinimum& best = *std::ranges::min_element(found, {}, &FitMinimum::cost);
    if (!std::isfinite(best.cost))
        throw Error({.problem = "the fit found no finite picture of this lens",
                     .file = photos_.front().photo.file,
                     .where = "what is varied",
                     .found = "values or slopes that are not numbers from every first guess",
                     .expected = "other bounds, or fewer variables"});
    stand_at(best);
    solve(final_iterations);
}

bool FitRun::explore_coatings() {
    if (request_.starts < 2 || layout_.coatings.empty()) return false;
    const std::vector<double> before = evaluator_->x;
    CoatingSearch search(layout_, views_, *weights_, request_.loss, request_.loss_scale,
                         request_.threads);
    // Where the model does not fit, differences of cost say less.
    std::size_t samples = 0;
    for (const FitView& view : views_) samples += view.data.count;
    const double misfit = std::max(1.0, 2.0 * cost_now() / (3.0 * static_cast<double>(samples)));
    const auto found =
        search.explore(standing(), most_chi2_above * misfit, stop_, [&](const FitMinimum& best) {
            stand_at(best);
            show_search();
        });
    check_stop();
    report_.iterations += search.iterations();
    // On all samples. The difference of two costs scatters more than for independent samples: noise
    // is shared, and ghosts may be off as a whole.
    struct Tried {
        FitMinimum minimum;
        std::vector<std::vector<double>> residuals;
    };
    std::vector<Tried> minima;
    for (const FitMinimum& each : found) {
        if (minima.size() == most_minima) break;
        stand_at(each);
        const double cost = solve(jump_iterations);
        Tried& tried = minima.emplace_back(Tried{standing(), {}});
        tried.minimum.cost = cost;
        evaluator_->PrepareForEvaluation(false, true);
        check_stop();
        for (std::size_t i = 0; i < views_.size(); ++i)
            tried.residuals.push_back(evaluator_->residuals(i));
    }
    std::ranges::stable_sort(minima, {}, [](const Tried& each) { return each.minimum.cost; });
    const Tried& best = minima.front();
    stand_at(best.minimum);
    evaluator_->PrepareForEvaluation(true, true);
    other_minima_.clear();
    for (std::size_t k = 1; k < minima.size(); ++k) {
        check_stop();
        if (search.alike(minima[k].minimum.x, best.minimum.x)) continue;
        auto difference = minima[k].residuals;
        for (std::size_t i = 0; i < difference.size(); ++i)
            for (std::size_t r = 0; r < difference[i].size(); ++r)
                difference[i][r] -= best.residuals[i][r];
        FitMinimum& other = other_minima_.emplace_back(minima[k].minimum);
        other.cost = 2.0 * (other.cost - best.minimum.cost) /
                     scatter_of_difference(*evaluator_, difference, request_.ghost_error);
    }
    std::ranges::stable_sort(other_minima_, {}, &FitMinimum::cost);
    solve(final_iterations);
    double moved = 0.0;
    for (std::size_t p = 0; p < layout_.coatings.size(); ++p)
        moved = std::max(moved, std::abs(evaluator_->x[p] - before[p]));
    return moved > settled;
}

void FitRun::settle(int most_linearisations) {
    if (layout_.geometry.empty() && !layout_.place) return;
    std::optional<FitMinimum> best;
    int halvings = 0;
    for (int turn = 0; turn < most_linearisations; ++turn) {
        double moved = 0.0;
        for (std::size_t k = layout_.coatings.size(); k < layout_.count(); ++k)
            if (is_linearised(k))
                moved = std::max(moved, std::abs(evaluator_->x[k] - evaluator_->linearised_at[k]));
        build();
        evaluator_->linearised_at = evaluator_->x;
        // What a straight model promises may not be so: half of the way, while it is not.
        const double cost = cost_now();
        check_stop();
        if (best && cost > best->cost + most_worse && halvings < most_halvings) {
            ++halvings;
            --turn;
            for (std::size_t k = 0; k < evaluator_->x.size(); ++k)
                evaluator_->x[k] = std::midpoint(evaluator_->x[k], best->x[k]);
            continue;
        }
        halvings = 0;
        cost_ = cost;
        best = standing();
        if (turn > 0 && moved < settled) {
            solve(final_iterations);
            return;
        }
        linearise();
        solve(final_iterations);
        tell(share_);
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
