#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/fit/fit_kinds.h"
#include "core/fit/fit_run.h"

namespace ghostlight {
namespace {

/// Where a new coating's own number begins, each descended from: λ0 in nm, others as factors.
constexpr std::array<double, 5> centers_nm = {550.0, 480.0, 620.0, 430.0, 690.0};
constexpr std::array<double, 5> factors = {1.0, 0.9, 1.1, 0.8, 1.2};
constexpr int kind_iterations = 12;
/// What is on one surface bears on what the others seem to have: round again, so often.
constexpr int most_rounds = 4;
/// Of a second surface whose kind changes together with another's.
constexpr std::size_t second_values = 3;
/// Kinds with less of the odds than this are excluded; one with more than this is taken for known.
constexpr double excluded_share = 0.01, known_share = 0.95;

/// The numbers of a coating that a fit may vary when nobody has said which.
std::vector<FitParameter> own_numbers(const Prescription& lens, std::size_t row) {
    const Coating& coating = lens.surfaces[row].coating;
    const char* kind = std::holds_alternative<QuarterWave>(coating)           ? "center"
                       : std::holds_alternative<LayerStack>(coating)          ? "thickness"
                       : std::holds_alternative<ConstantReflectance>(coating) ? "reflectance"
                                                                              : nullptr;
    if (kind == nullptr) return {};
    return parse_vary(fmt::format("{}@{}", kind, row + 1), lens);
}

/// Whether two coatings are one kind: the same but for what fits vary.
bool same_kind(const Coating& a, const Coating& b) {
    if (a.index() != b.index()) return false;
    if (const auto* one = std::get_if<QuarterWave>(&a))
        return one->layer == std::get<QuarterWave>(b).layer;
    return std::holds_alternative<ConstantReflectance>(a) || a == b;
}

bool is_on(const FitParameter& parameter, std::size_t row) {
    return std::ranges::find(parameter.rows, row) != parameter.rows.end();
}

}  // namespace

std::vector<std::pair<std::size_t, double>> FitRun::kind_rows() {
    std::vector<double> light(listed_.lens.surfaces.size(), 0.0);
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const auto found = signals(i);
        for (std::size_t g = 0; g < found.size(); ++g)
            for (const FilmEvent& event : views_[i].bases[g].events)
                if (event.reflects && event.surface < light.size())
                    light[event.surface] += found[g] * found[g];
    }
    std::vector<std::pair<std::size_t, double>> rows;
    for (std::size_t row = 0; row < light.size(); ++row) {
        bool shared = false, varied = false;
        for (const FitParameter& each : layout_.coatings) {
            if (!is_on(each, row)) continue;
            varied = true;
            shared = shared || each.rows.size() > 1;
        }
        const bool wanted =
            request_.kind_rows.empty()
                ? varied
                : std::ranges::find(request_.kind_rows, row) != request_.kind_rows.end();
        // One common number of several surfaces is one shop's coating: it is not taken apart.
        if (wanted && !shared && light[row] > 0.0) rows.emplace_back(row, std::sqrt(light[row]));
    }
    std::ranges::stable_sort(rows, std::ranges::greater{}, &std::pair<std::size_t, double>::second);
    return rows;
}

double FitRun::KindSearch::misfit() const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [choice, trial] : tried) least = std::min(least, trial.cost);
    // Where no kind fits, differences of cost say less.
    return std::max(1.0, 2.0 * least / values);
}

double FitRun::KindSearch::bic(const KindTrial& trial) const {
    return 2.0 * trial.cost / misfit() +
           static_cast<double>(trial.layout.coatings.size()) * std::log(values);
}

bool FitRun::KindSearch::is_better(const KindChoice& a, const KindChoice& b) const {
    constexpr double least_gain = 0.1;
    return bic(tried.at(a)) < bic(tried.at(b)) - least_gain;
}

FitRun::KindSearch FitRun::kind_search() {
    KindSearch search;
    std::size_t samples = 0;
    for (const FitView& view : views_) samples += view.data.count;
    // Costs are those of every second sample each way, which share next to no noise.
    search.values = 3.0 * static_cast<double>(samples) / 4.0;
    for (const auto& [row, light] : kind_rows()) {
        KindSurface& surface =
            search.surfaces.emplace_back(KindSurface{row, light, request_.kinds});
        const Coating& listed = listed_.lens.surfaces[row].coating;
        const auto at = std::ranges::find_if(surface.kinds, [&](const CoatingKind& each) {
            return same_kind(each.coating, listed);
        });
        search.now.push_back(static_cast<std::size_t>(at - surface.kinds.begin()));
        if (at == surface.kinds.end())
            surface.kinds.push_back({"as listed", listed});
        else
            at->coating = listed;  // its own number and layer
    }
    search.best = search.now;
    return search;
}

