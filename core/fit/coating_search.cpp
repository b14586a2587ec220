#include "core/fit/coating_search.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "core/fit/fit_descent.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// Where else to try a λ0, nm: R of a quarter wave rises to either side of λ0, so that the other
/// branch of a colour is some 50 to 150 nm away.
constexpr std::array<double, 4> elsewhere_nm = {-100.0, -50.0, 50.0, 100.0};
/// By which two λ0 are moved against each other.
constexpr double against_nm = 60.0;
/// Two λ0 closer than this exchange nothing.
constexpr double exchanged_nm = 10.0;
constexpr int step = 2;  ///< of thinning
/// Successive halving: iterations of all neighbours, of the better ones, of the best.
constexpr int first_iterations = 2, second_iterations = 4, last_iterations = 12;
constexpr std::size_t second_count = 12, last_count = 4;
/// A better minimum must be lower by so much to be more than what iterations leave.
constexpr double least_gain = 0.25;
constexpr int most_rounds = 4;
/// Minima are the same when all λ0 agree to this share of their priors.
constexpr double same = 0.06;
constexpr std::size_t most_pairs = 36, most_workers = 8;

}  // namespace

FitView thinned(const FitView& view, int by) {
    const PixelFrame& full = view.data.frame;
    FitView thin;
    thin.light = view.light;
    thin.place = view.place;
    thin.background_unit = view.background_unit;
    thin.log_gain_start = view.log_gain_start;
    thin.curve_error = view.curve_error;
    thin.data.noise = view.data.noise;
    // The samples are points of the sensor, as before; only their number changes.
    auto count = [by](int all) { return (all + by - 1) / by; };
    thin.data.frame = full;
    thin.data.frame.width_px = count(full.width_px);
    thin.data.frame.height_px = count(full.height_px);
    thin.data.frame.pitch_mm = full.pitch_mm * by;
    thin.slopes.resize(view.slopes.size());
    for (int row = 0; row < full.height_px; row += by)
        for (int column = 0; column < full.width_px; column += by) {
            const auto s = static_cast<std::size_t>(row * full.width_px + column);
            thin.data.used.push_back(view.data.used[s]);
            thin.data.count += view.data.used[s] ? 1U : 0U;
            thin.data.inverse_count.push_back(view.data.inverse_count[s]);
            thin.scales.push_back(view.scales[s]);
            for (std::size_t c = 0; c < 3; ++c) {
                thin.data.value.push_back(view.data.value[3 * s + c]);
                thin.stable.push_back(view.stable[3 * s + c]);
                for (std::size_t q = 0; q < view.slopes.size(); ++q)
                    thin.slopes[q].push_back(view.slopes[q][3 * s + c]);
            }
        }
    for (const GhostBasis& basis : view.bases) {
        GhostBasis& few = thin.bases.emplace_back(basis);
        few.first_column = count(basis.first_column);
        few.first_row = count(basis.first_row);
        few.columns = count(basis.first_column + basis.columns) - few.first_column;
        few.rows = count(basis.first_row + basis.rows) - few.first_row;
        few.values.clear();
        for (int row = few.first_row; row < few.first_row + few.rows; ++row)
            for (int column = few.first_column; column < few.first_column + few.columns; ++column) {
                const float* from = basis.at(by * column, by * row);
                few.values.insert(few.values.end(), from, from + basis.width());
            }
    }
    std::erase_if(thin.bases, [](const GhostBasis& basis) { return basis.values.empty(); });
    return thin;
}

CoatingSearch::CoatingSearch(const FitLayout& layout, const std::vector<FitView>& views,
                             const GhostWeights& weights, FitLoss loss, double loss_scale,
                             unsigned threads)
    : layout_(layout), weights_(weights), loss_(loss), loss_scale_(loss_scale), threads_(threads) {
    for (const FitView& view : views) views_.push_back(thinned(view, step));
}

std::vector<FitMinimum> CoatingSearch::descend_all(const std::vector<std::vector<double>>& points,
                                                   int iterations, const std::stop_token& stop) {
    std::vector<FitMinimum> found(points.size());
    const std::size_t workers =
        std::clamp<std::size_t>(threads_ == 0 ? default_thread_count() : threads_, 1,
                                std::max<std::size_t>(1, std::min(most_workers, points.size())));
    std::vector<int> spent(points.size(), 0);
    // Each worker has tables and photographs of its own and takes the next point that is left.
    std::atomic<std::size_t> next{0};
    parallel_for(workers, threads_, stop, [&](std::size_t) {
        std::vector<FitView> views = views_;
        GhostWeights weights = weights_;
        for (std::size_t k = next++; k < points.size(); k = next++) {
            if (stop.stop_requested()) return;
            // One evaluator a point: nothing of another point may be left in it.
            for (std::size_t i = 0; i < views.size(); ++i)
                views[i].log_gain_start = views_[i].log_gain_start;
            FitEvaluator evaluator(layout_, views, weights, 1);
            evaluator.set_stop(stop);
            evaluator.x = points[k];
            evaluator.start_gains();
            const Descent descent = descend(evaluator, loss_, loss_scale_, iterations,
                                            [&](double) { return !stop.stop_requested(); });
            found[k] = {.x = evaluator.x, .log_gains = {}, .cost = descent.cost};
            for (const FitView& view : views) found[k].log_gains.push_back(view.log_gain_start);
            spent[k] = descent.iterations;
        }
    });
    for (const int each : spent) iterations_ += each;
    return found;
}

