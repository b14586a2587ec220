#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/flare/spectrum.h"
#include "core/ghosts/flux_quadrature.h"
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
    bool peaks = true;  ///< compute peak_per_e0 (needs a raster of each ghost)
    /// At most so many ghosts of four reflections are traced and ranked with the others; 0 = none.
    std::size_t four_reflections = 0;
    unsigned threads = 0;  ///< 0 = all cores; the result does not depend on it
};

/// What the light does at one of a ghost's reflections, means weighted by flux.
struct TurnOfGhost {
    double reflectance = 0.0;
    double incidence_deg = 0.0;          ///< mean angle, in the medium the light comes from
    double largest_incidence_deg = 0.0;  ///< among the rays traced that pass
};

/// Colour of a ghost in light of a spectrum.
struct GhostColor {
    double cie_x = 0.0, cie_y = 0.0;  ///< CIE 1931 chromaticity
    std::string srgb;                 ///< "#ffd2a0": at full brightness, the light itself white
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
    std::array<TurnOfGhost, max_reflections> turns{};  ///< as many as the path has reflections
    std::size_t rays = 0;
    bool converged = true;        ///< false: the error estimate is above what was asked
    double area_mm2 = 0.0;        ///< on the sensor plane, each of a folded ghost's sheets
    double pupil_area_mm2 = 0.0;  ///< of the beam's part that passes, across the beam
    SensorBox box;                ///< around all that arrives on the sensor plane
    /// 1 − pupil area over that of the stop's paraxial image in front of the path (its opening
    /// alone, at its first crossing, seen at the field angle). Below 0 where the exact image is
    /// the larger.
    double vignetting = 0.0;
    std::optional<GhostColor> color;  ///< none for a single wavelength
    ParaxialGhost paraxial;           ///< at the wavelength, or at d for a spectrum
};

/// Ghosts of four reflections that were not traced.
struct NotTraced {
    std::size_t count = 0;
    double flux_bound_mm2 = 0.0;  ///< together at most (see strongest_four_reflections)
};

struct GhostTable {
    GhostRow direct;
    std::vector<GhostRow> ghosts;  ///< strongest first
    NotTraced not_traced;
    std::size_t rays = 0;
    double seconds = 0.0;
    LightDirection light;
    std::string spectrum;
    std::size_t surface_count = any_surface_count;  ///< rows of the lens; the next is the sensor
    std::vector<std::string> media;  ///< in front of each row, and in front of the sensor
    std::string sensor_medium;       ///< what is behind its face
    /// Irradiance / E0 of the sun's own image, a disc of 0.533° for the same direct flux; NaN
    /// where there is no image.
    double sun_image_per_e0 = std::numeric_limits<double>::quiet_NaN();
    /// Flux of all ghosts inside the sensor over that of the image; NaN where there is none.
    double veiling_fraction = std::numeric_limits<double>::quiet_NaN();
};

/// Called from any thread with the share done, 0 to 1.
using Progress = std::function<void(double)>;

/// Throws Error for a lens or wavelength that cannot be compiled. Returns nothing when stopped.
std::optional<GhostTable> ghost_table(const Prescription& lens, const GhostTableRequest& request,
                                      std::stop_token stop = {}, const Progress& progress = {});

}  // namespace ghostlight
