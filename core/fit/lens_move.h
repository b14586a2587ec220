#pragma once

#include <vector>

#include "core/fit/fit_scene.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// A small change of the lens or of the light's direction, to either side of where they stand: what
/// pictures are differentiated by. Only numbers that a lens is compiled into are taken from here,
/// all smooth; rays are differentiated by ceres::Jet.
struct LensMove {
    std::vector<OpticalSystem> less, more;  ///< at the scene's geometry nodes; empty: it stays
    std::vector<OpticalSystem> film_less, film_more;  ///< at its samples' wavelengths
    StopPlace stop_less, stop_more;
    LightDirection light_less, light_more;
    double width = 1.0;  ///< between the two sides, in the unit of the slope
};

/// The moves of one fit, about one lens.
struct LensMoves {
    std::vector<OpticalSystem> film_now;  ///< at the samples' wavelengths, coatings as they stand
    std::vector<LensMove> moves;
};

/// The lens at the wavelengths of the scene's samples.
std::vector<OpticalSystem> compiled_films(const FitScene& scene, const Prescription& lens);

/// By a number of the lens. Coatings are those of `less` and `more`.
LensMove lens_move(const FitScene& scene, const FittedLens& less, const FittedLens& more,
                   const LightDirection& light, double width);

/// By the light's direction.
LensMove light_move(const FitScene& scene, const LightDirection& less, const LightDirection& more,
                    double width);

}  // namespace ghostlight
