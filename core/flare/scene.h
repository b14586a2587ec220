#pragma once

#include <string>
#include <vector>

#include "core/flare/artistic.h"
#include "core/flare/glare_spread.h"
#include "core/flare/layers.h"
#include "core/flare/light.h"
#include "core/flare/veiling_glare.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// The layer "veil".
struct Veil {
    /// Share of the ghosts' light that may go there, the ghosts of the least irradiance first; they
    /// are then not drawn.
    double folded_share = 0.0;
    VeilKernel kernel = VeilKernel::ellipse;
    GlareSpread spread;
    bool operator==(const Veil&) const = default;
};
inline constexpr double most_folded_share = 0.5;

/// The layer "backdrop".
struct Backdrop {
    std::string file;
    bool operator==(const Backdrop&) const = default;
};

/// How a lens is looked at: undone and saved together with it, but no part of it.
struct Scene {
    std::string configuration;              ///< empty: as listed
    std::vector<Light> lights = {Light{}};  ///< at least one
    /// The light that the ghost table, the rays, the plan and the scene bar are about.
    std::size_t active_light = 0;
    LayerSettings layers;
    Veil veil;
    Backdrop backdrop;
    Artistic artistic;
    bool ringing = false;           ///< diffraction at the ghosts' rims, in pictures at rest
    double tolerance = 0.01;        ///< of the ghost table's fluxes
    double flare_tolerance = 0.02;  ///< relative L1 error of the flare at rest
    bool operator==(const Scene&) const = default;

    Light& light() { return lights[active_light]; }
    const Light& light() const { return lights[active_light]; }
};
inline constexpr std::size_t most_lights = 32;

/// Whether the ghosts are those of one point light of 0 EV, all of them drawn and as they are: a
/// picture whose plan says all about it.
bool has_plain_ghosts(const Scene& scene);

/// Where the lights are that are on, but for the active one.
std::vector<LightDirection> other_lights(const Scene& scene);

/// A light inside the picture, off centre.
Scene default_scene(const Prescription& lens);

/// Angle from the axis to the sensor's corner, degrees: as published, else by the focal length.
double half_field_deg(const Prescription& configured);

/// The wavelength by which single rays are drawn: the active light's own, else the d line.
double drawing_wavelength_nm(const Scene& scene);

}  // namespace ghostlight
