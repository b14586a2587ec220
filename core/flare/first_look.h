#pragma once

#include <optional>
#include <stop_token>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"

namespace ghostlight {

/// Pixels across that a first look is worth drawing at.
inline constexpr int first_look_width_px = 640;

/// All ghosts to see something at once: each drawn from 28 rays about its own centre ray, which is
/// found to first order (paraxially, then by the derivatives of six rays); nothing is searched for,
/// nothing refined, polarisation as in the meridian, one geometry for all colours. The plan holds
/// the error estimated from those rays' second differences, which does not know of light that
/// enters elsewhere. The request's tolerance and search are not followed. Nothing when stopped.
std::optional<FlareImage> render_first_look(const FlareScene& scene, const FlareRequest& request,
                                            std::stop_token stop = {});

}  // namespace ghostlight
