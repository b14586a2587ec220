#pragma once

#include <cstddef>

#include "core/optics/prescription.h"

namespace ghostlight {

/// Height at which a sphere or an ellipsoid ends, mm; infinite for what has no end.
double edge_height_mm(const Surface& surface);

/// What two neighbouring surfaces have in common at their rims.
struct RimGap {
    double height_mm = 0.0;  ///< of the narrower rim
    double gap_mm = 0.0;     ///< along the axis there; negative where they cross
    /// They cross by more than the hair that rounded listings of touching surfaces do.
    bool crosses() const;
};
/// Between surface `row` and the next.
RimGap rim_gap(const Prescription& lens, std::size_t row);

}  // namespace ghostlight
