#pragma once

#include <vector>

#include "core/optics/optical_system.h"

namespace ghostlight {

/// The image at one field angle, by real rays in the meridional plane.
struct FieldPoint {
    double field_deg = 0.0;
    double image_height_mm =
        0.0;  ///< of the chief ray on the sensor plane; NaN where none gets there
    double paraxial_height_mm = 0.0;     ///< f tan θ
    double distortion = 0.0;             ///< image height over f tan θ, minus 1
    double pupil_area_mm2 = 0.0;         ///< of the beam's part that passes, across the beam
    double vignetting = 0.0;             ///< 1 − pupil area / (that on axis × cos θ)
    double transmittance = 0.0;          ///< mean over the beam that passes, polarisation carried
    double relative_illumination = 0.0;  ///< image irradiance of an even scene over that on axis
};

/// At `count` ≥ 2 field angles from 0 to `last_deg`. The relative illumination is flux / (sensor
/// area per steradian of the scene) over the same on axis: cos⁴ θ for a thin lens at the stop.
std::vector<FieldPoint> field_curves(const OpticalSystem& system, double last_deg, int count);

}  // namespace ghostlight
