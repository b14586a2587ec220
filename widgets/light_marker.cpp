#include "widgets/light_marker.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace ghostlight {

glm::dvec2 light_on_sensor_mm(const LightDirection& light, double efl_mm) {
    const double field = std::clamp(light.field_deg, -89.99, 89.99);
    const double radius = efl_mm * std::tan(rad_from_deg(field));
    const double azimuth = rad_from_deg(light.azimuth_deg);
    return {radius * std::cos(azimuth), radius * std::sin(azimuth)};
}

LightDirection light_at_sensor_mm(glm::dvec2 point_mm, double efl_mm, double azimuth_deg) {
    // A negative focal length images the light on the other side.
    const double side = efl_mm < 0.0 ? -1.0 : 1.0;
    const double radius = std::hypot(point_mm.x, point_mm.y);
    LightDirection light{0.0, azimuth_deg};
    if (radius > 0.0) {
        const double field = deg_from_rad(std::atan2(radius, std::abs(efl_mm)));
        light.field_deg = std::min(field, most_dragged_field_deg);
        light.azimuth_deg = deg_from_rad(std::atan2(side * point_mm.y, side * point_mm.x));
    }
    return light;
}

}  // namespace ghostlight
