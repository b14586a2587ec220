#include "core/flare/dirt_statistics.h"

#include <cmath>

#include "core/flare/mask_raster.h"

namespace ghostlight {

double expected_specks(const StopDirt& dirt, double semi_diameter_mm) {
    if (!(dirt.dust_coverage > 0.0)) return 0.0;
    const double small = dirt.dust_smallest_mm, large = dirt.dust_largest_mm;
    const double spread = std::log(large / small);
    const double mean_square =
        spread > 0.0 ? (large * large - small * small) / (2.0 * spread) : small * small;
    return -std::log1p(-dirt.dust_coverage) * semi_diameter_mm * semi_diameter_mm /
           (0.25 * mean_square);
}

DirtStatistics dirt_statistics(const StopMask& mask, const StopDirt& dirt) {
    DirtStatistics found;
    found.specks = expected_specks(dirt, mask.semi_diameter_mm);
    found.scratches = dirt.scratches;
    const auto taken_by = [&](StopDirt alone) { return 1.0 - clear_share(mask, alone); };
    if (dirt.dust_coverage > 0.0) {
        StopDirt dust = dirt;
        dust.scratches = 0;
        dust.fingerprint = 0.0;
        found.dust_share = taken_by(dust);
    }
    if (dirt.scratches > 0) {
        StopDirt scratches = dirt;
        scratches.dust_coverage = 0.0;
        scratches.fingerprint = 0.0;
        found.scratch_share = taken_by(scratches);
    }
    if (dirt.fingerprint > 0.0) {
        StopDirt print = dirt;
        print.dust_coverage = 0.0;
        print.scratches = 0;
        found.print_share = taken_by(print);
    }
    found.clear_share = clear_share(mask, dirt);
    return found;
}

int starburst_arms(const Stop& stop) {
    const bool round = stop.blades < 3 || stop.blade_curvature >= 1.0;
    return round ? 0 : stop.blades % 2 == 0 ? stop.blades : 2 * stop.blades;
}

}  // namespace ghostlight
