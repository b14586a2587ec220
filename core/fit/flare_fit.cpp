#include "core/fit/flare_fit.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "core/elapsed.h"
#include "core/error.h"
#include "core/fit/fit_evaluator.h"
#include "core/fit/fit_report.h"
#include "core/fit/fit_statistics.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// Ghosts whose whole signal, times this for coatings that are other than at the start, is below
/// one standard deviation are not carried along.
constexpr double brighter_at_most = 6.0;
/// A parameter is not felt when the photographs narrow its prior by less than this share.
constexpr double felt = 1e-3;
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

struct Stopped {};

/// One fit as it goes on.
class Fit {
   public:
    Fit(const Prescription& lens, const std::vector<FitPhoto>& photos, const FitRequest& request,
        std::stop_token stop, const FitProgress& progress)
        : listed_{lens, {}},
          photos_(photos),
          request_(request),
          stop_(std::move(stop)),
          progress_(progress) {}

    FitReport run() {
        const auto began = Clock::now();
        prepare();
        build();
        look_at_start();
        solve_coatings();
        settle();
        FitReport report = finish();
        report.basis_ms = basis_ms_;
        report.seconds = 1e-3 * ms_since(began);
        return report;
    }

   private:
    FittedLens listed_;
    const std::vector<FitPhoto>& photos_;
    const FitRequest& request_;
    std::stop_token stop_;
    const FitProgress& progress_;
    FitLayout layout_;
    std::vector<FitParameter> not_felt_;
    std::vector<FitView> views_;
    std::unique_ptr<FitScene> scene_;
    std::unique_ptr<GhostWeights> weights_;
    std::unique_ptr<FitEvaluator> evaluator_;
    std::vector<std::vector<double>> start_models_;
    std::vector<std::vector<double>> start_shares_;  ///< by photo, by basis
    std::vector<Eigen::VectorXd> start_gains_;
    Eigen::VectorXd start_errors_;
    FitReport report_;
    double basis_ms_ = 0.0, cost_ = 0.0;
    std::size_t kept_ = 0;

    void check_stop() const {
        if (stop_.stop_requested()) throw Stopped{};
    }
    void tell(double share) const {
        if (progress_) progress_(share, cost_);
    }