FitRun::KindTrial FitRun::with_kinds(const KindSearch& search, const KindChoice& choice) {
    KindTrial trial{
        .choice = choice, .coatings = {}, .layout = layout_, .x = {}, .log_gains = {}, .cost = 0.0};
    FitScene scene = *scene_;
    std::vector<std::size_t> changed;
    std::vector<FitParameter> own;
    std::vector<std::size_t> own_surface;
    for (std::size_t k = 0; k < choice.size(); ++k) {
        const std::size_t row = search.surfaces[k].row;
        Coating& coating = scene.lens.lens.surfaces[row].coating;
        if (choice[k] != search.now[k]) {
            coating = search.surfaces[k].kinds[choice[k]].coating;
            changed.push_back(row);
            Prescription lens = listed_.lens;
            lens.surfaces[row].coating = coating;
            std::vector<FitParameter> its;
            // As it was asked for, where that can be said of this coating.
            for (const FitParameter& each : request_.vary)
                if (each.rows == std::vector{row} && is_coating(each.kind) &&
                    value_in(lens, each.kind, row, each.layer))
                    its.push_back(each);
            if (its.empty()) its = own_numbers(lens, row);
            own.insert(own.end(), its.begin(), its.end());
            own_surface.insert(own_surface.end(), its.size(), changed.size() - 1);
        }
        trial.coatings.push_back(coating);
    }
    trial.layout.coatings.clear();
    for (std::size_t p = 0; p < layout_.coatings.size(); ++p) {
        if (std::ranges::any_of(changed,
                                [&](std::size_t row) { return is_on(layout_.coatings[p], row); }))
            continue;
        trial.layout.coatings.push_back(layout_.coatings[p]);
        trial.x.push_back(evaluator_->x[p]);
    }
    const std::size_t first_own = trial.x.size();
    trial.layout.coatings.insert(trial.layout.coatings.end(), own.begin(), own.end());
    trial.x.resize(first_own + own.size(), 0.0);
    trial.x.insert(trial.x.end(),
                   evaluator_->x.begin() + static_cast<std::ptrdiff_t>(layout_.coatings.size()),
                   evaluator_->x.end());
    std::vector<const GhostBasis*> all;
    for (const FitView& view : views_)
        for (const GhostBasis& basis : view.bases) all.push_back(&basis);
    const GhostWeights weights(scene, all, trial.layout.coatings, request_.threads);
    CoatingSearch descents(trial.layout, views_, weights, request_.loss, request_.loss_scale,
                           request_.threads);
    std::vector<std::vector<double>> points = {trial.x};
    // One surface at each value; two at each pair of some; more all alike.
    const std::size_t others = changed.size() == 2 ? second_values : 1;
    const std::size_t firsts = changed.size() == 2 ? second_values : factors.size();
    for (std::size_t a = 0; a < firsts && !own.empty(); ++a)
        for (std::size_t b = 0; b < others; ++b) {
            std::vector<double> x = trial.x;
            for (std::size_t q = 0; q < own.size(); ++q) {
                const FitParameter& each = own[q];
                const std::size_t k = changed.size() == 2 && own_surface[q] == 1 ? b : a;
                const double value =
                    each.kind == FitKind::center ? centers_nm[k] : factors[k] * each.start;
                if (value > each.lower && value < each.upper)
                    x[first_own + q] = (value - each.start) / each.prior;
            }
            if (x != trial.x) points.push_back(std::move(x));
        }
    const auto found = descents.descend_all(points, kind_iterations, stop_);
    check_stop();
    report_.iterations += descents.iterations();
    const FitMinimum& best = *std::ranges::min_element(found, {}, &FitMinimum::cost);
    trial.x = best.x;
    trial.log_gains = best.log_gains;
    trial.cost = best.cost;
    tell(share_);
    return trial;
}

void FitRun::try_kinds(KindSearch& search, const KindChoice& choice) {
    if (search.tried.contains(choice)) return;
    search.tried[choice] = with_kinds(search, choice);
}

void FitRun::take_kinds(KindSearch& search, const KindChoice& choice) {
    const KindTrial& trial = search.tried.at(choice);
    // What was linearised stays so: only the coatings' part of the unknowns changes.
    std::vector<double> at(trial.layout.coatings.size(), 0.0);
    at.insert(
        at.end(),
        evaluator_->linearised_at.begin() + static_cast<std::ptrdiff_t>(layout_.coatings.size()),
        evaluator_->linearised_at.end());
    layout_ = trial.layout;
    for (std::size_t k = 0; k < choice.size(); ++k) {
        const std::size_t row = search.surfaces[k].row;
        listed_.lens.surfaces[row].coating = trial.coatings[k];
        scene_->lens.lens.surfaces[row].coating = trial.coatings[k];
    }
    refresh();
    stand_at({.x = trial.x, .log_gains = trial.log_gains, .cost = trial.cost});
    evaluator_->linearised_at = at;
    search.now = choice;
    show_search();
    if (search.is_better(choice, search.best)) search.best = choice;
}

