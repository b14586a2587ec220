#pragma once

#include <vector>

#include "core/optics/optical_system.h"

namespace ghostlight {

/// A paraxial ray at a surface.
struct ParaxialRayAt {
    double y_mm = 0.0;
    double u = 0.0;          ///< slope dy/dz behind the surface
    double incidence = 0.0;  ///< u + y c in front of it, rad to first order
};

/// The marginal ray (from the axis at infinity through the stop's edge) and the chief ray (from the
/// field's edge through the stop's centre) at a surface, or on the sensor in the last entry.
struct ParaxialRaysAt {
    ParaxialRayAt marginal, chief;
    /// n (u y_chief − u_chief y): the same behind every surface.
    double lagrange_mm = 0.0;
};

/// By surface, and on the sensor. `field_tangent` is the chief ray's slope in front of the lens.
std::vector<ParaxialRaysAt> paraxial_rays(const OpticalSystem& system, double field_tangent);

}  // namespace ghostlight
