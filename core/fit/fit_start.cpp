#include "core/fit/fit_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ghostlight {
namespace {

/// Ghosts whose whole signal, times this for coatings that are other than at the start, is below
/// one standard deviation are not carried along.
constexpr double brighter_at_most = 6.0;
/// The same where either of its coatings may turn out to be none: 4 % in place of 0.5 %, twice.
constexpr double brighter_uncoated = 64.0;
/// χ² of independent samples by which the ghosts must explain the photographs better than a smooth
/// background does. Noise alone reaches it once in a million: one gain for each of three channels.
constexpr double least_evidence = 30.0;
/// A parameter is not felt when the photographs narrow its prior by less than this share.
constexpr double felt = 1e-3;

/// By how much χ² of a photograph is less when the model's light, times a gain for each channel, is
/// added to a background of polynomials; of independent samples.
double evidence_of(const FitView& view, const std::vector<double>& model, int terms) {
    const auto count = static_cast<Eigen::Index>(std::max(1, terms));
    double evidence = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        // Weighted normal equations of background, light and photograph.
        Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count + 2, count + 2);
        Eigen::VectorXd row(count + 2);
        for (std::size_t s = 0; s < view.data.samples(); ++s) {
            if (!view.data.used[s]) continue;
            const double y = view.data.value[3 * s + c], inverse = 1.0 / view.scales[s].sigma(y);
            const auto polynomials = background_functions(view.data.frame, s);
            for (Eigen::Index t = 0; t < count; ++t)
                row(t) = inverse * polynomials[static_cast<std::size_t>(t)];
            row(count) = inverse * model[3 * s + c];
            row(count + 1) = inverse * y;
            normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
        }
        normal = Eigen::MatrixXd(normal.selfadjointView<Eigen::Lower>());
        const Eigen::MatrixXd left =
            normal.bottomRightCorner(2, 2) -
            normal.bottomLeftCorner(2, count) *
                normal.topLeftCorner(count, count).ldlt().solve(normal.topRightCorner(count, 2));
        // Ghosts only add light.
        if (left(0, 0) > 0.0 && left(0, 1) > 0.0) evidence += left(0, 1) * left(0, 1) / left(0, 0);
    }
    return evidence / shared_noise();
}

}  // namespace

void FitRun::look_at_start() {
    evaluator_ = std::make_unique<FitEvaluator>(layout_, views_, *weights_, request_.threads);
    evaluator_->set_stop(stop_);
    evaluator_->start_gains();
    // Ghosts below the noise are left out, with the bound.
    double left_out2 = 0.0, loudest = 0.0;
    std::vector<bool> keep(scene_->ghosts.size(), false);
    std::vector<std::vector<double>> found;
    const double brighter = request_.kinds.empty() ? brighter_at_most : brighter_uncoated;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        found.push_back(signals(i));
        check_stop();
        for (std::size_t g = 0; g < found[i].size(); ++g) {
            loudest = std::max(loudest, found[i][g]);
            if (brighter * found[i][g] >= 1.0) keep[views_[i].bases[g].ghost] = true;
        }
    }
    if (loudest < 5.0)
        throw Error({.problem = "no ghost is visible in the photograph",
                     .file = photos_.front().photo.file,
                     .where = {},
                     .found = fmt::format("the strongest has {:.2g} standard deviations of "
                                          "signal in all",
                                          loudest),
                     .expected = "a photograph exposed so that the flare is well above the "
                                 "noise, with the light near the frame"});
    refuse_mere_noise();
    for (std::size_t i = 0; i < views_.size(); ++i)
        for (std::size_t g = 0; g < found[i].size(); ++g)
            if (!keep[views_[i].bases[g].ghost]) {
                left_out2 += found[i][g] * found[i][g];
                ++report_.ghosts_left_out;
                report_.left_out.push_back(
                    {.name = ghostlight::name(scene_->ghosts[views_[i].bases[g].ghost],
                                              listed_.lens.surfaces.size()),
                     .photo = i,
                     .at_most = brighter_at_most * found[i][g]});
            }
    std::ranges::stable_sort(report_.left_out, std::ranges::greater{}, &LeftOutGhost::at_most);
    report_.left_out_signal_to_noise = std::sqrt(left_out2);
    for (FitView& view : views_)
        std::erase_if(view.bases, [&](const GhostBasis& basis) { return !keep[basis.ghost]; });
    std::vector<GhostPath> kept;
    std::vector<std::size_t> new_index(scene_->ghosts.size(), 0);
    for (std::size_t g = 0; g < keep.size(); ++g)
        if (keep[g]) {
            new_index[g] = kept.size();
            kept.push_back(scene_->ghosts[g]);
        }
    for (FitView& view : views_)
        for (GhostBasis& basis : view.bases) basis.ghost = new_index[basis.ghost];
    scene_->ghosts = kept;
    kept_paths_ = kept;

    linearise();
    refresh();
    // What no visible ghost feels is named and held.
    drop_unfelt();
    evaluator_->start_gains();
    expect_errors();
    for (std::size_t i = 0; i < views_.size(); ++i) {
        start_models_.push_back(evaluator_->model(i));
        start_shares_.push_back(shares(i));
        start_gains_.push_back(unmixed(i).gains);
    }
    report_.cost_before = cost_now();
    report_.explained_before = explained();
    cost_ = report_.cost_before;
    tell(0.1);
}

