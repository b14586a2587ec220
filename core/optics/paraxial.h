#pragma once

#include <cstddef>
#include <vector>

#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// Acts on (y, u), u = dy/ds along the direction of travel: y' = a y + b u, u' = c y + d u.
struct RayMatrix {
    double a = 1.0, b = 0.0, c = 0.0, d = 1.0;
    bool operator==(const RayMatrix&) const = default;
};
/// `later` after `earlier`.
RayMatrix operator*(const RayMatrix& later, const RayMatrix& earlier);

/// First-order data of the direct path, lengths in mm, for an object at infinity. Values that do
/// not exist (an afocal lens, a telecentric pupil) are infinite.
struct FirstOrder {
    double efl_mm = 0.0;
    double bfd_mm = 0.0;  ///< last vertex to the rear focus
    double ffd_mm = 0.0;  ///< first vertex to the front focus, signed
    double f_number = 0.0;
    double entrance_pupil_z_mm = 0.0;  ///< from the first vertex
    double entrance_pupil_radius_mm = 0.0;
    double exit_pupil_z_mm = 0.0;  ///< from the last vertex
    double exit_pupil_radius_mm = 0.0;
    double sensor_distance_mm = 0.0;    ///< last vertex to the sensor
    double paraxial_defocus_mm = 0.0;   ///< sensor − focus
    double front_principal_z_mm = 0.0;  ///< from the first vertex
    double rear_principal_z_mm = 0.0;   ///< from the last vertex
    double front_nodal_z_mm = 0.0;      ///< from the first vertex
    double rear_nodal_z_mm = 0.0;       ///< from the last vertex
    double pupil_magnification = 0.0;   ///< exit over entrance pupil, signed
    double petzval_per_mm = 0.0;        ///< Σ c (n' − n)/(n n'): minus the image's curvature
    double total_track_mm = 0.0;        ///< first vertex to sensor
};
FirstOrder first_order(const OpticalSystem& system);

/// A ghost to first order (Lee and Eisemann 2013). M_a takes the first vertex's tangent plane to
/// the first crossing of the stop, M_s the last crossing to the sensor.
struct ParaxialGhost {
    RayMatrix to_sensor;       ///< first vertex → sensor
    RayMatrix to_stop;         ///< M_a
    RayMatrix stop_to_sensor;  ///< M_s
    double focus_from_sensor_mm =
        0.0;                      ///< where a collimated beam meets; negative before the sensor
    double magnification = 0.0;   ///< y_sensor over y at the first stop crossing, collimated
    double diameter_mm = 0.0;     ///< on the sensor, all surfaces limiting
    double fresnel_number = 0.0;  ///< a²|M|/(λ|B|) from the last stop crossing on (Collins)
    double entrance_semi_diameter_mm = 0.0;  ///< of the collimated beam that passes everywhere
    double pupil_from_sensor_mm = 0.0;  ///< where the path's rest images the stop, last crossing
    double pupil_radius_mm = 0.0;       ///< of that image
    int stop_crossings = 0;
};
/// One meeting of a path with a surface, to first order.
struct ParaxialMeeting {
    RayMatrix to_here;  ///< first vertex → this surface's vertex plane
    double clear_radius_mm = 0.0;
    bool at_stop = false;
};
std::vector<ParaxialMeeting> paraxial_meetings(const OpticalSystem& system, const GhostPath& path);

ParaxialGhost paraxial_ghost(const OpticalSystem& system, const GhostPath& path);

}  // namespace ghostlight
