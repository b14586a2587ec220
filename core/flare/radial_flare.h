#pragma once

#include <optional>
#include <stop_token>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"

namespace ghostlight {

/// Whether all of a picture is round about its middle, and asked for without what needs rays all
/// over a beam: light on the axis, a round stop without an image, a sensor that does not reflect,
/// no ringing. With one of the plan's economies off it is drawn the general way too.
bool is_radial(const FlareScene& scene, const FlareRequest& request);

/// Draws such a picture: one line of rays a ghost, from the axis to the rim, each pair of
/// neighbours a ring of light; all ghosts' rings make one profile, which is turned about the axis.
/// Nothing when stopped. Bit-identical for any number of threads.
std::optional<FlareImage> render_radial(const FlareScene& scene, const FlareRequest& request,
                                        std::stop_token stop = {});

}  // namespace ghostlight
