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
    int ray = 0;  ///< of its fan: the stretches of one ray follow each other
};

/// What happens where a ray meets a surface.
struct RayMeeting {
    std::size_t row = 0;  ///< from 0; the count of surfaces for the sensor's face
    DrawingPoint at{};
    double incidence_deg = 0.0;                     ///< in the medium that the ray comes from
    double reflectance = 0.0, transmittance = 1.0;  ///< of unpolarised light
    bool reflected = false;
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
    std::vector<double> sensor_y_mm;   ///< one per ray that reaches it
    std::vector<RayMeeting> meetings;  ///< of all rays that reach it
    int field = 0;                     ///< of direct fans at several fields: which
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

/// Adds the rays of the whole aperture that do not arrive, up to where they are stopped.
void add_stopped_rays(const OpticalSystem& system, double field_deg, int rays, double lead_in_mm,
                      RayFan& fan);

/// The stretches of rays along which light has come after a share of each ray's way, 0 to 1.
std::vector<RayStretch> walked(const std::vector<RayStretch>& stretches, double share);

}  // namespace ghostlight
