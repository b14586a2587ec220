#pragma once

#include "core/io/table.h"
#include "core/optics/optical_system.h"

namespace ghostlight::cli {

/// Marginal and chief ray by surface; the chief ray goes to the sensor's corner.
Table paraxial_ray_rows(const OpticalSystem& system);

/// Distortion, vignetting, illumination from the axis to the sensor's corner.
Table field_curve_rows(const OpticalSystem& system, int points);

}  // namespace ghostlight::cli
