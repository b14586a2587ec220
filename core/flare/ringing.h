#pragma once

#include <stop_token>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"
#include "core/optics/paraxial.h"

namespace ghostlight {

/// How far a ghost's fringes reach on a picture, to first order.
struct GhostFringes {
    double fresnel_number = 0.0;  ///< from its last stop crossing on (physics.md §9)
    /// From the rim to the first bright fringe, 0.861 √(λ|z_eff|) magnified, pixels.
    double first_fringe_px = 0.0;
};
GhostFringes ghost_fringes(const OpticalSystem& system, const ParaxialGhost& ghost,
                           double pitch_mm);

/// Fringes narrower than this are not drawn: a pixel's mean is what the picture has already.
inline constexpr double least_fringe_px = 1.0;

/// Ghosts among `paths` whose fringes show at a picture's size.
std::vector<bool> shows_fringes(const OpticalSystem& system, const std::vector<GhostPath>& paths,
                                double pitch_mm);

/// Adds to a picture what diffraction at the stop changes of its ghosts: along the rim that the
/// last stop crossing cuts, irradiance × (the straight edge's profile − 1) inside and × the profile
/// outside, at the depth in stop coordinates that every pixel's ray has; for a corner the product
/// of its two edges'; where the Fresnel number is small, the whole mask propagated, its dirt
/// included. Each profile is the spectrum's, at each wavelength's own Fresnel number, and takes
/// from a ghost in all as much as it gives. Ghosts whose fringes would be finer than a pixel, those
/// that are too close to their focus (below `least_propagated`), and rims cut by other surfaces are
/// left as they are. Fills FlareImage::ringing and times.ringing_ms. False when stopped.
bool add_ringing(const FlareScene& scene, const FlareRequest& request, const std::stop_token& stop,
                 FlareImage& image);

}  // namespace ghostlight
