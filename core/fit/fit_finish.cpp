#include "core/fit/fit_run.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fit/light_place.h"
#include "core/parallel.h"

namespace ghostlight {
std::vector<double> FitRun::shares(std::size_t photo) {
    const FitView& view = views_[photo];
    std::vector<double> light(view.bases.size());
    double all = 0.0;
    for (std::size_t g = 0; g < view.bases.size(); ++g) {
        std::vector<double> coefficients;
        weights_->coefficients(view.bases[g], coefficients, nullptr);
        const GhostBasis& basis = view.bases[g];
        double sum = 0.0;
        for (std::size_t k = 0; k < basis.values.size(); ++k) {
            const std::size_t r = k % basis.width();
            sum += static_cast<double>(basis.values[k]) *
                   (coefficients[3 * r] + coefficients[3 * r + 1] + coefficients[3 * r + 2]);
        }
        light[g] = sum;
        all += sum;
    }
    for (double& each : light) each /= std::max(all, 1e-300);
    return light;
}

FitRun::Unmixed FitRun::unmixed(std::size_t photo) {
    constexpr std::size_t most = 40;
    constexpr double overlap = 0.98;
    const FitView& view = views_[photo];
    Unmixed result;
    const auto found = signals(photo);
    for (std::size_t g = 0; g < found.size(); ++g) result.ghosts.push_back(g);
    std::ranges::stable_sort(result.ghosts, std::ranges::greater{},
                             [&](std::size_t g) { return found[g]; });
    if (result.ghosts.size() > most) result.ghosts.resize(most);
    const std::size_t count = result.ghosts.size();
    std::vector<std::vector<float>> columns(count);
    std::vector<float> rest(3 * view.data.samples(), 0.0F);
    parallel_for(count, request_.threads, stop_, [&](std::size_t k) {
        const ModelPicture one =
            one_ghost(view.bases[result.ghosts[k]], *weights_, view.data.frame);
        columns[k].assign(3 * view.data.samples(), 0.0F);
        for (std::size_t s = 0; s < view.data.samples(); ++s)
            for (std::size_t c = 0; c < 3 && view.data.used[s]; ++c)
                columns[k][3 * s + c] =
                    static_cast<float>(evaluator_->gain(photo, c) * *one.at(s, c) /
                                       view.scales[s].sigma(view.data.value[3 * s + c]));
    });
    // What the strongest are to explain: the residual plus themselves.
    for (std::size_t s = 0; s < view.data.samples(); ++s)
        for (std::size_t c = 0; c < 3 && view.data.used[s]; ++c)
            rest[3 * s + c] = static_cast<float>(
                (view.data.value[3 * s + c] - evaluator_->model(photo)[3 * s + c]) /
                view.scales[s].sigma(view.data.value[3 * s + c]));
    check_stop();
    const auto n = static_cast<Eigen::Index>(count);
    Eigen::MatrixXd normal(n, n);
    Eigen::VectorXd right(n);
    parallel_for(count, request_.threads, stop_, [&](std::size_t a) {
        for (std::size_t b = 0; b <= a; ++b) {
            double sum = 0.0;
            for (std::size_t s = 0; s < rest.size(); ++s)
                sum += static_cast<double>(columns[a][s] * columns[b][s]);
            normal(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) = sum;
        }
        double sum = 0.0;
        for (std::size_t s = 0; s < rest.size(); ++s)
            sum += static_cast<double>(columns[a][s] * rest[s]);
        right(static_cast<Eigen::Index>(a)) = sum;
    });
    check_stop();
    for (Eigen::Index a = 0; a < n; ++a)
        for (Eigen::Index b = 0; b < a; ++b) normal(b, a) = normal(a, b);
    right += normal * Eigen::VectorXd::Ones(n);
    result.merged.resize(count);
    for (std::size_t a = 0; a < count; ++a) {
        result.merged[a] = a;
        for (std::size_t b = 0; b < a; ++b) {
            const auto i = static_cast<Eigen::Index>(a), k = static_cast<Eigen::Index>(b);
            if (result.merged[b] == b &&
                normal(i, k) > overlap * std::sqrt(normal(i, i) * normal(k, k))) {
                result.merged[a] = b;
                break;
            }
        }
    }
    std::vector<Eigen::Index> heads;
    for (std::size_t a = 0; a < count; ++a)
        if (result.merged[a] == a) heads.push_back(static_cast<Eigen::Index>(a));
    const auto m = static_cast<Eigen::Index>(heads.size());
    Eigen::MatrixXd groups = Eigen::MatrixXd::Zero(n, m);
    for (std::size_t a = 0; a < count; ++a)
        for (Eigen::Index h = 0; h < m; ++h)
            if (static_cast<std::size_t>(heads[static_cast<std::size_t>(h)]) == result.merged[a])
                groups(static_cast<Eigen::Index>(a), h) = 1.0;
    Eigen::MatrixXd small = groups.transpose() * normal * groups;
    const Eigen::VectorXd target = groups.transpose() * right;
    for (Eigen::Index h = 0; h < m; ++h) small(h, h) += 1e-9 * small(h, h) + 1e-12;
    const Eigen::VectorXd gains = non_negative_least_squares(small, target);
    const Eigen::MatrixXd inverse = small.ldlt().solve(Eigen::MatrixXd::Identity(m, m));
    // Neighbouring samples share noise: (Σ correlation)² over the picture.
    result.gains = Eigen::VectorXd::Zero(n);
    result.errors = Eigen::VectorXd::Zero(n);
    for (std::size_t a = 0; a < count; ++a)
        for (Eigen::Index h = 0; h < m; ++h)
            if (groups(static_cast<Eigen::Index>(a), h) > 0.0) {
                result.gains(static_cast<Eigen::Index>(a)) = gains(h);
                result.errors(static_cast<Eigen::Index>(a)) =
                    std::sqrt(shared_noise() * std::max(0.0, inverse(h, h)));
            }
    for (const std::size_t g : result.ghosts) result.signals.push_back(found[g]);
    return result;
}

FitReport FitRun::finish() {
    check_stop();
    // Ceres' covariance of the robust problem, then widened by the correlation of the noise.
    const auto problem = fit_problem(*evaluator_, request_.loss, request_.loss_scale);
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::DENSE_SVD;
    options.null_space_rank = -1;
    ceres::Covariance covariance(options);
    const auto count = static_cast<Eigen::Index>(layout_.count());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> inverse(count, count);
    const bool worked =
        covariance.Compute(
            std::vector<std::pair<const double*, const double*>>{
                {evaluator_->x.data(), evaluator_->x.data()}},
            problem.get()) &&
        covariance.GetCovarianceBlock(evaluator_->x.data(), evaluator_->x.data(), inverse.data());
    evaluator_->PrepareForEvaluation(true, true);
    const auto info =
        information(*evaluator_, request_.loss, request_.loss_scale, request_.ghost_error, stop_);
    check_stop();
    const Eigen::MatrixXd known =
        worked ? covariance_of(info, Eigen::MatrixXd(inverse)) : covariance_of(info);

    FitReport& report = report_;
    report.loss = request_.loss;
    report.loss_scale = request_.loss_scale;
    report.cost_after = cost_now();
    evaluator_->PrepareForEvaluation(true, true);
    report.explained_after = explained();
    FitOutcome outcome{.layout = layout_,
                       .not_felt = not_felt_,
                       .evaluator = *evaluator_,
                       .covariance = known,
                       .start_errors = start_errors_,
                       .other_minima = other_minima_,
                       .loss_scale = request_.loss_scale};
    fill_numbers(outcome, report);
    for (std::size_t i = 0; i < views_.size(); ++i) {
        fill_photo(outcome, i, report);
        FittedPhoto& photo = report.photos.back();
        photo.file = photos_[i].photo.file;
        photo.light = photos_[i].light;
        photo.field_deg = light_of(i).field_deg;
        photo.before = start_models_[i];
        const Unmixed after = unmixed(i);
        const auto share = shares(i);
        for (std::size_t k = 0; k < after.ghosts.size(); ++k) {
            const std::size_t g = after.ghosts[k];
            FittedGhost& ghost = report.ghosts.emplace_back();
            auto name_of = [&](std::size_t basis) {
                return ghostlight::name(scene_->ghosts[views_[i].bases[basis].ghost],
                                        listed_.lens.surfaces.size());
            };
            ghost.name = name_of(g);
            ghost.photo = i;
            ghost.signal_to_noise = after.signals[k];
            ghost.share_after = share[g];
            ghost.share_before = g < start_shares_[i].size() ? start_shares_[i][g] : 0.0;
            ghost.gain_after = after.gains(static_cast<Eigen::Index>(k));
            ghost.gain_error = after.errors(static_cast<Eigen::Index>(k));
            // At the start: measured light over the start's model.
            ghost.gain_before = ghost.share_before > 0.0
                                    ? ghost.gain_after * ghost.share_after / ghost.share_before
                                    : std::numeric_limits<double>::quiet_NaN();
            if (after.merged[k] != k) ghost.merged_with = name_of(after.ghosts[after.merged[k]]);
        }
    }
    FittedLens fitted = with_coatings(current_geometry());
    report.lens = fitted;
    fill_bands(outcome, given_, listed_.lens, fitted.lens, report);
    judge(outcome, report);
    for (std::size_t i = 0; i < views_.size() && !report.usable; ++i)
        if (!image_of_light(scene_->system(), views_[i].light))
            report.verdict += fmt::format(
                " No ray of a light at a field angle of {:.4g} degrees passes straight through the "
                "lens: is the light's place right?",
                photos_[i].light.field_deg);
    profile(report);
    bootstrap(report);
    suggest(known);
    return std::move(report);
}

void FitRun::suggest(const Eigen::MatrixXd& known) {
    if (request_.suggestions == 0 || layout_.coatings.empty()) return;
    const std::size_t count = layout_.coatings.size();
    std::size_t worst = 0;
    double largest = 0.0;
    for (std::size_t p = 0; p < count; ++p) {
        const double error = known(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(p));
        if (error > largest) {
            largest = error;
            worst = p;
        }
    }
    const auto n = static_cast<Eigen::Index>(count);
    const FitView& like = views_.front();
    const double half_mm = 0.5 * listed_.lens.sensor.height_mm;
    const double efl_mm = std::abs(focal_length_mm(scene_->system()));
    const double widest_deg =
        1.3 * std::atan(half_mm / std::max(efl_mm, 1e-3)) * 180.0 / std::numbers::pi;
    const Eigen::MatrixXd prior = known.topLeftCorner(n, n).inverse();
    for (std::size_t k = 0; k < request_.suggestions; ++k) {
        check_stop();
        const LightDirection light{
            widest_deg * (static_cast<double>(k) + 0.5) / static_cast<double>(request_.suggestions),
            90.0};
        const auto bases =
            ghost_bases(*scene_, light, like.data.frame, {}, true, request_.threads, stop_);
        if (bases.empty()) continue;
        std::vector<const GhostBasis*> all;
        for (const GhostBasis& basis : bases) all.push_back(&basis);
        GhostWeights weights(*scene_, all, layout_.coatings, request_.threads);
        weights.update(evaluator_->coating_values(), true);
        const ModelPicture picture =
            ghost_picture(bases, weights, like.data.frame, count, true, request_.threads);
        // Gains are unknown there too.
        Eigen::MatrixXd h = Eigen::MatrixXd::Zero(n + 3, n + 3);
        Eigen::VectorXd row(n + 3);
        for (std::size_t s = 0; s < like.data.samples(); ++s) {
            if (!like.data.used[s]) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                const double gain = evaluator_->gain(0, c);
                const double* from = picture.at(s, c);
                const double inverse = 1.0 / like.scales[s].sigma(gain * from[0]);
                row.setZero();
                for (std::size_t p = 0; p < count; ++p)
                    row(static_cast<Eigen::Index>(p)) =
                        inverse * gain * from[1 + p] * layout_.coatings[p].prior;
                row(n + static_cast<Eigen::Index>(c)) = inverse * gain * from[0];
                h.selfadjointView<Eigen::Lower>().rankUpdate(row, 1.0 / shared_noise());
            }
        }
        h = Eigen::MatrixXd(h.selfadjointView<Eigen::Lower>());
        for (Eigen::Index c = 0; c < 3; ++c) h(n + c, n + c) += 1e-6;
        const Eigen::MatrixXd gained =
            h.topLeftCorner(n, n) -
            h.topRightCorner(n, 3) * h.bottomRightCorner(3, 3).inverse() * h.bottomLeftCorner(3, n);
        const Eigen::MatrixXd then = (prior + gained).inverse();
        const auto w = static_cast<Eigen::Index>(worst);
        report_.suggestions.push_back(
            {.light = light,
             .number = worst,
             .error_now = std::sqrt(known(w, w)) * layout_.coatings[worst].prior,
             .error_then = std::sqrt(std::max(0.0, then(w, w))) * layout_.coatings[worst].prior});
    }
    std::ranges::stable_sort(report_.suggestions, {}, &Suggestion::error_then);
}

}  // namespace ghostlight
