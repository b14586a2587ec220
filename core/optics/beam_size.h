#pragma once

#include <span>
#include <vector>

#include "core/optics/prescription.h"

namespace ghostlight {

/// A field in the y-z plane, and the shares of the stop's radius that its beam leaves empty
/// towards +y, towards −y and to both sides.
struct BeamField {
    double field_deg = 0.0;
    double cut_upper = 0.0, cut_lower = 0.0, cut_sides = 0.0;
};

struct BeamSizes {
    std::vector<double> height_mm;  ///< of each row: the largest distance from the axis
    double widest_field_deg = 0.0;  ///< whose chief ray gets through, of those asked for
};

/// How far from the axis the direct beam reaches at each row, at d: real rays, from the chief ray
/// outwards to where the stop, a row of `rims` or total reflection ends the beam. `rims` marks the
/// rows whose semi-diameter limits the beam; the others let everything through. Fields from 0 up.
/// Throws Error for a lens that cannot be compiled.
BeamSizes beam_sizes(const Prescription& lens, std::span<const BeamField> fields,
                     const std::vector<bool>& rims);

}  // namespace ghostlight
