#pragma once

#include <cstddef>
#include <memory>
#include <optional>
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
    double absorption_before_per_mm = 0.0;  ///< −ln τ of the media, 0 where they are lossless
    double absorption_after_per_mm = 0.0;
    Film film;  ///< seen from the incoming side
    bool reflects = false;
    /// At every angle and polarisation in place of what the film gives; the sensor's alone.
    std::optional<double> uniform_reflectance;
};

/// The stop's opening at the working f-number.
struct StopMask {
    double semi_diameter_mm = 0.0;
    int blades = 0;
    double rotation_rad = 0.0;
    double blade_curvature = 0.0;
    std::shared_ptr<const StopPicture> picture = nullptr;  ///< clips what the blades leave
};

/// A lens at one wavelength and in one configuration: flat, immutable, ready to trace.
struct OpticalSystem {
    std::vector<SurfaceAt> surfaces;
    std::size_t stop = 0;
    StopMask stop_mask;
    double sensor_z_mm = 0.0;
    double sensor_width_mm = 36.0;
    double sensor_height_mm = 24.0;
    /// The sensor as a plane that reflects, if it does: it follows the last row as one more surface
    /// of the paths, and light meets it only inside its rectangle. Its semi-diameter is half the
    /// diagonal.
    std::optional<SurfaceAt> sensor_face;
    double wavelength_nm = 587.5618;
};

/// A row, or the sensor's face for the row after the last.
const SurfaceAt& surface_at(const OpticalSystem& system, std::size_t row);

/// How many surfaces a path may turn at: the rows, and the sensor if it reflects.
std::size_t turning_count(const OpticalSystem& system);

/// Validates and compiles. The stop's radius follows the f-number paraxially at d, capped by the
/// stop row's semi-diameter; "paraxial focus" is taken at d too, so that every wavelength sees the
/// same lens. Throws Error (validate, refractive_index; no focus where one is needed).
OpticalSystem compile(const Prescription& lens, double wavelength_nm,
                      std::string_view configuration = {});

}  // namespace ghostlight
