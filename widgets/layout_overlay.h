#pragma once

#include <vector>

#include "widgets/layout_scene.h"
#include "widgets/plane_view.h"
#include "widgets/ray_fan.h"

class QPainter;

namespace ghostlight {

/// What lies over the drawing at a fixed size: labels, the numbers of the reflections, and the
/// surface under the cursor (or null).
void paint_layout_overlay(QPainter& painter, const LensDrawing& drawing,
                          const std::vector<RayFan>& fans, const PlaneView& plane,
                          const SurfaceOutline* hovered);

}  // namespace ghostlight