std::vector<std::vector<double>> CoatingSearch::neighbours(const std::vector<double>& x) const {
    std::vector<std::vector<double>> points;
    std::vector<std::size_t> centers;
    for (std::size_t p = 0; p < layout_.coatings.size(); ++p)
        if (layout_.coatings[p].kind == FitKind::center) centers.push_back(p);
    auto value = [&](std::size_t p) {
        return layout_.coatings[p].start + layout_.coatings[p].prior * x[p];
    };
    auto inside = [&](std::size_t p, double nm) {
        return nm >= layout_.coatings[p].lower && nm <= layout_.coatings[p].upper;
    };
    auto unit = [&](std::size_t p, double nm) {
        return (nm - layout_.coatings[p].start) / layout_.coatings[p].prior;
    };
    for (const std::size_t p : centers)
        for (const double by : elsewhere_nm)
            if (inside(p, value(p) + by)) {
                points.push_back(x);
                points.back()[p] = unit(p, value(p) + by);
            }
    // Pairs whose λ0 differ most have most to exchange.
    std::vector<std::array<std::size_t, 2>> pairs;
    for (std::size_t i = 0; i < centers.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) pairs.push_back({centers[k], centers[i]});
    std::ranges::stable_sort(pairs, std::ranges::greater{}, [&](const auto& pair) {
        return std::abs(value(pair[0]) - value(pair[1]));
    });
    if (pairs.size() > most_pairs) pairs.resize(most_pairs);
    for (const auto& [a, b] : pairs) {
        auto add = [&, a = a, b = b](double at_a, double at_b) {
            if (!inside(a, at_a) || !inside(b, at_b)) return;
            points.push_back(x);
            points.back()[a] = unit(a, at_a);
            points.back()[b] = unit(b, at_b);
        };
        if (std::abs(value(a) - value(b)) > exchanged_nm) add(value(b), value(a));
        add(value(a) + against_nm, value(b) - against_nm);
        add(value(a) - against_nm, value(b) + against_nm);
    }
    return points;
}

bool CoatingSearch::alike(const std::vector<double>& a, const std::vector<double>& b) const {
    for (std::size_t p = 0; p < layout_.coatings.size(); ++p)
        if (std::abs(a[p] - b[p]) > same) return false;
    return true;
}

std::vector<FitMinimum> CoatingSearch::explore(const FitMinimum& from, double margin,
                                               const std::stop_token& stop,
                                               const std::function<void(const FitMinimum&)>& tell) {
    FitMinimum best = descend_all({from.x}, last_iterations, stop).front();
    // What was stopped has no points to compare.
    if (stop.stop_requested()) return {from};
    std::vector<FitMinimum> others;
    auto by_cost = [](const FitMinimum& m) { return m.cost; };
    auto points_of = [](const std::vector<FitMinimum>& minima) {
        std::vector<std::vector<double>> points;
        for (const FitMinimum& each : minima) points.push_back(each.x);
        return points;
    };
    for (int round = 0; round < most_rounds && !stop.stop_requested(); ++round) {
        auto found = descend_all(neighbours(best.x), first_iterations, stop);
        if (stop.stop_requested()) return {best};
        for (const auto& [count, iterations] :
             {std::pair{second_count, second_iterations}, std::pair{last_count, last_iterations}}) {
            std::ranges::stable_sort(found, {}, by_cost);
            std::vector<FitMinimum> kept;
            // What has come back to where it started tells nothing.
            for (FitMinimum& each : found)
                if (kept.size() < count && !alike(each.x, best.x) &&
                    std::ranges::none_of(
                        kept, [&](const FitMinimum& other) { return alike(each.x, other.x); }))
                    kept.push_back(std::move(each));
            if (kept.empty()) {
                found.clear();
                break;
            }
            found = descend_all(points_of(kept), iterations, stop);
            if (stop.stop_requested()) return {best};
            const FitMinimum& lowest = *std::ranges::min_element(found, {}, by_cost);
            tell(lowest.cost < best.cost ? lowest : best);
        }
        std::ranges::stable_sort(found, {}, by_cost);
        others.insert(others.end(), found.begin(), found.end());
        if (found.empty() || !(found.front().cost < best.cost - least_gain)) break;
        others.push_back(best);
        best = found.front();
    }
    std::vector<FitMinimum> result = {best};
    std::ranges::stable_sort(others, {}, by_cost);
    for (FitMinimum& each : others)
        if (each.cost < best.cost + margin &&
            std::ranges::none_of(result, [&](const FitMinimum& m) { return alike(each.x, m.x); }))
            result.push_back(std::move(each));
    return result;
}

}  // namespace ghostlight
