#pragma once

#include <vector>

#include "core/flare/planned_ghost.h"
#include "core/flare/rim_profile.h"
#include "core/optics/paraxial.h"

namespace ghostlight {

/// How far the fringes of a ghost's rim reach on a picture, to first order.
struct GhostFringes {
    double fresnel_number = 0.0;  ///< from where the rim is cut (physics.md §9); 0: no such rim
    /// From the rim to the first bright fringe, 0.861 √(λ|z_eff|) magnified, pixels.
    double first_fringe_px = 0.0;

    double px_per_w() const;  ///< of Fresnel's w
};
/// Of the rim that the last crossing of the stop cuts.
GhostFringes ghost_fringes(const OpticalSystem& system, const ParaxialGhost& ghost,
                           double pitch_mm);

/// Fringes narrower than this are not drawn: a pixel's mean is what the picture has already.
inline constexpr double least_fringe_px = 1.0;
bool shows(const GhostFringes& fringes);

/// Ghosts among `paths` whose stop's fringes show at a picture's size.
std::vector<bool> shows_fringes(const OpticalSystem& system, const std::vector<GhostPath>& paths,
                                double pitch_mm);

/// The rims of one ghost, in the order of MeshNodes::clearances' groups. Those that cut nothing
/// have no Fresnel number.
struct GhostRims {
    GhostFringes surface;                 ///< of the clear radius that cuts most of what any cuts
    std::vector<GhostFringes> crossings;  ///< of the stop, the last one last

    double stop_rim = 2.0;  ///< length of the stop's rim over its area, in semi-diameters
    double on_frame = 1.0;  ///< share of the rim that lands on the frame

    double least_fresnel_number() const;  ///< of those that show; 0: none
    double px_per_w() const;              ///< the least of those that show
    /// How far, at most, fringes misplace light: as blur_px() of a picture's level.
    double changed_px() const;
    /// What all their fringes change on the frame, as a share of all the ghost's light.
    double changed_share(const EdgeFringes& edge) const;
};
/// Which rims cut the beam, and where they land, is seen by the probe's rays; which surface, by
/// first order.
GhostRims ghost_rims(const OpticalSystem& system, const NodePlacement& placement,
                     const ProbedGhost& ghost, double field_deg);

}  // namespace ghostlight
