#pragma once

#include <string>

#include "core/flare/spectrum.h"
#include "core/optics/prescription.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// How a lens is looked at: undone and saved together with it, but no part of it.
struct Scene {
    std::string configuration;  ///< empty: as listed
    LightDirection light{10.0, 90.0};
    Spectrum spectrum = StandardLight{Illuminant::d65};
    double tolerance = 0.01;        ///< of the ghost table's fluxes
    double flare_tolerance = 0.02;  ///< relative L1 error of the flare at rest
    bool operator==(const Scene&) const = default;
};

/// A light inside the picture, off centre.
Scene default_scene(const Prescription& lens);

/// Angle from the axis to the sensor's corner, degrees: as published, else by the focal length.
double half_field_deg(const Prescription& configured);

/// The wavelength by which single rays are drawn: the light's own, else the d line.
double drawing_wavelength_nm(const Scene& scene);

}  // namespace ghostlight