void FitRun::refuse_mere_noise() {
    evaluator_->PrepareForEvaluation(false, true);
    check_stop();
    double evidence = 0.0;
    for (std::size_t i = 0; i < views_.size(); ++i)
        evidence += evidence_of(views_[i], evaluator_->model(i), layout_.background_terms);
    if (evidence >= least_evidence) return;
    throw Error(
        {.problem = "no flare of this lens stands out of the noise",
         .file = photos_.front().photo.file,
         .where = {},
         .found = fmt::format("its ghosts of a light at {:.4g} degrees lower chi-squared by {:.2g} "
                              "against a smooth background alone",
                              photos_.front().light.field_deg, evidence),
         .expected = fmt::format("{:.2g} or more: a photograph in which the flare can be seen, its "
                                 "light at the place that is told, and its lens",
                                 least_evidence)});
}

void FitRun::expect_errors() {
    evaluator_->PrepareForEvaluation(true, true);
    check_stop();
    const auto info = information(*evaluator_, FitLoss::none, 1.0, request_.ghost_error, stop_);
    check_stop();
    start_errors_ = covariance_of(info).diagonal().cwiseSqrt();
}

void FitRun::drop_unfelt() {
    evaluator_->start_gains();
    evaluator_->PrepareForEvaluation(true, true);
    check_stop();
    const std::size_t count = layout_.count();
    std::vector<double> sums(layout_.lens_count(), 0.0);
    for (std::size_t i = 0; i < views_.size(); ++i)
        for (std::size_t row = 0; row < 3 * views_[i].data.samples(); ++row)
            for (std::size_t p = 0; p < sums.size(); ++p)
                sums[p] += std::pow(evaluator_->jacobian(i)[row * count + p], 2);
    FitLayout kept = layout_;
    kept.coatings.clear();
    kept.geometry.clear();
    std::vector<std::size_t> geometry_kept;
    for (std::size_t p = 0; p < sums.size(); ++p) {
        const bool coating = p < layout_.coatings.size();
        const FitParameter& parameter =
            coating ? layout_.coatings[p] : layout_.geometry[p - layout_.coatings.size()];
        if (std::sqrt(sums[p]) < felt) {
            not_felt_.push_back(parameter);
            continue;
        }
        (coating ? kept.coatings : kept.geometry).push_back(parameter);
        if (!coating) geometry_kept.push_back(p - layout_.coatings.size());
    }
    if (kept.lens_count() == 0)
        throw Error({.problem = "no visible ghost feels any of the variables",
                     .file = photos_.front().photo.file,
                     .where = "what is varied",
                     .found = fmt::format("{} variables", sums.size()),
                     .expected = "variables on surfaces that take part in visible ghosts"});
    if (not_felt_.empty()) return;
    for (FitView& view : views_) {
        std::vector<std::vector<double>> slopes;
        for (const std::size_t q : geometry_kept) slopes.push_back(view.slopes[q]);
        for (std::size_t q = layout_.geometry.size(); q < view.slopes.size(); ++q)
            slopes.push_back(view.slopes[q]);
        view.slopes = std::move(slopes);
    }
    layout_ = kept;
    refresh();
}

}  // namespace ghostlight
