#pragma once

#include <vector>

#include "core/flare/aperture_outline.h"
#include "core/optics/optical_system.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// How open a stop is, on a square of pixels over −1 … 1 semi-diameters; row 0 the lowest y.
struct MaskRaster {
    int across = 0;
    std::vector<float> open;  ///< 0 to 1
    double pitch() const { return 2.0 / across; }
    /// Σ open × pitch², in squared semi-diameters.
    double area() const;
};

/// Blades, image, dirt and, if there is one, what else limits the beam, with the edges' coverage
/// of pixels. The dirt is the same at every number of pixels. Throws Error where more specks are
/// asked for than can be drawn.
MaskRaster mask_raster(const StopMask& mask, const StopDirt& dirt, int across,
                       const ApertureOutline* beam = nullptr);

/// What dirt leaves of a stop's light: of a raster with it, over one without.
double clear_share(const StopMask& mask, const StopDirt& dirt);

}  // namespace ghostlight
