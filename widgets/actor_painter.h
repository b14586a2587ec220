#pragma once

#include <QSizeF>

class QPainter;
class vtkRenderer;

namespace ghostlight {

/// Draws the lines and triangles of a renderer's visible actors with a QPainter, as its camera,
/// which must be a parallel one along z, puts them into a view of this size: nearer ones over
/// farther ones, in the colours of their points. False if there is nothing to draw.
bool paint_actors(QPainter& painter, vtkRenderer& renderer, QSizeF size_px);

}  // namespace ghostlight
