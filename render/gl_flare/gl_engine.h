#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"

namespace ghostlight {

/// Draws a planned picture, as render_planned does; nothing when stopped.
using DrawPlanned = std::function<std::optional<FlareImage>(const FlareScene&, const FlareRequest&,
                                                            std::stop_token)>;

/// An OpenGL that draws flares, in a context of its own without a window. Used and destroyed on the
/// thread that made it.
struct GlEngine {
    std::string renderer;  ///< the driver's own name of itself
    DrawPlanned draw;      ///< throws Error where it cannot, or cannot any more
};

/// Throws Error with the reason where there is none.
using MakeGlEngine = std::function<GlEngine()>;
GlEngine offscreen_gl_engine();

}  // namespace ghostlight
