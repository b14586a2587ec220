#pragma once

#include <vector>

#include "core/affine.h"
#include "core/ghosts/bundle.h"
#include "core/ghosts/pupil.h"

namespace ghostlight {

/// A path made ready for proofs.
struct ProofPath {
    struct Step {
        TraceStep<double> event;
        double limit_mm = 0.0;  ///< rays that count pass within: clear radius, or the stop's
        Interval sag_mm;        ///< of the surface within that limit
    };
    std::vector<Step> steps;
    std::vector<double> aspheric;
    double sensor_gap_mm = 0.0;
    double sensor_radius_mm = 0.0;  ///< of the circle about its corners
};
ProofPath proof_path(const OpticalSystem& system, const GhostPath& ghost);

/// What is proven of the rays that enter through a rectangle. It holds for exact arithmetic, all
/// rounding of the proof's own arithmetic included.
struct CellVerdict {
    /// False: every ray misses, is totally reflected where it must transmit, turns round, lies
    /// beyond a clear radius or outside the stop's circle, or (on request) lands beside the sensor.
    bool may_pass = true;
    /// False: the proof got no further, or the rectangle was narrowed so much that it stopped.
    bool complete = false;
    PupilBox live;  ///< rays that pass lie in this part of the rectangle
    /// Cosines of incidence at the first two reflections, of rays that pass.
    Interval cosine[2] = {{0.0, 1.0}, {0.0, 1.0}};
    Interval sensor_x_mm, sensor_y_mm;  ///< of rays that pass; if complete
};

/// Follows a rectangle of the entrance plane along the path by affine forms. The stop counts as
/// its circle. With `on_sensor` only rays within the circle about the sensor's corners pass.
CellVerdict prove_cell(const ProofPath& path, const BeamFrame& frame, const PupilBox& cell,
                       bool on_sensor);

}  // namespace ghostlight
