#include "widgets/plane_view.h"

#include <algorithm>

namespace ghostlight {

namespace {
constexpr double finest_mm_per_px = 1e-4;  // well below a wavelength's worth of drawing error
constexpr double coarsest_mm_per_px = 50.0;
}  // namespace

QPointF PlaneView::to_view(DrawingPoint point) const {
    return {size_px_.width() / 2.0 + (point.x - center_.x) / mm_per_px_,
            size_px_.height() / 2.0 - (point.y - center_.y) / mm_per_px_};
}

DrawingPoint PlaneView::to_drawing(QPointF position) const {
    return {center_.x + (position.x() - size_px_.width() / 2.0) * mm_per_px_,
            center_.y - (position.y() - size_px_.height() / 2.0) * mm_per_px_};
}

void PlaneView::fit(const DrawingBox& box, QMarginsF margins_px) {
    const double width = std::max(size_px_.width() - margins_px.left() - margins_px.right(), 16.0);
    const double height =
        std::max(size_px_.height() - margins_px.top() - margins_px.bottom(), 16.0);
    mm_per_px_ =
        std::clamp(std::max((box.z_max - box.z_min) / width, (box.y_max - box.y_min) / height),
                   finest_mm_per_px, coarsest_mm_per_px);
    center_ = {(box.z_min + box.z_max) / 2.0, (box.y_min + box.y_max) / 2.0};
    center_.x += (margins_px.right() - margins_px.left()) / 2.0 * mm_per_px_;
    center_.y += (margins_px.top() - margins_px.bottom()) / 2.0 * mm_per_px_;
}

void PlaneView::pan(QPointF delta_px) {
    center_.x -= delta_px.x() * mm_per_px_;
    center_.y += delta_px.y() * mm_per_px_;
}

void PlaneView::zoom(double factor, QPointF about) {
    const DrawingPoint fixed = to_drawing(about);
    mm_per_px_ = std::clamp(mm_per_px_ / factor, finest_mm_per_px, coarsest_mm_per_px);
    const DrawingPoint moved = to_drawing(about);
    center_ += fixed - moved;
}

}  // namespace ghostlight
