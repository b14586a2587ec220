#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/flare/ghost_sampling.h"

namespace ghostlight {

/// A picture to compare others with. Every ghost is drawn at two levels of sampling that share no
/// ray (ghost_sampling.h), and finer ones are taken until the two agree.
struct ReferenceRequest {
    LightDirection light;
    double disc_diameter_deg = 0.0;  ///< angular diameter of an even disc; 0 = a point
    Spectrum spectrum = Monochromatic{};
    int width_px = 1280;
    /// Sum over the ghosts of the L1 distance between the two samplings' irradiance on the sensor,
    /// over the light there.
    double tolerance = 0.005;
    /// Paths of any number of reflections; empty = all of two, the sensor's among them.
    std::vector<GhostPath> only;
    bool layers = false;                 ///< keep each ghost's own picture
    std::vector<GhostPath> highlighted;  ///< these also go into FlareImage::highlight
    WeightModel weights = WeightModel::carried;
    TracePrecision precision = TracePrecision::double_precision;
    /// Of each path, in their order: levels to draw at, instead of by the errors. Pictures drawn at
    /// the same levels have the same sampling errors, and differ by their physics alone.
    std::vector<int> levels;
    int finest_level = 14;  ///< of sampling_level(): 3072 cells across
    unsigned threads = 0;   ///< 0 = all cores; the result does not depend on it
};

/// One ghost of the reference; fluxes over E0, mm².
struct ReferenceGhost {
    GhostPath path;
    double flux_mm2 = 0.0, flux_error_mm2 = 0.0;            ///< on the whole sensor plane
    double on_sensor_mm2 = 0.0, on_sensor_error_mm2 = 0.0;  ///< on the sensor
    double allowance_mm2 = 0.0;
    double error_mm2 = 0.0;  ///< L1 distance of the two samplings on the sensor
    int level = 0;           ///< of the finer one, which is the picture
    SamplingLevel sampling;  ///< what that level is
    std::size_t rays = 0;
    bool converged = true;     ///< false: the finest level was reached before the allowance
    std::vector<float> layer;  ///< irradiance, row by row, if asked for
};

struct ReferenceImage {
    FlareImage image;          ///< its plan says what each ghost took
    std::vector<float> error;  ///< a pixel's sum over the ghosts of |difference|, irradiance / E0
    std::vector<ReferenceGhost> ghosts;
    double error_mm2 = 0.0;         ///< Σ of the ghosts' errors
    double disagreement_mm2 = 0.0;  ///< L1 distance of the two whole pictures: errors cancel there
    bool converged = true;
    /// The error over the light on the sensor; 0 where there is none.
    double relative_error() const;
};

/// Throws Error like compile(). Returns nothing when stopped. `progress` is called from any thread
/// with the share done. Memory: a few pictures for each thread, whatever the number of ghosts and
/// the level. Sums are in fixed point, so that their order does not matter.
std::optional<ReferenceImage> render_reference(const Prescription& lens,
                                               const ReferenceRequest& request,
                                               std::stop_token stop = {},
                                               const std::function<void(double)>& progress = {});

}  // namespace ghostlight
