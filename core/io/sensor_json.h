#pragma once

#include "core/io/json_value.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// Reads a sensor's reflectance: a share, {"table": [[nm, share], …]} or {"layers": […],
/// "substrate": {medium}}. Fields that are not known go to `unknown`. Throws Error.
SensorReflectance read_sensor_reflectance(const JsonAt& value, UnknownFields& unknown);

/// The reverse.
Json write_sensor_reflectance(const SensorReflectance& reflectance);

}  // namespace ghostlight
