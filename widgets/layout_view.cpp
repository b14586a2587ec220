#include "widgets/layout_view.h"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <QEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <limits>

#include "widgets/layout_overlay.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

const QMarginsF margins_px(24.0, 20.0, 56.0, 20.0);  // on the right, room for the sensor's label
constexpr double hover_reach_px = 6.0;
constexpr double zoom_per_notch = 1.2;
constexpr double degrees_per_notch = 120.0;  // in eighths of a degree, as Qt counts

double squared(double x) { return x * x; }

double distance_to_segment_px(QPointF p, QPointF a, QPointF b) {
    const QPointF along = b - a;
    const double length2 = QPointF::dotProduct(along, along);
    const double t =
        length2 > 0.0 ? std::clamp(QPointF::dotProduct(p - a, along) / length2, 0.0, 1.0) : 0.0;
    const QPointF off = p - (a + t * along);
    return std::sqrt(squared(off.x()) + squared(off.y()));
}

}  // namespace

LayoutView::LayoutView(QWidget* parent)
    : VtkView(parent), actors_(std::make_unique<LayoutActors>()) {
    setCursor(Qt::ArrowCursor);
    actors_->add_to(renderer());
    renderer()->GetActiveCamera()->ParallelProjectionOn();
}

LayoutView::~LayoutView() { close_gl(); }

void LayoutView::show_drawing(LensDrawing drawing, std::vector<RayFan> fans,
                              std::vector<AxisMark> marks) {
    drawing_ = std::move(drawing);
    fans_ = std::move(fans);
    marks_ = std::move(marks);
    hovered_meeting_.reset();
    nothing_.clear();
    if (static_cast<std::size_t>(hovered_row_) > drawing_.surfaces.size()) {
        hover(0);
    }
    if (fitted_) {
        plane_.fit(drawing_.box, margins_px);
    }
    rebuild();
}

void LayoutView::show_nothing(const QString& text) {
    drawing_ = {};
    fans_.clear();
    marks_.clear();
    hovered_meeting_.reset();
    measured_.reset();
    nothing_ = text;
    fitted_ = true;
    hover(0);
    rebuild();
}

void LayoutView::set_walk(double share) {
    walk_ = share;
    actors_->show_rays(fans_, current_palette(), walk_);
    refresh();
}

void LayoutView::set_measuring(bool measures) {
    measures_ = measures;
    measured_.reset();
    setCursor(measures ? Qt::CrossCursor : Qt::ArrowCursor);
    refresh();
}

double LayoutView::measured_mm() const {
    return measured_ ? std::hypot(measured_->second.x - measured_->first.x,
                                  measured_->second.y - measured_->first.y)
                     : 0.0;
}

const RayMeeting* LayoutView::meeting_at(QPointF position) const {
    const RayMeeting* nearest = nullptr;
    double least_px = hover_reach_px;
    for (const RayFan& fan : fans_) {
        for (const RayMeeting& meeting : fan.meetings) {
            const QPointF off = plane_.to_view(meeting.at) - position;
            const double distance = std::hypot(off.x(), off.y());
            if (distance < least_px) {
                least_px = distance;
                nearest = &meeting;
            }
        }
    }
    return nearest;
}

void LayoutView::fit() {
    fitted_ = true;
    plane_.fit(drawing_.box, margins_px);
    refresh();
}

void LayoutView::rebuild() {
    actors_->show_lens(drawing_, current_palette());
    actors_->show_rays(fans_, current_palette(), walk_);
    refresh();
}

