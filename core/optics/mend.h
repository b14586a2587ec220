#pragma once

#include "core/optics/prescription.h"

namespace ghostlight {

// What is proposed for the common slips of lens listings.

/// Every length times a factor, coefficients and configurations included. What the source states
/// (published) stays; a sensor of 36 x 24 mm too, as that is what is assumed where none is given.
/// Throws Error for a factor that is not above 0.
Prescription scaled(const Prescription& lens, double factor);

/// Semi-diameters that are diameters, halved; those sized from the beam stay.
Prescription with_halved_semi_diameters(const Prescription& lens);

/// Radii that are curvatures, and the reverse: each is replaced by its inverse.
Prescription with_radii_as_curvatures(const Prescription& lens);

}  // namespace ghostlight