void FitRun::improve_kinds(KindSearch& search) {
    const std::size_t count = search.surfaces.size();
    // The best of some choices, if it is better than where the search stands.
    auto go_to_best_of = [&](const std::vector<KindChoice>& choices) {
        KindChoice best = search.now;
        for (const KindChoice& each : choices) {
            try_kinds(search, each);
            if (search.is_better(each, best)) best = each;
        }
        if (best == search.now) return false;
        take_kinds(search, best);
        return true;
    };
    for (int round = 0; round < most_rounds; ++round) {
        bool moved = false;
        for (std::size_t k = 0; k < count; ++k) {
            std::vector<KindChoice> choices;
            for (std::size_t kind = 0; kind < search.surfaces[k].kinds.size(); ++kind) {
                if (kind == search.now[k]) continue;
                choices.push_back(search.now);
                choices.back()[k] = kind;
            }
            moved = go_to_best_of(choices) || moved;
        }
        if (moved) continue;
        // Two surfaces that share their ghosts can stand for each other.
        std::vector<KindChoice> exchanged;
        for (std::size_t a = 0; a < count; ++a)
            for (std::size_t b = 0; b < a; ++b) {
                if (search.now[a] == search.now[b] ||
                    std::max(search.now[a], search.now[b]) >= request_.kinds.size())
                    continue;
                exchanged.push_back(search.now);
                std::swap(exchanged.back()[a], exchanged.back()[b]);
            }
        if (!go_to_best_of(exchanged)) return;
    }
}

void FitRun::report_kinds(const KindSearch& search) {
    report_.kinds.clear();
    const double lowest = search.bic(search.tried.at(search.best));
    double all = 0.0, least = std::numeric_limits<double>::infinity();
    for (const auto& [choice, trial] : search.tried) {
        all += std::exp(-0.5 * (search.bic(trial) - lowest));
        least = std::min(least, trial.cost);
    }
    for (std::size_t k = 0; k < search.surfaces.size(); ++k) {
        const KindSurface& of = search.surfaces[k];
        SurfaceKinds& surface =
            report_.kinds.emplace_back(SurfaceKinds{of.row, of.signal_to_noise, {}});
        for (std::size_t kind = 0; kind < of.kinds.size(); ++kind) {
            KindTried told{.name = of.kinds[kind].name,
                           .numbers = 0,
                           .chi2_above = 0.0,
                           .bic_above = std::numeric_limits<double>::infinity(),
                           .share = 0.0};
            for (const auto& [choice, trial] : search.tried) {
                if (choice[k] != kind) continue;
                const double above = search.bic(trial) - lowest;
                told.share += std::exp(-0.5 * above) / all;
                if (above >= told.bic_above) continue;
                told.bic_above = above;
                told.chi2_above = 2.0 * (trial.cost - least) / search.misfit();
                told.numbers = static_cast<std::size_t>(std::ranges::count_if(
                    trial.layout.coatings,
                    [&](const FitParameter& each) { return is_on(each, of.row); }));
            }
            if (std::isfinite(told.bic_above)) surface.tried.push_back(std::move(told));
        }
        std::ranges::stable_sort(surface.tried, std::ranges::greater{}, &KindTried::share);
        std::string others;
        for (std::size_t n = 1; n < surface.tried.size(); ++n)
            if (surface.tried[n].share > excluded_share)
                others += fmt::format("{}{} ({:.2g} % of the odds)", others.empty() ? "" : ", ",
                                      surface.tried[n].name, 100.0 * surface.tried[n].share);
        report_.remarks.push_back(fmt::format(
            "Coating of surface {}: {}, {:.3g} % of the odds of {} combinations of kinds that were "
            "tried{}.",
            of.row + 1, surface.tried.front().name, 100.0 * surface.tried.front().share,
            search.tried.size(),
            surface.tried.front().share < known_share ? "; not told from " + others
            : surface.tried.size() > 1
                ? fmt::format(", {} next with a BIC {:.3g} higher", surface.tried[1].name,
                              surface.tried[1].bic_above)
                : ""));
    }
}

bool FitRun::choose_kinds() {
    KindSearch search = kind_search();
    if (search.surfaces.empty()) return false;
    const KindChoice listed = search.now;
    try_kinds(search, search.now);
    take_kinds(search, search.now);
    improve_kinds(search);
    // From elsewhere: all surfaces of one kind, as one shop may have coated them.
    for (std::size_t kind = 0; kind < request_.kinds.size() && listed.size() > 1; ++kind) {
        const KindChoice alike(listed.size(), kind);
        try_kinds(search, alike);
        take_kinds(search, alike);
        improve_kinds(search);
    }
    take_kinds(search, search.best);
    report_kinds(search);
    return search.best != listed;
}

}  // namespace ghostlight
