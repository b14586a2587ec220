#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// What rounding does to one ray on its way, to first order.
struct RayCondition {
    /// ∂(x, y on the sensor) / ∂(u, v on the plane across the beam), row by row.
    std::array<double, 4> by_entrance{};
    /// Displacement on the sensor, mm, over the unit of rounding: root of the sum of squares over
    /// all meetings of ∂(sensor point) / ∂(position and direction after it) times their size (the
    /// largest length that was added up there; 1 for a direction). N. J. Higham, Accuracy and
    /// Stability of Numerical Algorithms, ch. 3.
    double amplification_mm = 0.0;
    bool valid = false;  ///< the ray reaches the sensor plane
};
/// For the ray through (u, v) mm of the plane across the beam, by automatic derivatives of every
/// meeting.
RayCondition ray_condition(const OpticalSystem& system, const GhostPath& path,
                           const BeamFrame& frame, double u_mm, double v_mm);

/// How well one ghost can be traced in single precision, and what averaging its polarisation costs.
struct PathStability {
    GhostPath path;
    std::size_t rays = 0;    ///< that pass in double: weights are compared over these
    std::size_t landed = 0;  ///< of them, within the circle around the sensor: for positions
    double position_worst_mm = 0.0, position_rms_mm = 0.0;  ///< float against double
    double weight_worst = 0.0, weight_rms = 0.0;            ///< relative, where they have a weight
    /// Rays that pass in one precision only, of those that pass in double.
    double fates_differ = 0.0;
    double amplification_mm = 0.0;  ///< largest of some of the rays that land there
    /// (R_s + R_p) / 2 at every surface over the polarisation carried, flux over flux, − 1.
    double averaging_error = 0.0;
    double flux_mm2 = 0.0;  ///< of the grid's rays, for ranking
};

/// Unit of rounding of single precision.
inline constexpr double float_rounding = 0x1p-24;
/// Displacement by rounding, of a sensor 1280 pixels wide, above which a ghost should not be traced
/// in single precision.
inline constexpr double ill_conditioned_px = 0.1;
/// Whether single precision moves a ghost's rays, as measured or as its amplification predicts, by
/// more than that.
bool is_ill_conditioned(const PathStability& ghost, double sensor_width_mm);

/// Every path, on a grid over where it enters. Empty paths (nothing passes) have no rays. Returns
/// nothing when stopped; `progress` is called from any thread with the share done.
std::optional<std::vector<PathStability>> stability_of(
    const OpticalSystem& system, const LightDirection& light, const std::vector<GhostPath>& paths,
    unsigned threads = 0, std::stop_token stop = {},
    const std::function<void(double)>& progress = {});

}  // namespace ghostlight