    void prepare() {
        for (const FitParameter& each : request_.vary)
            (is_coating(each.kind) ? layout_.coatings : layout_.geometry).push_back(each);
        layout_.photos = photos_.size();
        layout_.background_terms = request_.background_terms;
        layout_.shading = request_.fit_shading;
        layout_.place = request_.fit_place;
        for (const FitPhoto& each : photos_) {
            FitView& view = views_.emplace_back();
            view.data = fit_data(each.photo, each.place, listed_.lens.sensor.width_mm,
                                 listed_.lens.sensor.height_mm, request_.across);
            view.light = each.light;
            view.stable.resize(3 * view.data.samples());
            std::vector<double> levels;
            for (std::size_t s = 0; s < view.data.samples(); ++s) {
                view.scales.push_back(stable_scale(view.data, s, request_.model_error));
                for (std::size_t c = 0; c < 3; ++c) {
                    view.stable[3 * s + c] = view.scales[s].at(view.data.value[3 * s + c]);
                    if (view.data.used[s]) levels.push_back(view.data.value[3 * s + c]);
                }
            }
            const auto place = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() * 9 / 10);
            std::ranges::nth_element(levels, place);
            view.background_unit = std::max(0.1 * *place, 1e-9);
            if (layout_.count() >= 3 * view.data.count * photos_.size())
                throw Error({.problem = "there are more unknowns than data",
                             .file = each.photo.file,
                             .where = {},
                             .found = fmt::format("{} unknowns, {} values", layout_.count(),
                                                  3 * view.data.count),
                             .expected = "fewer variables, or more of the photograph"});
        }
    }

    /// The lens with the geometry as it stands; coatings are the weights' business.
    FittedLens current_geometry() const {
        FittedLens lens = listed_;
        for (std::size_t q = 0; q < layout_.geometry.size(); ++q) {
            const FitParameter& p = layout_.geometry[q];
            const double moved =
                evaluator_ ? evaluator_->x[layout_.coatings.size() + q] * p.prior : 0.0;
            set(lens, p, p.start + moved);
        }
        return lens;
    }
    FittedLens with_coatings(FittedLens lens) const {
        const auto values = evaluator_->coating_values();
        for (std::size_t p = 0; p < values.size(); ++p) set(lens, layout_.coatings[p], values[p]);
        return lens;
    }
    LightDirection light_of(std::size_t photo) const {
        LightDirection light = photos_[photo].light;
        if (evaluator_ && layout_.place)
            light.field_deg += field_prior_deg * evaluator_->x[layout_.place_of(photo) + 3];
        return light;
    }
    FitPlace place_of(std::size_t photo) const {
        FitPlace place;
        if (!evaluator_ || !layout_.place) return place;
        const std::size_t at = layout_.place_of(photo);
        place.shift_x_mm = shift_prior_mm * evaluator_->x[at];
        place.shift_y_mm = shift_prior_mm * evaluator_->x[at + 1];
        place.rotation_rad = rotation_prior_rad * evaluator_->x[at + 2];
        return place;
    }

    /// Bases of all photographs for the geometry and places as they stand.
    void build() {
        const auto began = Clock::now();
        auto scene = std::make_unique<FitScene>(
            fit_scene(current_geometry(), request_.spectrum, request_.spectral_samples));
        std::erase_if(scene->ghosts, [&](const GhostPath& path) {
            return std::ranges::find(request_.left_out,
                                     ghostlight::name(path, listed_.lens.surfaces.size())) !=
                   request_.left_out.end();
        });
        if (kept_paths_) scene->ghosts = *kept_paths_;
        std::vector<const GhostBasis*> all;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            FitView& view = views_[i];
            view.light = light_of(i);
            view.place = place_of(i);
            view.bases = ghost_bases(*scene, view.light, view.data.frame, view.place, false,
                                     request_.threads, stop_);
            check_stop();
            for (const GhostBasis& basis : view.bases) report_.rays += basis.traced;
        }
        for (const FitView& view : views_)
            for (const GhostBasis& basis : view.bases) all.push_back(&basis);
        if (all.empty())
            throw Error({.problem = "no ghost of this lens lands on the photograph",
                         .file = photos_.front().photo.file,
                         .where = {},
                         .found = fmt::format("light at a field angle of {:.3g} degrees",
                                              photos_.front().light.field_deg),
                         .expected = "a light from which the lens makes ghosts on the sensor; is "
                                     "--light right?"});
        auto weights =
            std::make_unique<GhostWeights>(*scene, all, layout_.coatings, request_.threads);
        scene_ = std::move(scene);
        weights_ = std::move(weights);
        if (evaluator_) evaluator_->set_weights(*weights_);
        basis_ms_ = ms_since(began);
    }
    std::optional<std::vector<GhostPath>> kept_paths_;

    /// Signal to noise of each basis of a photograph at the model's gains.
    std::vector<double> signals(std::size_t photo) {
        FitView& view = views_[photo];
        std::vector<double> result(view.bases.size());
        parallel_for(view.bases.size(), request_.threads, {}, [&](std::size_t g) {
            const ModelPicture one = one_ghost(view.bases[g], *weights_, view.data.frame);
            double sum = 0.0;
            for (std::size_t s = 0; s < view.data.samples(); ++s) {
                if (!view.data.used[s]) continue;
                for (std::size_t c = 0; c < 3; ++c) {
                    const double m = evaluator_->gain(photo, c) * *one.at(s, c) /
                                     view.scales[s].sigma(view.data.value[3 * s + c]);
                    sum += m * m;
                }
            }
            result[g] = std::sqrt(sum);
        });
        return result;
    }

    void look_at_start() {
        evaluator_ = std::make_unique<FitEvaluator>(layout_, views_, *weights_, request_.threads);
        evaluator_->start_gains();
        // Ghosts below the noise are left out, with the bound.
        double left_out2 = 0.0, loudest = 0.0;
        std::vector<bool> keep(scene_->ghosts.size(), false);
        std::vector<std::vector<double>> found;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            found.push_back(signals(i));
            for (std::size_t g = 0; g < found[i].size(); ++g) {
                loudest = std::max(loudest, found[i][g]);
                if (brighter_at_most * found[i][g] >= 1.0) keep[views_[i].bases[g].ghost] = true;
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
        for (std::size_t i = 0; i < views_.size(); ++i)
            for (std::size_t g = 0; g < found[i].size(); ++g)
                if (!keep[views_[i].bases[g].ghost]) {
                    left_out2 += found[i][g] * found[i][g];
                    ++report_.ghosts_left_out;
                }
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
        evaluator_->PrepareForEvaluation(true, true);
        const auto info = information(*evaluator_, FitLoss::none, 1.0, request_.ghost_error);
        const Eigen::MatrixXd covariance = covariance_of(info);
        start_errors_ = covariance.diagonal().cwiseSqrt();
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

    /// After the layout has changed: everything that depends on it.
    void refresh() {
        std::vector<const GhostBasis*> all;
        for (const FitView& view : views_)
            for (const GhostBasis& basis : view.bases) all.push_back(&basis);
        const std::vector<double> x = evaluator_->x, at = evaluator_->linearised_at;
        weights_ = std::make_unique<GhostWeights>(*scene_, all, layout_.coatings, request_.threads);
        auto next = std::make_unique<FitEvaluator>(layout_, views_, *weights_, request_.threads);
        if (x.size() == next->x.size()) {
            next->x = x;
            next->linearised_at = at;
        }
        evaluator_ = std::move(next);
    }

    void drop_unfelt() {
        evaluator_->start_gains();
        evaluator_->PrepareForEvaluation(true, true);
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
                         .where = "--vary",
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

    /// The picture of other geometry, with the coatings as they stand.
    std::vector<double> picture_of(const FittedLens& lens, std::size_t photo,
                                   const LightDirection& light, bool main_only) {
        const FittedLens whole = with_coatings(lens);
        FitScene scene = fit_scene(whole, request_.spectrum, request_.spectral_samples);
        scene.ghosts = scene_->ghosts;
        const FitView& view = views_[photo];
        const auto bases = ghost_bases(scene, light, view.data.frame, view.place, main_only,
                                       request_.threads, stop_);
        check_stop();
        std::vector<const GhostBasis*> all;
        for (const GhostBasis& basis : bases) {
            all.push_back(&basis);
            report_.rays += basis.traced;
        }
        const GhostWeights weights(scene, all, {}, request_.threads);
        return ghost_picture(bases, weights, view.data.frame, 0, false, request_.threads).values;
    }

    /// Slopes by geometry and place where they stand.
    void linearise() {
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
                    add_place_slopes(*scene_, view.bases[g], view.light, view.data.frame,
                                     view.place, coefficients, partial[part]);
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

    double cost_now() {
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

    double explained() {
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

    double solve(int iterations) {
        check_stop();
        const auto problem = fit_problem(*evaluator_, request_.loss, request_.loss_scale);
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
        options.max_num_iterations = iterations;
        options.function_tolerance = 1e-8;
        options.parameter_tolerance = 1e-8;
        options.logging_type = ceres::SILENT;
        options.num_threads = 1;
        struct Watch final : ceres::IterationCallback {
            Fit& fit;
            explicit Watch(Fit& of) : fit(of) {}
            ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
                fit.cost_ = s.cost;
                fit.report_.cost_curve.push_back(s.cost);
                fit.tell(0.5);
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
        return summary.final_cost;
    }

    void solve_coatings() {
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
        evaluator_->x = best;
        for (std::size_t i = 0; i < views_.size(); ++i) views_[i].log_gain_start = best_gains[i];
        solve(final_iterations);
        for (int round = 0; round < 3; ++round) {
            if (!jump_centers()) break;
            solve(final_iterations);
        }
    }

    /// Tries each centre wavelength elsewhere, alone, with a few iterations for the others to
    /// follow: local minima of one surface, of which a reflectance that rises to either side of its
    /// centre has at least two.
    bool jump_centers() {
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

    /// Linearises geometry and place again until they stay.
    void settle() {
        if (layout_.geometry.empty() && !layout_.place) return;
        for (int turn = 0; turn < most_linearisations; ++turn) {
            double moved = 0.0;
            for (std::size_t k = layout_.coatings.size(); k < layout_.count(); ++k)
                if (is_linearised(k))
                    moved =
                        std::max(moved, std::abs(evaluator_->x[k] - evaluator_->linearised_at[k]));
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
    bool is_linearised(std::size_t k) const {
        if (k < layout_.lens_count()) return true;
        if (!layout_.place) return false;
        for (std::size_t i = 0; i < layout_.photos; ++i)
            if (k >= layout_.place_of(i) && k < layout_.place_of(i) + place_unknowns) return true;
        return false;
    }

    std::vector<double> shares(std::size_t photo) {
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

    struct Unmixed {
        Eigen::VectorXd gains, errors;
        std::vector<std::size_t> ghosts;  ///< bases, strongest first
        std::vector<std::size_t> merged;  ///< into which of `ghosts`; itself: not
        std::vector<double> signals;
    };
    /// Gains of the strongest ghosts against their pictures, by non-negative least squares.
    Unmixed unmixed(std::size_t photo) {
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
        parallel_for(count, request_.threads, {}, [&](std::size_t k) {
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
        const auto n = static_cast<Eigen::Index>(count);
        Eigen::MatrixXd normal(n, n);
        Eigen::VectorXd right(n);
        parallel_for(count, request_.threads, {}, [&](std::size_t a) {
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
                if (static_cast<std::size_t>(heads[static_cast<std::size_t>(h)]) ==
                    result.merged[a])
                    groups(static_cast<Eigen::Index>(a), h) = 1.0;
        Eigen::MatrixXd small = groups.transpose() * normal * groups;
        const Eigen::VectorXd target = groups.transpose() * right;
        for (Eigen::Index h = 0; h < m; ++h) small(h, h) += 1e-9 * small(h, h) + 1e-12;
        const Eigen::VectorXd gains = non_negative_least_squares(small, target);
        const Eigen::MatrixXd inverse = small.ldlt().solve(Eigen::MatrixXd::Identity(m, m));
        // Neighbouring samples share noise: (Σ correlation)² over the picture.
        const double shared = 1.0 + 2.0 * (spline_correlation(1) + spline_correlation(2));
        result.gains = Eigen::VectorXd::Zero(n);
        result.errors = Eigen::VectorXd::Zero(n);
        for (std::size_t a = 0; a < count; ++a)
            for (Eigen::Index h = 0; h < m; ++h)
                if (groups(static_cast<Eigen::Index>(a), h) > 0.0) {
                    result.gains(static_cast<Eigen::Index>(a)) = gains(h);
                    result.errors(static_cast<Eigen::Index>(a)) =
                        shared * std::sqrt(std::max(0.0, inverse(h, h)));
                }
        for (const std::size_t g : result.ghosts) result.signals.push_back(found[g]);
        return result;
    }

    FitReport finish() {
        check_stop();
        // Ceres' covariance of the robust problem, then widened by the correlation of the noise.
        const auto problem = fit_problem(*evaluator_, request_.loss, request_.loss_scale);
        ceres::Covariance::Options options;
        options.algorithm_type = ceres::DENSE_SVD;
        options.null_space_rank = -1;
        ceres::Covariance covariance(options);
        const auto count = static_cast<Eigen::Index>(layout_.count());
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> inverse(count,
                                                                                       count);
        const bool worked = covariance.Compute(
                                std::vector<std::pair<const double*, const double*>>{
                                    {evaluator_->x.data(), evaluator_->x.data()}},
                                problem.get()) &&
                            covariance.GetCovarianceBlock(evaluator_->x.data(),
                                                          evaluator_->x.data(), inverse.data());
        evaluator_->PrepareForEvaluation(true, true);
        const auto info =
            information(*evaluator_, request_.loss, request_.loss_scale, request_.ghost_error);
        const Eigen::MatrixXd known =
            worked ? covariance_of(info, Eigen::MatrixXd(inverse)) : covariance_of(info);

        FitReport& report = report_;
        report.cost_after = cost_now();
        evaluator_->PrepareForEvaluation(true, true);
        report.explained_after = explained();
        FitOutcome outcome{.layout = layout_,
                           .not_felt = not_felt_,
                           .evaluator = *evaluator_,
                           .covariance = known,
                           .start_errors = start_errors_,
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
                if (after.merged[k] != k)
                    ghost.merged_with = name_of(after.ghosts[after.merged[k]]);
            }
        }
        FittedLens fitted = with_coatings(current_geometry());
        report.lens = fitted;
        fill_bands(outcome, listed_.lens, fitted.lens, report);
        judge(outcome, report);
        suggest(known);
        return std::move(report);
    }

    /// Which light would narrow the worst known number most: its Jacobian, from the model, with the
    /// noise of the first photograph at a tenth of its brightest level.
    void suggest(const Eigen::MatrixXd& known) {
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
            const LightDirection light{widest_deg * (static_cast<double>(k) + 0.5) /
                                           static_cast<double>(request_.suggestions),
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
            const double shared = 1.0 + 2.0 * (spline_correlation(1) + spline_correlation(2));
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
                    h.selfadjointView<Eigen::Lower>().rankUpdate(row, 1.0 / (shared * shared));
                }
            }
            h = Eigen::MatrixXd(h.selfadjointView<Eigen::Lower>());
            for (Eigen::Index c = 0; c < 3; ++c) h(n + c, n + c) += 1e-6;
            const Eigen::MatrixXd gained =
                h.topLeftCorner(n, n) - h.topRightCorner(n, 3) *
                                            h.bottomRightCorner(3, 3).inverse() *
                                            h.bottomLeftCorner(3, n);
            const Eigen::MatrixXd then = (prior + gained).inverse();
            const auto w = static_cast<Eigen::Index>(worst);
            report_.suggestions.push_back(
                {.light = light,
                 .number = worst,
                 .error_now = std::sqrt(known(w, w)) * layout_.coatings[worst].prior,
                 .error_then =
                     std::sqrt(std::max(0.0, then(w, w))) * layout_.coatings[worst].prior});
        }
        std::ranges::stable_sort(report_.suggestions, {}, &Suggestion::error_then);
    }
};

}  // namespace

std::optional<FitReport> fit_flare(const Prescription& lens, const std::vector<FitPhoto>& photos,
                                   const FitRequest& request, std::stop_token stop,
                                   const FitProgress& progress) {
    if (photos.empty()) throw Error("a fit needs at least one photograph");
    if (request.vary.empty()) throw Error("a fit needs something to vary");
    try {
        return Fit(lens, photos, request, std::move(stop), progress).run();
    } catch (const Stopped&) {
        return std::nullopt;
    }
}

}  // namespace ghostlight
