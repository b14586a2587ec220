#pragma once

#include <vector>

#include "core/flare/plan_report.h"

namespace ghostlight {

/// What a ghost layer has of diffraction, and what it has not: fringes at rims that are switched
/// off, or finer than a pixel, and the starburst, a layer of its own.
std::vector<Omission> diffraction_omissions(const FlareScene& scene, const FlareRequest& request,
                                            const FlarePlan& plan);

/// L1 change that fringes at the rim of an even ellipse make, in units of its light, once pixels
/// have averaged them: what a straight edge moves into its shadow, 1/(2π) of the fringes' unit of
/// length a length of rim, is missing from the lit side. `width` is that unit, √(λz/2), and
/// `spot` the ellipse's, in the same unit of length.
double fringes_change(const GhostSpot& spot, double width_mm);

/// Share of a round pupil's diffracted light that lands further than v = 2πa r/(λB) from the middle
/// of its Airy pattern: J₀²(v) + J₁²(v) (Born and Wolf, Principles of Optics, §8.5.2).
double beyond_airy(double v);

}  // namespace ghostlight
