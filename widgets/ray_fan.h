#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"
#include "core/optics/trace.h"
#include "widgets/layout_scene.h"

namespace ghostlight {

/// What a stretch of a ray is: part of the direct image, or of a ghost before its first
/// reflection, between its reflections, after its last one; or of a ray that is stopped.
enum class RayLeg { direct, in, between, out, lost };

struct RayStretch {
    RayLeg leg = RayLeg::direct;
    Polyline points;
};

/// Where a fan's middle ray is reflected; numbers count from 1.
struct ReflectionMark {
    int number = 1;
    std::size_t row = 0;
    DrawingPoint at{};
};

/// The rays of one path in the meridional plane, spread over what survives of the pupil there.
struct RayFan {
    GhostPath path;
    std::vector<RayStretch> stretches;
    std::vector<ReflectionMark> marks;
    int rays = 0;           ///< that reach the sensor
    double v_low_mm = 0.0;  ///< where they lie in the beam, across it
    double v_high_mm = 0.0;
    std::vector<double> sensor_y_mm;  ///< one per ray that reaches it
};

/// Parts of the beam, in mm across it in the meridional plane, whose rays reach the sensor.
struct PupilSpan {
    double low_mm, high_mm;
};
std::vector<PupilSpan> surviving_spans(const OpticalSystem& system, const GhostPath& path,
                                       double field_deg);

/// Aims `rays` rays so that they span the surviving part of the pupil, its edges included. When
/// none survives in this plane, the fan shows rays of the whole aperture up to where they end.
RayFan ray_fan(const OpticalSystem& system, const GhostPath& path, double field_deg, int rays,
               double lead_in_mm);

}  // namespace ghostlight
