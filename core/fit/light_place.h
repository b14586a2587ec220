#pragma once

#include <optional>

#include "core/optics/optical_system.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// A point of the sensor, mm from the axis.
struct SensorPoint {
    double x_mm = 0.0, y_mm = 0.0;
};

/// Where the light's own image lies: the mean of the rays of the direct path that pass. Nothing
/// where none does.
std::optional<SensorPoint> image_of_light(const OpticalSystem& system, const LightDirection& light);

/// The direction whose image lies at a point of the sensor. Throws Error where no field angle up to
/// 89° images there.
LightDirection light_imaged_at(const OpticalSystem& system, const SensorPoint& point);

}  // namespace ghostlight
