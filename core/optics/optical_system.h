#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/optics/coating.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// One row of a compiled lens at one wavelength.
struct SurfaceAt {
    double curvature_per_mm = 0.0;
    double conic = 0.0;
    std::vector<double> aspheric;
    double vertex_z_mm = 0.0;  ///< the first vertex is z = 0
    double semi_diameter_mm = 0.0;
    double n_before = 1.0;
    double n_after = 1.0;
    Film film;  ///< seen from the incoming side
    bool reflects = false;
};

/// The stop's opening at the working f-number.
struct StopMask {
    double semi_diameter_mm = 0.0;
    int blades = 0;
    double rotation_rad = 0.0;
    double blade_curvature = 0.0;
};

/// A lens at one wavelength and in one configuration: flat, immutable, ready to trace.
struct OpticalSystem {
    std::vector<SurfaceAt> surfaces;
    std::size_t stop = 0;
    StopMask stop_mask;
    double sensor_z_mm = 0.0;
    double sensor_width_mm = 36.0;
    double sensor_height_mm = 24.0;
    double wavelength_nm = 587.5618;
};

/// Validates and compiles. The stop's radius follows the f-number paraxially at d, capped by the
/// stop row's semi-diameter; "paraxial focus" is taken at d too, so that every wavelength sees the
/// same lens. Throws Error (validate, refractive_index; no focus where one is needed).
OpticalSystem compile(const Prescription& lens, double wavelength_nm,
                      std::string_view configuration = {});

}  // namespace ghostlight
