#pragma once

#include "core/flare/flare_image.h"

namespace ghostlight::cli {

/// The exposure in stops that shows a flare: ghosts are 1e-3 to 1e-6 of the light, so a fixed one
/// would show black. White is what the brightest 0.1 % of the lit pixels reach.
double automatic_exposure_ev(const FlareImage& image);

}  // namespace ghostlight::cli
