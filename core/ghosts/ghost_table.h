#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/flare/spectrum.h"
#include "core/ghosts/ghost_path.h"
#include "core/optics/paraxial.h"
#include "core/optics/prescription.h"
#include "core/optics/trace.h"

namespace ghostlight {

struct GhostTableRequest {
    LightDirection light;
    Spectrum spectrum = Monochromatic{};
    /// Each flux is refined until its own error estimate is below this share of the row, or 1e-6
    /// of the strongest ghost, whichever is larger.
    double tolerance = 0.01;
    bool peaks = true;     ///< compute peak_per_e0 (needs a raster of each ghost)
    unsigned threads = 0;  ///< 0 = all cores; the result does not depend on it
};

/// One path of the table. Fluxes are per unit irradiance E0 perpendicular to the beam.
struct GhostRow {
    GhostPath path;
    double flux_mm2 = 0.0;        ///< polarisation carried
    double flux_error_mm2 = 0.0;  ///< the quadrature's own estimate, absolute
    double relative_flux = 0.0;   ///< over the direct path's flux; NaN when that is 0
    double peak_per_e0 = 0.0;     ///< largest mean irradiance over a cell of sensor width / 1280
    double centroid_x_mm = 0.0, centroid_y_mm = 0.0;
    double rms_radius_mm = 0.0;
    double on_sensor = 0.0;  ///< share of the flux inside the sensor's rectangle
    double reflectance_1 = 0.0, reflectance_2 = 0.0;  ///< mean R at the two reflections
    std::size_t rays = 0;
    bool converged = true;  ///< false: the error estimate is above what was asked
};

struct GhostTable {
    GhostRow direct;
    std::vector<GhostRow> ghosts;  ///< strongest first
    std::size_t rays = 0;
    double seconds = 0.0;
    LightDirection light;
    std::string spectrum;
};

/// Called from any thread with the share done, 0 to 1.
using Progress = std::function<void(double)>;

/// Throws Error for a lens or wavelength that cannot be compiled. Returns nothing when stopped.
std::optional<GhostTable> ghost_table(const Prescription& lens, const GhostTableRequest& request,
                                      std::stop_token stop = {}, const Progress& progress = {});

}  // namespace ghostlight
