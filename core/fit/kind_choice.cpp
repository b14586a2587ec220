#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/fit/fit_run.h"

namespace ghostlight {
namespace {

/// Where a new coating's own number begins, each descended from: λ0 in nm, others as factors.
constexpr std::array<double, 5> centers_nm = {550.0, 480.0, 620.0, 430.0, 690.0};
constexpr std::array<double, 5> factors = {1.0, 0.9, 1.1, 0.8, 1.2};
constexpr int kind_iterations = 12;
/// A second time round, since what is on one surface bears on what the others seem to have.
constexpr int most_rounds = 2;
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

FitRun::KindTrial FitRun::with_kind(std::size_t row, const Coating* coating) {
    KindTrial trial{.coating = listed_.lens.surfaces[row].coating,
                    .layout = layout_,
                    .x = {},
                    .log_gains = {},
                    .cost = 0.0,
                    .numbers = 0};
    std::vector<FitParameter> own;
    std::vector<double> own_x;
    if (coating != nullptr) {
        trial.coating = *coating;
        Prescription lens = listed_.lens;
        lens.surfaces[row].coating = *coating;
        own = own_numbers(lens, row);
        own_x.assign(own.size(), 0.0);
    }
    trial.layout.coatings.clear();
    for (std::size_t p = 0; p < layout_.coatings.size(); ++p) {
        if (coating != nullptr && is_on(layout_.coatings[p], row)) continue;
        trial.layout.coatings.push_back(layout_.coatings[p]);
        trial.x.push_back(evaluator_->x[p]);
    }
    const std::size_t first_own = trial.x.size();
    trial.layout.coatings.insert(trial.layout.coatings.end(), own.begin(), own.end());
    trial.x.insert(trial.x.end(), own_x.begin(), own_x.end());
    trial.x.insert(trial.x.end(),
                   evaluator_->x.begin() + static_cast<std::ptrdiff_t>(layout_.coatings.size()),
                   evaluator_->x.end());
    FitScene scene = *scene_;
    scene.lens.lens.surfaces[row].coating = trial.coating;
    std::vector<const GhostBasis*> all;
    for (const FitView& view : views_)
        for (const GhostBasis& basis : view.bases) all.push_back(&basis);
    const GhostWeights weights(scene, all, trial.layout.coatings, request_.threads);
    CoatingSearch search(trial.layout, views_, weights, request_.loss, request_.loss_scale,
                         request_.threads);
    std::vector<std::vector<double>> points = {trial.x};
    for (std::size_t p = first_own; p < trial.layout.coatings.size(); ++p) {
        const FitParameter& each = trial.layout.coatings[p];
        for (std::size_t k = 0; k < factors.size(); ++k) {
            const double value =
                each.kind == FitKind::center ? centers_nm[k] : factors[k] * each.start;
            if (value <= each.lower || value >= each.upper || value == each.start) continue;
            points.push_back(trial.x);
            points.back()[p] = (value - each.start) / each.prior;
        }
    }
    const auto found = search.descend_all(points, kind_iterations, stop_);
    check_stop();
    report_.iterations += search.iterations();
    const FitMinimum& best = *std::ranges::min_element(found, {}, &FitMinimum::cost);
    trial.x = best.x;
    trial.log_gains = best.log_gains;
    trial.cost = best.cost;
    for (const FitParameter& each : trial.layout.coatings) trial.numbers += is_on(each, row);
    return trial;
}

void FitRun::take_kind(std::size_t row, const KindTrial& trial) {
    // What was linearised stays so: only the coatings' part of the unknowns changes.
    std::vector<double> at(trial.layout.coatings.size(), 0.0);
    at.insert(
        at.end(),
        evaluator_->linearised_at.begin() + static_cast<std::ptrdiff_t>(layout_.coatings.size()),
        evaluator_->linearised_at.end());
    layout_ = trial.layout;
    listed_.lens.surfaces[row].coating = trial.coating;
    scene_->lens.lens.surfaces[row].coating = trial.coating;
    refresh();
    stand_at({.x = trial.x, .log_gains = trial.log_gains, .cost = trial.cost});
    evaluator_->linearised_at = at;
}

bool FitRun::choose_kinds() {
    std::size_t samples = 0;
    for (const FitView& view : views_) samples += view.data.count;
    // Costs are those of every second sample each way, which share next to no noise.
    const double values = 3.0 * static_cast<double>(samples) / 4.0;
    bool changed = false;
    const auto rows = kind_rows();
    report_.kinds.clear();
    for (int round = 0; round < most_rounds; ++round) {
        bool now = false;
        std::vector<SurfaceKinds> told;
        for (const auto& [row, light] : rows) {
            SurfaceKinds& surface = told.emplace_back();
            surface.row = row;
            surface.signal_to_noise = light;
            std::vector<KindTrial> trials = {with_kind(row, nullptr)};
            std::vector<std::string> names = {kind_names_.contains(row) ? kind_names_.at(row)
                                                                        : "as listed"};
            for (const CoatingKind& each : request_.kinds) {
                if (same_kind(each.coating, listed_.lens.surfaces[row].coating)) {
                    names.front() = each.name;
                    continue;
                }
                trials.push_back(with_kind(row, &each.coating));
                names.push_back(each.name);
            }
            double least = std::numeric_limits<double>::infinity();
            for (const KindTrial& each : trials) least = std::min(least, each.cost);
            // Where no kind fits, differences of cost say less.
            const double misfit = std::max(1.0, 2.0 * least / values);
            std::size_t best = 0;
            for (std::size_t k = 0; k < trials.size(); ++k) {
                const double chi2 = 2.0 * (trials[k].cost - least) / misfit;
                surface.tried.push_back(
                    {.name = names[k],
                     .numbers = trials[k].numbers,
                     .chi2_above = chi2,
                     .bic_above = chi2 + static_cast<double>(trials[k].numbers) * std::log(values),
                     .share = 0.0});
                if (surface.tried[k].bic_above < surface.tried[best].bic_above) best = k;
            }
            if (best != 0) {
                take_kind(row, trials[best]);
                kind_names_[row] = names[best];
                now = true;
            }
            const double lowest = surface.tried[best].bic_above;
            double all = 0.0;
            for (KindTried& each : surface.tried) {
                each.bic_above -= lowest;
                each.share = std::exp(-0.5 * each.bic_above);
                all += each.share;
            }
            for (KindTried& each : surface.tried) each.share /= all;
            std::ranges::stable_sort(surface.tried, {}, &KindTried::bic_above);
            tell(share_);
        }
        report_.kinds = std::move(told);
        changed = changed || now;
        if (!now) break;
    }
    for (const SurfaceKinds& each : report_.kinds) {
        std::string others;
        for (std::size_t k = 1; k < each.tried.size(); ++k)
            if (each.tried[k].share > excluded_share)
                others += fmt::format("{}{} ({:.2g} % of the odds)", others.empty() ? "" : ", ",
                                      each.tried[k].name, 100.0 * each.tried[k].share);
        report_.remarks.push_back(fmt::format(
            "Coating of surface {}: {}, {:.3g} % of the odds as long as the other surfaces' kinds "
            "are right{}.",
            each.row + 1, each.tried.front().name, 100.0 * each.tried.front().share,
            each.tried.front().share >= known_share
                ? (each.tried.size() > 1 ? fmt::format(", {} next with a BIC {:.3g} higher",
                                                       each.tried[1].name, each.tried[1].bic_above)
                                         : "")
                : "; not told from " + others));
    }
    return changed;
}

}  // namespace ghostlight
