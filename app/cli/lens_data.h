#pragma once

#include <string>
#include <vector>

#include "core/io/table.h"
#include "core/optics/optical_system.h"

namespace ghostlight::cli {

/// One of a lens's first-order data, with what it means in a few words.
struct LensQuantity {
    std::string name;
    Cell value;
    std::string meaning;
};
std::vector<LensQuantity> lens_quantities(const OpticalSystem& system);

/// Marginal and chief ray by surface; the chief ray goes to the sensor's corner.
Table paraxial_ray_rows(const OpticalSystem& system);

/// Distortion, vignetting, illumination from the axis to the sensor's corner.
Table field_curve_rows(const OpticalSystem& system, int points);

}  // namespace ghostlight::cli
