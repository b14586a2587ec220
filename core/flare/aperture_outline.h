#pragma once

#include <glm/vec2.hpp>

#include <complex>
#include <span>
#include <vector>

#include "core/optics/optical_system.h"

namespace ghostlight {

/// The edge of an opening as a polygon, counter-clockwise, in semi-diameters of the stop. Where the
/// edge is curved it is followed by chords, whose joints are marked as smooth.
struct ApertureOutline {
    std::vector<glm::dvec2> corners;
    std::vector<char> is_smooth;  ///< by corner: the edge goes round here, it does not turn
    bool is_unit_circle = false;  ///< `corners` only stand for it

    double area() const;
    double perimeter() const;
};

/// The blades' opening, without image and dirt. A stop of many blades or of fully curved ones is a
/// circle. Chords leave `sagitta` of a curved blade at most.
ApertureOutline outline_of(const StopMask& mask, double sagitta = 1.2e-3);

/// What two convex openings leave: the corners of the one that lie in the other, and the crossings.
ApertureOutline intersection(const ApertureOutline& of, const ApertureOutline& with);

/// Fourier transform of a polygon, ∫∫ exp(−i k·r) dA, by the divergence theorem: (i/k²) Σ (k × d)
/// sinc(k·d/2) exp(−i k·m) over edges d with middles m (Lee and Mittra 1983; Komrska 1982). Exact
/// but for rounding; for |k| → 0 by the polygon's moments, for k·d → 0 by the series of sinc.
std::complex<double> polygon_transform(std::span<const glm::dvec2> corners, glm::dvec2 k);

}  // namespace ghostlight
