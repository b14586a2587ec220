#include "core/fit/fit_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/elapsed.h"
#include "core/error.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// Geometry is linearised again until it stays, but not more often than this; places, which are
/// known beforehand to a few priors, stay after one.
constexpr int most_linearisations = 12, first_linearisations = 1;

/// Of a sample: how well the model's quadrature places rims and caustics.
constexpr double rim_place = 0.02;

}  // namespace

FitReport FitRun::run() {
    const auto began = Clock::now();
    tell_stage("bringing the photographs to the fit's scale");
    prepare();
    tell_stage("tracing the ghosts");
    build();
    look_at_start();
    share_ = 0.2;
    tell_stage("first guesses of the coatings");
    solve_coatings();
    if (!request_.kinds.empty() && choose_kinds()) {
        expect_errors();
        solve_coatings();
    }
    share_ = 0.4;
    tell_stage("place of the picture");
    settle(first_linearisations);
    share_ = 0.6;
    tell_stage("looking for other minima");
    const bool elsewhere = explore_coatings();
    share_ = 0.8;
    if (elsewhere) settle(first_linearisations);
    if (!layout_.geometry.empty()) {
        tell_stage("geometry");
        settle(most_linearisations);
    }
    tell_stage("errors and report");
    FitReport report = finish();
    report.basis_ms = basis_ms_;
    report.seconds = 1e-3 * ms_since(began);
    return report;
}

void FitRun::check_stop() const {
    if (stop_.stop_requested()) throw FitStopped{};
}

void FitRun::tell(double share) const {
    if (progress_) progress_(share, cost_);
}

void FitRun::tell_stage(const char* words) const {
    if (request_.stage) request_.stage(words);
}

void FitRun::show_look() const {
    FitLook look{
        .cost = cost_, .numbers = {}, .lens = with_coatings(current_geometry()), .photos = {}};
    const auto coatings = evaluator_->coating_values();
    for (std::size_t k = 0; k < layout_.lens_count(); ++k) {
        const bool moves_no_ray = k < layout_.coatings.size();
        FittedNumber& number = look.numbers.emplace_back();
        number.parameter =
            moves_no_ray ? layout_.coatings[k] : layout_.geometry[k - layout_.coatings.size()];
        number.value = moves_no_ray
                           ? coatings[k]
                           : number.parameter.start + evaluator_->x[k] * number.parameter.prior;
    }
    for (std::size_t i = 0; i < views_.size(); ++i) {
        FittedPhoto& photo = look.photos.emplace_back();
        photo.file = photos_[i].photo.file;
        photo.light = photos_[i].light;
        photo.frame = views_[i].data.frame;
        photo.used = views_[i].data.used;
        photo.measured = views_[i].data.value;
        photo.after = evaluator_->model(i);
        photo.residuals = evaluator_->residuals(i);
    }
    request_.look(look);
}

void FitRun::prepare() {
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
        view.curve_error = each.photo.curve_error;
        if (view.curve_error > 0.0)
            report_.remarks.push_back(fmt::format(
                "{}: the curve that made its values linear is a guess; each sample, and each "
                "ghost's light as a whole, is taken to be off by {:.2g} % (standard deviation), "
                "and the errors allow for it.",
                each.photo.file.empty() ? "The photograph" : each.photo.file,
                100.0 * view.curve_error));
        std::vector<double> levels;
        for (std::size_t s = 0; s < view.data.samples(); ++s)
            for (std::size_t c = 0; c < 3 && view.data.used[s]; ++c)
                levels.push_back(view.data.value[3 * s + c]);
        const auto place = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() * 9 / 10);
        std::ranges::nth_element(levels, place);
        view.background_unit = std::max(0.1 * *place, 1e-9);
        view.stable.resize(3 * view.data.samples());
        for (std::size_t s = 0; s < view.data.samples(); ++s) {
            const double of_rim = rim_place * relative_contrast(view.data, s, view.background_unit);
            view.scales.push_back(
                stable_scale(view.data, s,
                             std::hypot(std::hypot(request_.model_error, view.curve_error), of_rim),
                             view.background_unit));
            for (std::size_t c = 0; c < 3; ++c)
                view.stable[3 * s + c] = view.scales[s].at(view.data.value[3 * s + c]);
        }
        if (layout_.count() >= 3 * view.data.count * photos_.size())
            throw Error({.problem = "there are more unknowns than data",
                         .file = each.photo.file,
                         .where = {},
                         .found = fmt::format("{} unknowns, {} values", layout_.count(),
                                              3 * view.data.count),
                         .expected = "fewer variables, or more of the photograph"});
    }
}

FittedLens FitRun::current_geometry() const { return geometry_moved(layout_.geometry.size(), 0.0); }

FittedLens FitRun::geometry_moved(std::size_t which, double by) const {
    FittedLens lens = listed_;
    for (std::size_t q = 0; q < layout_.geometry.size(); ++q) {
        const FitParameter& p = layout_.geometry[q];
        const double x = (evaluator_ ? evaluator_->x[layout_.coatings.size() + q] : 0.0) +
                         (q == which ? by : 0.0);
        set(lens, p, p.start + x * p.prior);
    }
    return lens;
}

FittedLens FitRun::with_coatings(FittedLens lens) const {
    const auto values = evaluator_->coating_values();
    for (std::size_t p = 0; p < values.size(); ++p) set(lens, layout_.coatings[p], values[p]);
    return lens;
}

LightDirection FitRun::light_of(std::size_t photo) const {
    LightDirection light = photos_[photo].light;
    if (evaluator_ && layout_.place)
        light.field_deg += field_prior_deg * evaluator_->x[layout_.place_of(photo) + 3];
    return light;
}

FitPlace FitRun::place_of(std::size_t photo) const {
    FitPlace place;
    if (!evaluator_ || !layout_.place) return place;
    const std::size_t at = layout_.place_of(photo);
    place.shift_x_mm = shift_prior_mm * evaluator_->x[at];
    place.shift_y_mm = shift_prior_mm * evaluator_->x[at + 1];
    place.rotation_rad = rotation_prior_rad * evaluator_->x[at + 2];
    return place;
}

void FitRun::build() {
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
                                 "the light's place right?"});
    auto weights = std::make_unique<GhostWeights>(*scene, all, layout_.coatings, request_.threads);
    scene_ = std::move(scene);
    weights_ = std::move(weights);
    if (evaluator_) evaluator_->set_weights(*weights_);
    basis_ms_ = ms_since(began);
}

std::vector<double> FitRun::signals(std::size_t photo) {
    FitView& view = views_[photo];
    std::vector<double> result(view.bases.size());
    parallel_for(view.bases.size(), request_.threads, stop_, [&](std::size_t g) {
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

void FitRun::refresh() {
    std::vector<const GhostBasis*> all;
    for (const FitView& view : views_)
        for (const GhostBasis& basis : view.bases) all.push_back(&basis);
    const std::vector<double> x = evaluator_->x, at = evaluator_->linearised_at;
    weights_ = std::make_unique<GhostWeights>(*scene_, all, layout_.coatings, request_.threads);
    auto next = std::make_unique<FitEvaluator>(layout_, views_, *weights_, request_.threads);
    next->set_stop(stop_);
    if (x.size() == next->x.size()) {
        next->x = x;
        next->linearised_at = at;
    }
    evaluator_ = std::move(next);
}

}  // namespace ghostlight