void LayoutView::prepare_rendering(int width_px, int) {
    const Palette& colors = current_palette();
    const double ratio = width_px / std::max(1.0, plane_.size_px().width());
    actors_->set_pixel_ratio(ratio);
    const double left = plane_.to_drawing({0.0, 0.0}).x;
    const double right = plane_.to_drawing({plane_.size_px().width(), 0.0}).x;
    const double overhang = 12.0 * plane_.mm_per_px();
    const bool empty = drawing_.surfaces.empty();
    actors_->show_axis(std::max(left, drawing_.box.z_min - overhang),
                       empty ? left : std::min(right, drawing_.box.z_max + overhang),
                       plane_.mm_per_px(), colors);

    renderer()->SetBackground(colors.panel.redF(), colors.panel.greenF(), colors.panel.blueF());
    vtkCamera* camera = renderer()->GetActiveCamera();
    const DrawingPoint center = plane_.center();
    camera->SetFocalPoint(center.x, center.y, 0.0);
    camera->SetPosition(center.x, center.y, 50.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetParallelScale(plane_.size_px().height() / 2.0 * plane_.mm_per_px());
    camera->SetClippingRange(1.0, 100.0);
}

void LayoutView::paint_overlay(QPainter& painter) {
    if (drawing_.surfaces.empty()) {
        painter.setPen(current_palette().dim);
        painter.drawText(rect().adjusted(16, 16, -16, -16), Qt::AlignCenter | Qt::TextWordWrap,
                         nothing_);
        return;
    }
    const std::size_t row = static_cast<std::size_t>(hovered_row_);
    paint_layout_overlay(painter, drawing_, fans_, plane_,
                         hovered_row_ > 0 && row <= drawing_.surfaces.size()
                             ? &drawing_.surfaces[row - 1]
                             : nullptr);
    paint_axis_marks(painter, marks_, plane_);
    if (measured_) {
        paint_measure(painter, measured_->first, measured_->second, plane_);
    } else if (hovered_meeting_) {
        paint_meeting(painter, *hovered_meeting_, plane_);
    }
}

int LayoutView::row_at(QPointF position) const {
    int nearest = 0;
    double nearest_px = hover_reach_px;
    const auto consider = [&](const Polyline& line, std::size_t row) {
        for (std::size_t i = 1; i < line.size(); ++i) {
            const double distance = distance_to_segment_px(position, plane_.to_view(line[i - 1]),
                                                           plane_.to_view(line[i]));
            if (distance < nearest_px) {
                nearest_px = distance;
                nearest = static_cast<int>(row) + 1;
            }
        }
    };
    const StopBars& stop = drawing_.stop;
    for (const SurfaceOutline& surface : drawing_.surfaces) {
        if (surface.is_stop) {
            for (const double side : {-1.0, 1.0}) {
                consider({{stop.z_mm, side * stop.opening_mm}, {stop.z_mm, side * stop.outer_mm}},
                         surface.row);
            }
        } else {
            consider(surface.points, surface.row);
        }
    }
    return nearest;
}

void LayoutView::hover(int row) {
    if (row != hovered_row_) {
        hovered_row_ = row;
        Q_EMIT surface_hovered(row);
        refresh();
    }
}

void LayoutView::resizeEvent(QResizeEvent* event) {
    VtkView::resizeEvent(event);
    plane_.set_size(size());
    if (fitted_) {
        plane_.fit(drawing_.box, margins_px);
    }
}

void LayoutView::mousePressEvent(QMouseEvent* event) {
    last_position_ = event->position();
    if (measures_ && event->button() == Qt::LeftButton) {
        const DrawingPoint at = plane_.to_drawing(event->position());
        measured_ = std::pair(at, at);
        refresh();
    }
    event->setAccepted(event->button() == Qt::LeftButton || event->button() == Qt::MiddleButton);
}

void LayoutView::mouseMoveEvent(QMouseEvent* event) {
    if (measures_ && measured_ && (event->buttons() & Qt::LeftButton) != 0) {
        measured_->second = plane_.to_drawing(event->position());
        refresh();
    } else if ((event->buttons() & (Qt::LeftButton | Qt::MiddleButton)) != 0) {
        if (event->position() != last_position_) {
            setCursor(Qt::ClosedHandCursor);
            plane_.pan(event->position() - last_position_);
            fitted_ = false;
            refresh();
        }
    } else {
        hover(row_at(event->position()));
        const RayMeeting* meeting = meeting_at(event->position());
        if ((meeting != nullptr) != hovered_meeting_.has_value() || meeting != nullptr) {
            hovered_meeting_ = meeting != nullptr ? std::optional(*meeting) : std::nullopt;
            refresh();
        }
    }
    last_position_ = event->position();
}

void LayoutView::mouseReleaseEvent(QMouseEvent* event) {
    setCursor(measures_ ? Qt::CrossCursor : Qt::ArrowCursor);
    hover(row_at(event->position()));
}

void LayoutView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton) {
        fit();
    }
}

void LayoutView::wheelEvent(QWheelEvent* event) {
    const double notches = event->angleDelta().y() / degrees_per_notch;
    if (notches == 0.0 || drawing_.surfaces.empty()) {
        event->ignore();
        return;
    }
    plane_.zoom(std::pow(zoom_per_notch, notches), event->position());
    fitted_ = false;
    hover(row_at(event->position()));
    refresh();
    event->accept();
}

void LayoutView::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_F && event->modifiers() == Qt::NoModifier) {
        fit();
    } else {
        VtkView::keyPressEvent(event);
    }
}

void LayoutView::leaveEvent(QEvent*) {
    hovered_meeting_.reset();
    hover(0);
    refresh();
}

void LayoutView::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::StyleChange) {
        rebuild();
    }
    VtkView::changeEvent(event);
}

}  // namespace ghostlight
