#include "core/optics/real_rays.h"

#include <cmath>
#include <vector>

#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double aim_mm = 1e-9;  ///< how close to the point on the stop
constexpr int most_steps = 60;
constexpr double widest_deg = 89.0, step_deg = 1.0;  ///< of a scan over the field

/// A ray of the beam by its height v across the beam (a fisheye's beams do not meet z = 0 well).
TracedRay trace_at(const OpticalSystem& system, double field_deg, double v_mm) {
    const BeamFrame frame = beam_frame({field_deg, 90.0});
    return trace_ray(system, {}, {v_mm * frame.e2, frame.direction});
}

}  // namespace

std::optional<TracedRay> ray_through_stop(const OpticalSystem& system, double field_deg,
                                          double stop_v_mm) {
    // Bracket on a scan across the first surface, then bisection: no derivative to fail at the rim.
    const double reach = 1.5 * system.surfaces.front().semi_diameter_mm;
    constexpr int scan = 240;
    double before_v = 0.0, before_miss = 0.0;
    bool has_before = false;
    std::optional<std::pair<double, double>> bracket;
    double nearest = reach;
    for (int k = 0; k <= scan; ++k) {
        const double v = reach * (2.0 * k / scan - 1.0);
        const TracedRay ray = trace_at(system, field_deg, v);
        if (!ray.status.reaches_sensor()) {
            has_before = false;
            continue;
        }
        const double miss = ray.stop_point.y - stop_v_mm;
        // Of several, the one nearest to the axis.
        if (has_before && (miss < 0.0) != (before_miss < 0.0) &&
            std::abs(v) < nearest + reach / scan) {
            bracket = {before_v, v};
            nearest = std::abs(v);
        }
        before_v = v;
        before_miss = miss;
        has_before = true;
    }
    if (!bracket) return std::nullopt;
    auto [low, high] = *bracket;
    const bool low_is_negative = trace_at(system, field_deg, low).stop_point.y < stop_v_mm;
    TracedRay ray;
    for (int step = 0; step < most_steps; ++step) {
        const double middle = 0.5 * (low + high);
        ray = trace_at(system, field_deg, middle);
        const double miss = ray.stop_point.y - stop_v_mm;
        if (std::abs(miss) <= aim_mm) break;
        ((miss < 0.0) == low_is_negative ? low : high) = middle;
    }
    return ray;
}

std::optional<Aperture> real_aperture(const OpticalSystem& system) {
    const auto ray = ray_through_stop(system, 0.0, system.stop_mask.semi_diameter_mm);
    if (!ray) return std::nullopt;
    const double sine = std::hypot(ray->direction.x, ray->direction.y);
    const double na = system.surfaces.back().n_after * sine;
    return Aperture{na, 1.0 / (2.0 * na)};
}

double widest_field_deg(const OpticalSystem& system) {
    double widest = 0.0;
    while (widest + step_deg <= widest_deg && ray_through_stop(system, widest + step_deg, 0.0))
        widest += step_deg;
    return widest;
}

std::optional<double> field_at_height_deg(const OpticalSystem& system, double height_mm) {
    auto height = [&](double field_deg) -> std::optional<double> {
        const auto ray = ray_through_stop(system, field_deg, 0.0);
        if (!ray) return std::nullopt;
        return std::abs(ray->sensor_point.y);
    };
    double low = 0.0;
    for (double field = step_deg; field <= widest_deg; field += step_deg) {
        const auto at = height(field);
        if (!at) return std::nullopt;
        if (*at < height_mm) {
            low = field;
            continue;
        }
        double high = field;
        for (int k = 0; k < 40; ++k) {
            const double middle = 0.5 * (low + high);
            const auto there = height(middle);
            (there && *there < height_mm ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }
    return std::nullopt;
}

}  // namespace ghostlight
