#include "core/fit/light_place.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/ghosts/cells.h"
#include "core/ghosts/pupil.h"

namespace ghostlight {
namespace {

constexpr int cells = 16;
constexpr double widest_deg = 89.0;

}  // namespace

std::optional<SensorPoint> image_of_light(const OpticalSystem& system,
                                          const LightDirection& light) {
    const BeamFrame frame = beam_frame(light);
    const auto path = trace_path<double>(system, GhostPath{});
    const Pupil pupil = find_pupil(system, path, frame, PupilSearch::quick);
    if (pupil.empty()) return std::nullopt;
    Bundle<double> rays;
    lay_grid(pupil.box, cells, rays);
    const auto field = trace_field(system, path, frame, std::move(rays), Weights::none);
    double x = 0.0, y = 0.0, count = 0.0;
    for (std::size_t i = 0; i < field.rays.size(); ++i) {
        bool passes = true;
        for (const auto& clearance : field.clearances) passes = passes && clearance[i] >= 0.0;
        if (!passes) continue;
        x += field.rays.x_mm[i];
        y += field.rays.y_mm[i];
        count += 1.0;
    }
    if (count == 0.0) return std::nullopt;
    return SensorPoint{x / count, y / count};
}

LightDirection light_imaged_at(const OpticalSystem& system, const SensorPoint& point) {
    const double radius_mm = std::hypot(point.x_mm, point.y_mm);
    // An image lies opposite of where the light comes from or not, by the lens.
    const auto probe = image_of_light(system, {1.0, 90.0});
    if (!probe) throw Error("no light passes through the lens along the direct path");
    const double side = probe->y_mm >= 0.0 ? 1.0 : -1.0;
    const double azimuth_deg = radius_mm > 0.0 ? std::atan2(side * point.y_mm, side * point.x_mm) *
                                                     180.0 / std::numbers::pi
                                               : 90.0;
    if (radius_mm < 1e-9) return {0.0, 90.0};
    auto radius_at = [&](double field_deg) -> double {
        const auto image = image_of_light(system, {field_deg, 90.0});
        return image ? side * image->y_mm : std::numeric_limits<double>::infinity();
    };
    double low = 0.0, high = 1.0;
    while (radius_at(high) < radius_mm && high < widest_deg) {
        low = high;
        high = std::min(widest_deg, 1.5 * high);
    }
    for (int k = 0; k < 40 && high - low > 1e-9; ++k) {
        const double middle = 0.5 * (low + high);
        (radius_at(middle) < radius_mm ? low : high) = middle;
    }
    // At the edge of what passes, the bisection ends where there is no such image.
    if (!(std::abs(radius_at(low) - radius_mm) < 0.01 * radius_mm + 0.05))
        throw Error({.problem = "no light through this lens makes an image there",
                     .file = {},
                     .where = {},
                     .found = fmt::format("{:.3f} mm from the axis", radius_mm),
                     .expected = "a place inside the lens's image circle; the sensor's size, the "
                                 "picture's width or the lens may not belong to this photograph"});
    return {0.5 * (low + high), azimuth_deg};
}

}  // namespace ghostlight
