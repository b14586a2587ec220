#pragma once

#include <optional>

#include "core/optics/optical_system.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// The meridional ray (azimuth 90°) that crosses the stop's plane at `stop_v_mm`, followed to the
/// sensor; nothing where no ray gets there.
std::optional<TracedRay> ray_through_stop(const OpticalSystem& system, double field_deg,
                                          double stop_v_mm);

/// Sine of the image-space angle of the on-axis ray through the stop's edge, and what follows.
struct Aperture {
    double numerical_aperture = 0.0;  ///< n' sin u'
    double working_f_number = 0.0;    ///< 1 / (2 n' sin u')
};
/// Nothing where that ray does not get through.
std::optional<Aperture> real_aperture(const OpticalSystem& system);

/// The field angle whose chief ray meets the sensor plane at a distance from the axis, degrees;
/// nothing where none does.
std::optional<double> field_at_height_deg(const OpticalSystem& system, double height_mm);

/// The widest field angle, in whole degrees, up to which chief rays get to the sensor plane.
double widest_field_deg(const OpticalSystem& system);

}  // namespace ghostlight
