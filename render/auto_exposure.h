#pragma once

#include "core/flare/flare_image.h"

namespace ghostlight {

/// The exposure, in whole thirds of a stop, that puts all but the brightest `share` of the lit
/// picture below display white, and at least half of it below middle grey: an even veil is shown
/// as a veil, not as white. 0 for a picture without light.
double auto_exposure_ev(const FlareImage& image, double share = 0.01);

}  // namespace ghostlight
