#pragma once

#include <optional>
#include <stop_token>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"

namespace ghostlight {

/// Draws the ghost layer with the least work that keeps its error within the request's tolerance:
/// each ghost is probed on a coarse grid, gets a share of the allowed error by its light, and from
/// that its own grid, its own size of picture and its own number of spectral bands. Light on the
/// axis is drawn as a profile where all is round (radial_flare.h). Bit-identical for any number of
/// threads. Returns nothing when stopped.
std::optional<FlareImage> render_planned(const FlareScene& scene, const FlareRequest& request,
                                         std::stop_token stop = {});

}  // namespace ghostlight
