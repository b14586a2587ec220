#pragma once

#include <cstddef>
#include <stop_token>

#include "core/ghosts/ghost_path.h"
#include "core/ghosts/pupil.h"

namespace ghostlight {

/// What a proof may spend, and what it is asked for.
struct ProofEffort {
    std::size_t most_cells = 600;  ///< a cell costs about 10 µs for 40 interactions
    double enough_mm2 = 0.0;       ///< stop once no more than this can have been missed
    bool on_sensor = false;        ///< light beside the circle about the sensor's corners is none
};

/// What a path's light outside a claimed part of the entrance can amount to. Areas are across the
/// beam, mm²; a flux is over E0.
struct PupilProof {
    double searched_mm2 = 0.0;           ///< of the entrance outside the claim
    double uncertain_mm2 = 0.0;          ///< of it: there light may pass, the rest is proven dark
    double missed_flux_bound_mm2 = 0.0;  ///< uncertain area times the reflectances possible there
    std::size_t cells = 0;               ///< evaluated
    bool finished = true;  ///< false when it was stopped; the bounds hold all the same

    double proven_share() const {
        return searched_mm2 > 0.0 ? 1.0 - uncertain_mm2 / searched_mm2 : 1.0;
    }
};

/// Splits the entrance outside `claimed` (symmetric about u = 0; of no area: all of the entrance)
/// where the bound is largest, until enough of it is proven dark. The beam must lie in the y–z
/// plane: one half is proven for both. The stop counts as its circle, so a claim holds for any turn
/// of it. The direct path has no reflections: its bound is the area.
PupilProof prove_pupil(const OpticalSystem& system, const GhostPath& ghost, const BeamFrame& frame,
                       const PupilBox& claimed, const ProofEffort& effort = {},
                       std::stop_token stop = {});

/// An upper bound of a path's flux over E0 that no ray is traced for, mm².
double flux_bound_mm2(const OpticalSystem& system, const GhostPath& ghost, const BeamFrame& frame,
                      const ProofEffort& effort = {});

}  // namespace ghostlight
