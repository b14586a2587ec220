#pragma once

#include <QColor>
#include <QString>

#include <vector>

#include "widgets/axis_marks.h"
#include "widgets/layout_scene.h"
#include "widgets/ray_fan.h"

namespace ghostlight {

/// A line or an area of a drawing that goes on paper.
struct PaperShape {
    Polyline points;
    QColor color;
    double width_px = 1.0;  ///< at 96 to the inch; 0: an area filled with the colour
    bool closed = false;
};

/// The lens, its rays and marks in the colours of the light theme, on white.
std::vector<PaperShape> paper_shapes(const LensDrawing& drawing, const std::vector<RayFan>& fans,
                                     const std::vector<AxisMark>& marks);

/// To scale: 1 mm of the lens is so many pixels at 96 to the inch, the drawing's breadth that of
/// the longest side.
QString layout_as_svg(const std::vector<PaperShape>& shapes, const DrawingBox& box);

/// Writes .svg, .pdf or .png, as the name's extension says. Throws Error.
void export_layout(const QString& file, const std::vector<PaperShape>& shapes,
                   const DrawingBox& box);

}  // namespace ghostlight
