#pragma once

#include <string>
#include <string_view>

#include "core/flare/scene.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// In a lens file the scene is the field "scene", which readers of lenses pass over.
inline constexpr std::string_view scene_field = "scene";

/// One line of JSON, the light's angles in degrees and tolerances as shares.
std::string scene_to_json(const Scene& scene);

/// Takes what it understands from the text and the rest from `otherwise`: a scene is a
/// convenience and never a reason to refuse a lens. The configuration must be one of the lens's.
Scene scene_from_json(std::string_view text, const Prescription& lens, const Scene& otherwise);

}  // namespace ghostlight
