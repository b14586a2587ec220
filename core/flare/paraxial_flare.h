#pragma once

#include <optional>
#include <stop_token>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"

namespace ghostlight {

/// The ghosts to first order (Lee and Eisemann 2013): each the image of the stop, shifted linearly
/// with the tangent of the field angle, cut by the clear radii that its beam meets on its way, with
/// the films at normal incidence and an even irradiance. No ray is traced; for comparison, lists
/// and a first look.
std::optional<FlareImage> render_paraxial(const FlareScene& scene, const FlareRequest& request,
                                          std::stop_token stop = {});

}  // namespace ghostlight
