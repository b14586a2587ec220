#include "widgets/glass_map_view.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

#include "widgets/palette.h"
#include "widgets/panels/curve_chart.h"

namespace ghostlight {

namespace {

constexpr double dot_px = 7.0;
constexpr double reach_px = 8.0;
constexpr double zoom_per_notch = 1.25;
constexpr double degrees_per_notch = 120.0;  // in eighths of a degree, as Qt counts

}  // namespace

GlassMapView::GlassMapView(QWidget* parent) : VtkView(parent) {
    setMinimumSize(180, 140);
    setMouseTracking(true);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(points_);
    actor_->SetMapper(mapper);
    actor_->GetProperty()->SetLighting(false);
    actor_->GetProperty()->SetRenderPointsAsSpheres(true);
    renderer()->AddActor(actor_);
    renderer()->GetActiveCamera()->ParallelProjectionOn();
}

GlassMapView::~GlassMapView() { close_gl(); }

void GlassMapView::show_glasses(const std::vector<MappedGlass>* glasses,
                                std::vector<std::size_t> found) {
    const bool is_first = glasses_ == nullptr;
    glasses_ = glasses;
    found_ = std::move(found);
    is_found_.assign(glasses_ == nullptr ? 0 : glasses_->size(), false);
    for (const std::size_t at : found_) {
        is_found_[at] = true;
    }
    hovered_.reset();
    if (chosen_ && *chosen_ >= is_found_.size()) {
        chosen_.reset();
    }
    if (is_first) {
        fit();
    }
    refresh();
}

void GlassMapView::set_ring(std::optional<ModelGlass> glass) {
    ring_ = glass;
    refresh();
}

void GlassMapView::set_chosen(std::optional<std::size_t> glass) {
    chosen_ = glass;
    refresh();
}

void GlassMapView::fit() {
    if (glasses_ == nullptr || glasses_->empty()) {
        return;
    }
    // Gases and liquids are few and far off: they are there when the map is zoomed out.
    constexpr double least_of_glasses = 1.35;
    vd_ = nd_ = {1e9, -1e9};
    for (const MappedGlass& glass : *glasses_) {
        if (glass.nd >= least_of_glasses) {
            vd_ = {std::min(vd_.low, glass.vd - 3.0), std::max(vd_.high, glass.vd + 3.0)};
            nd_ = {std::min(nd_.low, glass.nd - 0.03), std::max(nd_.high, glass.nd + 0.03)};
        }
    }
    if (vd_.low > vd_.high) {
        vd_ = {15.0, 100.0};
        nd_ = {1.0, 2.0};
    }
    refresh();
}

QRectF GlassMapView::plot() const {
    const int line = fontMetrics().height();
    return QRectF(rect()).adjusted(48, 10, -14, -line - 10);
}

QPointF GlassMapView::place(double nd, double vd) const {
    const QRectF area = plot();
    return {area.left() + (vd_.high - vd) / (vd_.high - vd_.low) * area.width(),
            area.bottom() - (nd - nd_.low) / (nd_.high - nd_.low) * area.height()};
}

QPointF GlassMapView::place(const MappedGlass& glass) const { return place(glass.nd, glass.vd); }

QColor GlassMapView::color_of(std::size_t glass) const {
    const Palette& colors = current_palette();
    const bool all = found_.size() == is_found_.size();
    if (!is_found_[glass]) {
        return colors.line;
    }
    const auto status = (*glasses_)[glass].glass.status;
    const bool is_old = status && *status == GlassStatus::obsolete;
    return is_old ? colors.dim : all ? colors.teal : colors.amber;
}

void GlassMapView::prepare_rendering(int width_px, int) {
    const Palette& colors = current_palette();
    const double ratio = width_px / std::max(1.0, static_cast<double>(width()));
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> dots;
    vtkNew<vtkUnsignedCharArray> shades;
    shades->SetNumberOfComponents(3);
    const auto add = [&](std::size_t k) {
        const QPointF at = place((*glasses_)[k]);
        if (!plot().contains(at)) {
            return;
        }
        const vtkIdType id = points->InsertNextPoint(at.x(), height() - at.y(), 0.0);
        dots->InsertNextCell(1, &id);
        const QColor color = color_of(k);
        shades->InsertNextTuple3(color.red(), color.green(), color.blue());
    };
    // What was found lies on top.
    for (const bool found : {false, true}) {
        for (std::size_t k = 0; k < is_found_.size(); ++k) {
            if (is_found_[k] == found) {
                add(k);
            }
        }
    }
    points_->SetPoints(points);
    points_->SetVerts(dots);
    points_->GetPointData()->SetScalars(shades);
    points_->Modified();
    actor_->GetProperty()->SetPointSize(static_cast<float>(dot_px * ratio));
    renderer()->SetBackground(colors.panel.redF(), colors.panel.greenF(), colors.panel.blueF());
    vtkCamera* camera = renderer()->GetActiveCamera();
    camera->SetFocalPoint(width() / 2.0, height() / 2.0, 0.0);
    camera->SetPosition(width() / 2.0, height() / 2.0, 50.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetParallelScale(height() / 2.0);
    camera->SetClippingRange(1.0, 100.0);
}

void GlassMapView::paint_overlay(QPainter& painter) {
    const Palette& colors = current_palette();
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF area = plot();
    const int line = fontMetrics().height();
    QColor grid = colors.line;
    grid.setAlphaF(0.6F);
    const double vd_step = round_step(vd_.high - vd_.low, static_cast<int>(area.width() / 55) + 1);
    for (double vd = std::ceil(vd_.low / vd_step) * vd_step; vd <= vd_.high; vd += vd_step) {
        const double x = place(nd_.low, vd).x();
        painter.setPen(grid);
        painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
        painter.setPen(colors.dim);
        painter.drawText(QRectF(x - 30, area.bottom() + 4, 60, line), Qt::AlignCenter,
                         QString::number(vd, 'g', 5));
    }
    const double nd_step = round_step(nd_.high - nd_.low, static_cast<int>(area.height() / 34) + 1);
    for (double nd = std::ceil(nd_.low / nd_step) * nd_step; nd <= nd_.high; nd += nd_step) {
        const double y = place(nd, vd_.low).y();
        painter.setPen(grid);
        painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
        painter.setPen(colors.dim);
        painter.drawText(QRectF(0, y - line / 2.0, area.left() - 6, line),
                         Qt::AlignRight | Qt::AlignVCenter, QString::number(nd, 'f', 2));
    }
    painter.setPen(colors.dim);
    painter.drawText(QRectF(area.left() + 4, area.top(), 60, line), Qt::AlignLeft, "nd");
    painter.drawText(QRectF(area.right() - 60, area.bottom() - line - 2, 56, line), Qt::AlignRight,
                     "Vd");
    if (ring_ && area.contains(place(ring_->nd, ring_->vd))) {
        painter.setPen(QPen(colors.red_orange, 2));
        painter.setBrush(Qt::NoBrush);
        painter.drawEllipse(place(ring_->nd, ring_->vd), 9, 9);
    }
    const auto label = [&](std::size_t at, const QColor& color) {
        const MappedGlass& glass = (*glasses_)[at];
        const QPointF where = place(glass);
        if (!area.contains(where)) {
            return;
        }
        painter.setPen(QPen(color, 2));
        painter.setBrush(Qt::NoBrush);
        painter.drawEllipse(where, 6, 6);
        const QString text =
            QStringLiteral("%1  %2 / %3")
                .arg(QString::fromStdString(glass.glass.medium.name),
                     QString::number(glass.nd, 'f', 4), QString::number(glass.vd, 'f', 1));
        const int wide = fontMetrics().horizontalAdvance(text) + 10;
        QRectF box(where.x() + 10, where.y() - line - 8, wide, line + 4);
        if (box.right() > area.right()) {
            box.moveRight(where.x() - 10);
        }
        if (box.top() < area.top()) {
            box.moveTop(where.y() + 8);
        }
        painter.fillRect(box, colors.ground);
        painter.drawText(box, Qt::AlignCenter, text);
    };
    if (chosen_ && glasses_ != nullptr) {
        label(*chosen_, colors.amber);
    }
    if (hovered_ && hovered_ != chosen_) {
        label(*hovered_, colors.text);
    }
}

void GlassMapView::paint_without_gl(QPainter& painter) {
    painter.fillRect(rect(), current_palette().panel);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    for (std::size_t k = 0; k < is_found_.size(); ++k) {
        const QPointF at = place((*glasses_)[k]);
        if (plot().contains(at)) {
            painter.setBrush(color_of(k));
            painter.drawEllipse(at, dot_px / 2.0, dot_px / 2.0);
        }
    }
    paint_overlay(painter);
}

std::optional<std::size_t> GlassMapView::glass_at(QPointF position) const {
    std::optional<std::size_t> nearest;
    double nearest_px = reach_px;
    for (std::size_t k = 0; k < is_found_.size(); ++k) {
        const QPointF off = place((*glasses_)[k]) - position;
        // Of two in one place the one that was searched for.
        const double distance = std::hypot(off.x(), off.y()) + (is_found_[k] ? 0.0 : 2.0);
        if (distance < nearest_px) {
            nearest_px = distance;
            nearest = k;
        }
    }
    return nearest;
}

void GlassMapView::stretch(double factor, QPointF about) {
    const QRectF area = plot();
    const double vd = vd_.high - (about.x() - area.left()) / area.width() * (vd_.high - vd_.low);
    const double nd = nd_.low + (area.bottom() - about.y()) / area.height() * (nd_.high - nd_.low);
    // From the whole map and a little more, to a few units of the fourth decimal.
    const double span = std::clamp((nd_.high - nd_.low) / factor, 1e-3, 1.5);
    const double by = span / (nd_.high - nd_.low);
    vd_ = {vd + (vd_.low - vd) * by, vd + (vd_.high - vd) * by};
    nd_ = {nd + (nd_.low - nd) * by, nd + (nd_.high - nd) * by};
    refresh();
}

void GlassMapView::mousePressEvent(QMouseEvent* event) {
    pressed_at_ = last_ = event->position();
    panned_ = false;
    event->setAccepted(event->button() == Qt::LeftButton || event->button() == Qt::MiddleButton);
}

void GlassMapView::mouseMoveEvent(QMouseEvent* event) {
    if ((event->buttons() & (Qt::LeftButton | Qt::MiddleButton)) != 0) {
        const QPointF from_press = event->position() - pressed_at_;
        panned_ = panned_ || from_press.manhattanLength() >= QApplication::startDragDistance();
        if (panned_) {
            const QRectF area = plot();
            const QPointF by = event->position() - last_;
            const double vd = by.x() / area.width() * (vd_.high - vd_.low);
            const double nd = by.y() / area.height() * (nd_.high - nd_.low);
            vd_ = {vd_.low + vd, vd_.high + vd};
            nd_ = {nd_.low + nd, nd_.high + nd};
            refresh();
        }
    } else {
        const auto under = glass_at(event->position());
        if (under != hovered_) {
            hovered_ = under;
            refresh();
        }
    }
    last_ = event->position();
}

void GlassMapView::mouseReleaseEvent(QMouseEvent* event) {
    if (!panned_ && event->button() == Qt::LeftButton) {
        if (const auto under = glass_at(event->position())) {
            Q_EMIT glass_chosen(*under);
        }
    }
}

void GlassMapView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton && !glass_at(event->position())) {
        fit();
    }
}

void GlassMapView::wheelEvent(QWheelEvent* event) {
    const double notches = event->angleDelta().y() / degrees_per_notch;
    if (notches != 0.0) {
        stretch(std::pow(zoom_per_notch, notches), event->position());
    }
    event->accept();
}

void GlassMapView::leaveEvent(QEvent*) {
    hovered_.reset();
    refresh();
}

}  // namespace ghostlight
