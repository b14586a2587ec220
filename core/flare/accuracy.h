#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"
#include "core/flare/picture_errors.h"

namespace ghostlight {

/// Another engine that is measured beside the CPU's: the core knows no OpenGL.
struct AccuracyEngine {
    std::string name;
    /// Draws a planned picture, as render_planned() does; nothing when stopped.
    std::function<std::optional<FlareImage>(const FlareScene&, const FlareRequest&,
                                            std::stop_token)>
        draw;
};

/// Error against run time: every method at every setting of its knob against the reference.
struct AccuracyRequest {
    LightDirection light;
    Spectrum spectrum = Monochromatic{};
    int width_px = 1280;
    double reference_tolerance = 0.005;
    double budget_s = 60.0;  ///< for the timed frames; what would go beyond it is left out
    int most_repeats = 15;   ///< timed frames of a setting, after one that is cold
    bool shortcuts = true;   ///< measure what each simplification of the physics costs
    bool ablations = true;   ///< measure the planned method without each of its economies
    std::size_t ghosts = 5;  ///< strongest ghosts whose light, place and size are compared
    unsigned threads = 0;    ///< 0 = all cores
    std::vector<AccuracyEngine> engines = {};
};

/// One setting of one method.
struct AccuracyPoint {
    std::string method;    ///< "planned", "uniform", …
    std::string knob;      ///< what was turned: "tolerance", "grid", …; empty for none
    double setting = 0.0;  ///< NaN for none
    double cold_ms = 0.0;  ///< the first frame, with all that is kept for the next ones
    double median_ms = 0.0, p95_ms = 0.0;  ///< of the later frames
    int repeats = 0;
    std::size_t rays = 0;
    PictureErrors errors;
    /// What the plan itself accounts for (bounded_error() in plan_report.h); NaN without a plan.
    double plan_bound = std::numeric_limits<double>::quiet_NaN();
    /// False where the error is less than three times the reference's own.
    bool resolved = true;
    /// Nothing measured is both faster and closer.
    bool on_front = false;
    /// A simplification of the physics, drawn by the reference: its time means nothing.
    bool is_shortcut = false;
    /// The planned method without one of its economies.
    bool is_ablation = false;
};

/// One ghost by one method against the reference.
struct GhostAccuracy {
    std::string method;
    GhostPath path;
    double flux_error = 0.0;  ///< picture over reference on the sensor, − 1
    double centroid_shift_px = 0.0;
    double size_error = 0.0;  ///< RMS radius over the reference's, − 1
};

struct AccuracyReport {
    int width_px = 0, height_px = 0;
    std::size_t ghosts = 0;
    double reference_tolerance = 0.0;
    double reference_bound = 0.0;  ///< Σ of its ghosts' errors over the light
    double reference_error = 0.0;  ///< L1 distance of its two whole pictures over the light
    double reference_ms = 0.0;
    bool reference_converged = true;
    double flux_on_sensor_mm2 = 0.0;
    std::vector<AccuracyPoint> points;
    std::vector<GhostAccuracy> by_ghost;
    /// Light of the strongest ghosts of four reflections on the sensor, over that of two; NaN if
    /// it was not measured.
    double four_reflections = 0.0;
    std::size_t four_reflections_traced = 0;
};

/// Below this many times the reference's error a point says nothing.
inline constexpr double resolved_above = 3.0;

/// Throws Error like compile(). Returns nothing when stopped. `progress` gets the share done and
/// what is being measured.
std::optional<AccuracyReport> measure_accuracy(
    const Prescription& lens, const AccuracyRequest& request, std::stop_token stop = {},
    const std::function<void(double, const std::string&)>& progress = {});

/// What a frame of a method takes for an error, by its settings that were timed, ms: linear between
/// them in both logarithms. NaN beyond the outer ones.
double time_for_error_ms(const std::vector<AccuracyPoint>& points, const std::string& method,
                         double relative_l1);

/// Marks the points that nothing is both faster and closer than, among those that are resolved
/// neither shortcuts nor ablations.
void mark_front(std::vector<AccuracyPoint>& points);

}  // namespace ghostlight
