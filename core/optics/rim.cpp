#include "core/optics/rim.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ghostlight {

double edge_height_mm(const Surface& surface) {
    const double c = curvature_per_mm(surface.curve);
    const double bend = (1.0 + surface.conic) * c * c;
    return bend > 0.0 ? 1.0 / std::sqrt(bend) : std::numeric_limits<double>::infinity();
}

bool RimGap::crosses() const {
    constexpr double hair = 1e-3;  // of the height
    return gap_mm < -hair * height_mm;
}

RimGap rim_gap(const Prescription& lens, std::size_t row) {
    const Surface& front = lens.surfaces[row];
    const Surface& back = lens.surfaces[row + 1];
    const double h = std::min(front.semi_diameter_mm, back.semi_diameter_mm);
    return {h, front.thickness_mm + sag_mm(back, h) - sag_mm(front, h)};
}

}  // namespace ghostlight
