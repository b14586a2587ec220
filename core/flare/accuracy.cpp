#include "core/flare/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elapsed.h"
#include "core/flare/accuracy_trials.h"
#include "core/flare/flip.h"
#include "core/flare/plan_report.h"
#include "core/flare/reference_image.h"
#include "core/ghosts/ghost_table.h"

namespace ghostlight {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double reference_share = 0.5;  ///< of the progress

double percentile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    const auto last = static_cast<double>(values.size() - 1);
    return values[static_cast<std::size_t>(std::ceil(share * last))];
}

PictureErrors errors_of(const FlareImage& image, const FlareImage& truth) {
    PictureErrors errors = picture_errors(image.irradiance, truth.irradiance);
    errors.flip = hdr_flip(image.rgb, truth.rgb, truth.width_px);
    return errors;
}

/// One cold frame, then as many as fit into `allowed_ms`, three at least if the first took less.
std::optional<AccuracyPoint> timed(const AccuracyTrial& trial, const FlareImage& truth,
                                   int most_repeats, double allowed_ms) {
    AccuracyPoint point;
    point.method = trial.method;
    point.knob = trial.knob;
    point.setting = trial.setting;
    point.is_ablation = trial.is_ablation;
    const auto began = Clock::now();
    const auto frame = trial.prepare();
    const auto image = frame();
    if (!image) return std::nullopt;
    point.cold_ms = ms_since(began);
    point.rays = image->rays;
    std::vector<double> times;
    while (static_cast<int>(times.size()) < most_repeats) {
        const double spent = ms_since(began);
        if (spent > allowed_ms && (times.size() >= 3 || point.cold_ms > allowed_ms)) break;
        const auto at = Clock::now();
        if (!frame()) return std::nullopt;
        times.push_back(ms_since(at));
    }
    if (times.empty()) times.push_back(point.cold_ms);
    point.repeats = static_cast<int>(times.size());
    point.median_ms = percentile(times, 0.5);
    point.p95_ms = percentile(times, 0.95);
    point.errors = errors_of(*image, truth);
    if (!image->plan.ghosts.empty()) point.plan_bound = bounded_error(image->plan);
    return point;
}

ReferenceRequest reference_request(const AccuracyRequest& request) {
    ReferenceRequest reference;
    reference.light = request.light;
    reference.spectrum = request.spectrum;
    reference.width_px = request.width_px;
    reference.tolerance = request.reference_tolerance;
    reference.threads = request.threads;
    return reference;
}

/// The simplified physics, drawn as finely as the reference.
std::optional<AccuracyPoint> shortcut(const Prescription& lens, ReferenceRequest request,
                                      const char* name, const FlareImage& truth,
                                      const std::stop_token& stop) {
    const auto image = render_reference(lens, request, stop);
    if (!image) return std::nullopt;
    AccuracyPoint point;
    point.method = name;
    point.setting = none;
    point.cold_ms = point.median_ms = point.p95_ms = image->image.times.total_ms;
    point.repeats = 1;
    point.rays = image->image.rays;
    point.errors = errors_of(image->image, truth);
    point.is_shortcut = true;
    return point;
}

/// Light, place and size of the strongest ghosts, each from the method's whole picture.
bool compare_ghosts(const Prescription& lens, const AccuracyRequest& request,
                    const std::vector<ReferenceGhost>& all, const std::stop_token& stop,
                    std::vector<GhostAccuracy>& rows) {
    std::vector<const ReferenceGhost*> strongest;
    for (const ReferenceGhost& ghost : all)
        if (ghost.on_sensor_mm2 > 0.0) strongest.push_back(&ghost);
    std::ranges::stable_sort(strongest, std::ranges::greater{}, &ReferenceGhost::on_sensor_mm2);
    if (strongest.size() > request.ghosts) strongest.resize(request.ghosts);
    if (strongest.empty()) return true;
    ReferenceRequest reference = reference_request(request);
    for (const ReferenceGhost* ghost : strongest) reference.only.push_back(ghost->path);
    reference.layers = true;
    const auto truth = render_reference(lens, reference, stop);
    if (!truth) return false;
    const double pitch_mm = truth->image.sensor_width_mm / truth->image.width_px;
    FlareRequest base;
    base.light = request.light;
    base.spectrum = request.spectrum;
    base.width_px = request.width_px;
    base.threads = request.threads;
    struct Method {
        const char* name;
        FlareMethod method;
    };
    for (const auto& [name, method] :
         {Method{"planned 0.01", FlareMethod::planned}, Method{"uniform 64", FlareMethod::uniform},
          Method{"paraxial", FlareMethod::paraxial}})
        for (const ReferenceGhost& ghost : truth->ghosts) {
            FlareRequest one = base;
            one.method = method;
            one.tolerance = usual_trial_tolerance;
            one.grid = usual_trial_grid;
            one.highlighted = {ghost.path};
            const auto image = render_flare(lens, one, stop);
            if (!image) return false;
            const auto a = picture_moments(image->highlight, image->width_px, pitch_mm);
            const auto b = picture_moments(ghost.layer, image->width_px, pitch_mm);
            rows.push_back(
                {.method = name,
                 .path = ghost.path,
                 .flux_error = a.flux_mm2 / b.flux_mm2 - 1.0,
                 .centroid_shift_px = std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm) / pitch_mm,
                 .size_error = a.rms_radius_mm / b.rms_radius_mm - 1.0});
        }
    return true;
}

