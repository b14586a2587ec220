#pragma once

#include <vector>

#include "widgets/axis_marks.h"
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

/// Pupils as dashed bars, foci and principal points as ticks on the axis, ghosts' foci as diamonds
/// in their colours.
void paint_axis_marks(QPainter& painter, const std::vector<AxisMark>& marks,
                      const PlaneView& plane);

/// What happens at a ray's meeting with a surface, in a box beside it.
void paint_meeting(QPainter& painter, const RayMeeting& meeting, const PlaneView& plane);

/// A measured distance: its length, and its parts along the axis and across.
void paint_measure(QPainter& painter, DrawingPoint from, DrawingPoint to, const PlaneView& plane);

}  // namespace ghostlight
