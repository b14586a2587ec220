#pragma once

#include <map>
#include <vector>

#include "core/optics/prescription.h"

namespace ghostlight {

/// A surface of revolution: a conic and any powers of the distance r from the axis,
/// sag = conic(r) + Σ a_p r^p, a_p in mm^(1−p).
struct RadialSurface {
    double curvature_per_mm = 0.0;
    double conic = 0.0;
    std::map<int, double> terms;  ///< power ≥ 1 → a_p
};

/// The same as the trace has it: curve, conic, A4, A6, ….
struct EvenAsphere {
    BaseCurve curve = Plane{};
    double conic = 0.0;
    std::vector<double> aspheric;
    bool exact = true;
    double sag_error_mm = 0.0;  ///< largest over the clear radius
    double slope_error = 0.0;   ///< largest |dz/dr| error there
};

/// Even powers from r⁴ to r⁴² are taken as they are. A term in r² or an odd one is replaced by the
/// even polynomial (to r²⁴, and a changed vertex curvature) that is nearest in the least-squares
/// sense within the clear radius, or within the conic's edge where that is nearer. Throws Error
/// for a clear radius that is not above 0 or a power below 1.
EvenAsphere even_asphere(const RadialSurface& surface, double clear_radius_mm);

}  // namespace ghostlight
