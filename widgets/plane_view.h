#pragma once

#include <QMarginsF>
#include <QPointF>
#include <QSizeF>

#include "widgets/layout_scene.h"

namespace ghostlight {

/// How the drawing's plane lies on a widget: z to the right, y up, logical pixels from the top
/// left. Both axes have one scale.
class PlaneView {
   public:
    void set_size(QSizeF size_px) { size_px_ = size_px; }
    QSizeF size_px() const { return size_px_; }
    double mm_per_px() const { return mm_per_px_; }
    DrawingPoint center() const { return center_; }

    QPointF to_view(DrawingPoint point) const;
    DrawingPoint to_drawing(QPointF position) const;

    /// The whole box, with room around it.
    void fit(const DrawingBox& box, QMarginsF margins_px);
    /// Moves the drawing with the cursor.
    void pan(QPointF delta_px);
    /// Enlarges by a factor; the point under the cursor stays there.
    void zoom(double factor, QPointF about);

   private:
    QSizeF size_px_{1.0, 1.0};
    DrawingPoint center_{0.0, 0.0};
    double mm_per_px_ = 1.0;
};

}  // namespace ghostlight
