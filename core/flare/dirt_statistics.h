#pragma once

#include "core/optics/optical_system.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// How many specks of dust cover the share that is asked for of a stop of `semi_diameter_mm`:
/// thrown at random, with diameters evenly spread in their logarithm, they leave exp(−Σ areas / the
/// circle's) of it free. 0 without dust.
double expected_specks(const StopDirt& dirt, double semi_diameter_mm);

/// What lies on a stop, kind by kind.
struct DirtStatistics {
    double specks = 0.0;  ///< expected_specks()
    int scratches = 0;
    /// Share of the light through the opening that each kind takes by itself, 0 to 1.
    double dust_share = 0.0, scratch_share = 0.0, print_share = 0.0;
    double clear_share = 1.0;  ///< what all of them leave, together
};

/// Throws Error where more specks are asked for than can be drawn, as mask_raster() does.
DirtStatistics dirt_statistics(const StopMask& mask, const StopDirt& dirt);

/// Arms of the starburst that an opening's straight or curved edges send out: each edge one to
/// either side, which coincide where edges are parallel. 0 for a circle.
int starburst_arms(const Stop& stop);

}  // namespace ghostlight
