#pragma once

#include <string>
#include <vector>

#include "core/ghosts/pupil.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/optics/prescription.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// Area of the stop's opening, mm².
double stop_area_mm2(const StopMask& mask);

/// 1 − pupil area / area of the stop's paraxial image in front of the path, seen at the field.
double vignetting(const OpticalSystem& system, const ParaxialGhost& paraxial,
                  const LightDirection& light, double pupil_area_mm2);

/// Area of the sensor plane on which a small source of one steradian would be imaged, mm²/sr: the
/// Jacobian of the direct path by finite differences through a point of the entrance. NaN where no
/// ray gets through.
double image_area_per_steradian_mm2(const OpticalSystem& system, const LightDirection& light,
                                    double u_mm, double v_mm);

/// Half the sun's angular diameter, degrees (959.63 arc seconds at 1 au, IAU).
inline constexpr double sun_radius_deg = 959.63 / 3600.0;

/// "#rrggbb" of linear Rec.709, scaled so that its largest channel is 1; what lies outside the
/// gamut is cut off at 0.
std::string srgb_swatch(double r, double g, double b);

/// Media in front of each row and in front of the sensor, for people.
std::vector<std::string> media_of(const Prescription& lens);

/// What a sensor's face has behind it: "sensor", or its substrate.
std::string sensor_medium_of(const Sensor& sensor);

}  // namespace ghostlight