/// Light of ghosts of four reflections on the sensor over that of two.
bool measure_four_reflections(const Prescription& lens, const AccuracyRequest& request,
                              const std::stop_token& stop, AccuracyReport& report) {
    constexpr std::size_t traced = 40;
    const auto table = ghost_table(lens,
                                   {.light = request.light,
                                    .spectrum = request.spectrum,
                                    .tolerance = 0.05,
                                    .peaks = false,
                                    .four_reflections = traced,
                                    .threads = request.threads},
                                   stop);
    if (!table) return false;
    double two = 0.0, four = 0.0;
    for (const GhostRow& row : table->ghosts) {
        const bool has_four = row.path.reflections.size() == 4;
        (has_four ? four : two) += row.flux_mm2 * row.on_sensor;
        report.four_reflections_traced += has_four ? 1 : 0;
    }
    report.four_reflections = two > 0.0 ? four / two : none;
    return true;
}

}  // namespace

double time_for_error_ms(const std::vector<AccuracyPoint>& points, const std::string& method,
                         double relative_l1) {
    std::vector<std::pair<double, double>> curve;  // logarithms of error and time
    for (const AccuracyPoint& p : points)
        if (p.method == method && p.errors.relative_l1 > 0.0)
            curve.emplace_back(std::log(p.errors.relative_l1), std::log(p.median_ms));
    std::ranges::sort(curve);
    // Two settings that come to the same error say nothing of a slope.
    const auto same = std::ranges::unique(
        curve, [](const auto& a, const auto& b) { return b.first - a.first < 1e-6; });
    curve.erase(same.begin(), same.end());
    const double at = std::log(relative_l1);
    if (curve.size() < 2 || at < curve.front().first || at > curve.back().first) return none;
    std::size_t k = 1;
    while (k + 1 < curve.size() && curve[k].first < at) ++k;
    const auto [x0, y0] = curve[k - 1];
    const auto [x1, y1] = curve[k];
    return std::exp(std::lerp(y0, y1, (at - x0) / (x1 - x0)));
}

void mark_front(std::vector<AccuracyPoint>& points) {
    auto counts = [](const AccuracyPoint& p) {
        return p.resolved && !p.is_shortcut && !p.is_ablation;
    };
    for (AccuracyPoint& point : points)
        point.on_front =
            counts(point) && std::ranges::none_of(points, [&](const AccuracyPoint& other) {
                return counts(other) && other.median_ms < point.median_ms &&
                       other.errors.relative_l1 < point.errors.relative_l1;
            });
}

std::optional<AccuracyReport> measure_accuracy(
    const Prescription& lens, const AccuracyRequest& request, std::stop_token stop,
    const std::function<void(double, const std::string&)>& progress) {
    auto say = [&](double share, const std::string& what) {
        if (progress) progress(share, what);
    };
    const ReferenceRequest reference = reference_request(request);
    const auto truth = render_reference(
        lens, reference, stop, [&](double share) { say(reference_share * share, "reference"); });
    if (!truth) return std::nullopt;
    AccuracyReport report;
    report.width_px = truth->image.width_px;
    report.height_px = truth->image.height_px;
    report.ghosts = truth->ghosts.size();
    report.reference_tolerance = request.reference_tolerance;
    report.reference_bound = truth->relative_error();
    report.flux_on_sensor_mm2 = truth->image.flux_on_sensor_mm2;
    report.reference_error =
        report.flux_on_sensor_mm2 > 0.0 ? truth->disagreement_mm2 / report.flux_on_sensor_mm2 : 0.0;
    report.reference_ms = truth->image.times.total_ms;
    report.reference_converged = truth->converged;
    report.four_reflections = none;

    const auto families = accuracy_trials(lens, request, stop);
    std::size_t count = 0, done = 0;
    for (const auto& family : families) count += family.size();
    const double allowed_ms = 1e3 * request.budget_s / static_cast<double>(count);
    for (const auto& family : families) {
        double left_ms = allowed_ms * static_cast<double>(family.size());
        double last_ms = 0.0;
        for (const AccuracyTrial& trial : family) {
            say(reference_share + 0.4 * static_cast<double>(done++) / static_cast<double>(count),
                trial.method);
            // A finer setting takes longer than the one before.
            if (last_ms > left_ms) continue;
            const auto began = Clock::now();
            auto point = timed(trial, truth->image, request.most_repeats, allowed_ms);
            if (!point) return std::nullopt;
            last_ms = point->cold_ms;
            left_ms -= ms_since(began);
            report.points.push_back(std::move(*point));
        }
    }
    if (request.shortcuts) {
        struct Shortcut {
            const char* name;
            WeightModel weights;
            TracePrecision precision;
        };
        for (const auto& [name, weights, precision] :
             {Shortcut{"averaged polarisation", WeightModel::averaged,
                       TracePrecision::double_precision},
              Shortcut{"reflections only", WeightModel::reflections_only,
                       TracePrecision::double_precision},
              Shortcut{"single precision", WeightModel::carried,
                       TracePrecision::single_precision}}) {
            say(0.92, name);
            ReferenceRequest simpler = reference;
            for (const ReferenceGhost& ghost : truth->ghosts) simpler.levels.push_back(ghost.level);
            simpler.weights = weights;
            simpler.precision = precision;
            auto point = shortcut(lens, simpler, name, truth->image, stop);
            if (!point) return std::nullopt;
            report.points.push_back(std::move(*point));
        }
        say(0.95, "ghosts of four reflections");
        if (!measure_four_reflections(lens, request, stop, report)) return std::nullopt;
    }
    for (AccuracyPoint& point : report.points)
        // A shortcut is drawn on the reference's own rays: what those get wrong cancels.
        point.resolved = point.is_shortcut ||
                         point.errors.relative_l1 >= resolved_above * report.reference_error;
    mark_front(report.points);
    if (request.ghosts > 0) {
        say(0.97, "ghosts one by one");
        if (!compare_ghosts(lens, request, truth->ghosts, stop, report.by_ghost))
            return std::nullopt;
    }
    say(1.0, "done");
    return report;
}

}  // namespace ghostlight
