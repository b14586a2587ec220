#pragma once

#include <glm/vec2.hpp>

#include "core/optics/trace.h"

namespace ghostlight {

/// Largest field angle that a drag gives; at 90° the light's place on the sensor is infinitely far.
inline constexpr double most_dragged_field_deg = 89.0;

/// Where a lens of this focal length and no distortion images a light at infinity, mm on the
/// sensor: f tanθ (cosφ, sinφ).
glm::dvec2 light_on_sensor_mm(const LightDirection& light, double efl_mm);

/// The reverse. `azimuth_deg` is kept for a point on the axis, which has none.
LightDirection light_at_sensor_mm(glm::dvec2 point_mm, double efl_mm, double azimuth_deg);

}  // namespace ghostlight
