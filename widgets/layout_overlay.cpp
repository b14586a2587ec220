#include "widgets/layout_overlay.h"

#include <QCoreApplication>

#include <QFont>
#include <QObject>
#include <QPainter>
#include <QPolygonF>

#include <algorithm>
#include <cmath>

#include "widgets/ghost_colors.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct LayoutOverlay {
    Q_DECLARE_TR_FUNCTIONS(LayoutOverlay)
};

constexpr double mark_radius_px = 8.0;
constexpr double label_gap_px = 6.0;

void paint_hovered(QPainter& painter, const LensDrawing& drawing, const PlaneView& plane,
                   const SurfaceOutline& surface) {
    painter.setPen(QPen(current_palette().teal, 2.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    if (surface.is_stop) {
        const StopBars& stop = drawing.stop;
        for (const double side : {-1.0, 1.0}) {
            painter.drawLine(plane.to_view({stop.z_mm, side * stop.opening_mm}),
                             plane.to_view({stop.z_mm, side * stop.outer_mm}));
        }
        return;
    }
    QPolygonF line;
    for (const DrawingPoint& point : surface.points) {
        line << plane.to_view(point);
    }
    painter.drawPolyline(line);
}

/// Behind the sensor, where no ray goes.
void paint_sensor_label(QPainter& painter, const LensDrawing& drawing, const PlaneView& plane) {
    const QPointF end = plane.to_view({drawing.sensor.z_mm, -drawing.sensor.half_length_mm});
    painter.setPen(current_palette().dim);
    painter.drawText(QPointF(end.x() + label_gap_px, end.y()), LayoutOverlay::tr("sensor"));
}

struct PlacedMark {
    QPointF at;
    int number;
    QColor color;
};

/// Marks that would cover each other move apart along the line between them.
void spread(std::vector<PlacedMark>& marks) {
    const double wanted = 2.0 * mark_radius_px + 2.0;
    for (int pass = 0; pass < 8; ++pass) {
        for (std::size_t i = 0; i < marks.size(); ++i) {
            for (std::size_t k = i + 1; k < marks.size(); ++k) {
                const QPointF off = marks[k].at - marks[i].at;
                const double distance = std::hypot(off.x(), off.y());
                if (distance >= wanted) {
                    continue;
                }
                const QPointF along = distance > 0.5 ? off / distance : QPointF(0.0, 1.0);
                marks[i].at -= along * (wanted - distance) / 2.0;
                marks[k].at += along * (wanted - distance) / 2.0;
            }
        }
    }
}

void paint_marks(QPainter& painter, const std::vector<RayFan>& fans, const PlaneView& plane) {
    const Palette& colors = current_palette();
    std::vector<PlacedMark> marks;
    const auto ghosts =
        std::ranges::count_if(fans, [](const RayFan& fan) { return !fan.path.is_direct(); });
    for (const RayFan& fan : fans) {
        for (const ReflectionMark& mark : fan.marks) {
            marks.push_back({plane.to_view(mark.at), mark.number,
                             ghosts > 1 ? ghost_color(fan.path) : colors.red_orange});
        }
    }
    spread(marks);
    for (const PlacedMark& mark : marks) {
        painter.setPen(QPen(mark.color, 1.25));
        painter.setBrush(colors.panel);
        painter.drawEllipse(mark.at, mark_radius_px, mark_radius_px);
        painter.setPen(colors.text);
        painter.drawText(QRectF(mark.at.x() - mark_radius_px, mark.at.y() - mark_radius_px,
                                2.0 * mark_radius_px, 2.0 * mark_radius_px),
                         Qt::AlignCenter, QString::number(mark.number));
    }
}

}  // namespace

void paint_layout_overlay(QPainter& painter, const LensDrawing& drawing,
                          const std::vector<RayFan>& fans, const PlaneView& plane,
                          const SurfaceOutline* hovered) {
    painter.setFont(small_font());
    if (hovered != nullptr) {
        paint_hovered(painter, drawing, plane, *hovered);
    }
    paint_sensor_label(painter, drawing, plane);
    paint_marks(painter, fans, plane);
}

void paint_axis_marks(QPainter& painter, const std::vector<AxisMark>& marks,
                      const PlaneView& plane) {
    constexpr double tick_px = 6.0;
    const Palette& colors = current_palette();
    for (const AxisMark& mark : marks) {
        const QPointF at = plane.to_view({mark.z_mm, 0.0});
        const bool is_ghost = mark.kind == AxisMark::Kind::ghost_focus;
        const QColor color = is_ghost ? ghost_color(mark.path) : colors.dim;
        painter.setPen(QPen(color, 1.5));
        double label_px = tick_px;
        if (mark.half_height_mm > 0.0) {
            painter.setPen(QPen(color, 1.25, Qt::DashLine));
            painter.drawLine(plane.to_view({mark.z_mm, -mark.half_height_mm}),
                             plane.to_view({mark.z_mm, mark.half_height_mm}));
            label_px = at.y() - plane.to_view({mark.z_mm, mark.half_height_mm}).y();
        } else if (is_ghost) {
            painter.setBrush(color);
            painter.drawPolygon(QPolygonF({at + QPointF(0, -5), at + QPointF(5, 0),
                                           at + QPointF(0, 5), at + QPointF(-5, 0)}));
        } else {
            painter.drawLine(at + QPointF(0, -tick_px), at + QPointF(0, tick_px));
        }
        // Those of ghosts below the axis: they crowd around the sensor.
        const double y = is_ghost ? at.y() + 18.0 : at.y() - label_px - 5.0;
        painter.drawText(QRectF(at.x() - 40.0, y - 9.0, 80.0, 14.0), Qt::AlignCenter,
                         QString::fromStdString(mark.label));
    }
}

namespace {

void paint_label(QPainter& painter, QPointF at, const QString& text, QSizeF view_px) {
    const Palette& colors = current_palette();
    const QFontMetricsF metrics(painter.font());
    QRectF box(at.x() + 12.0, at.y() + 12.0, metrics.horizontalAdvance(text) + 14.0,
               metrics.height() + 8.0);
    box.moveLeft(std::max(2.0, std::min(box.left(), view_px.width() - box.width() - 2.0)));
    box.moveTop(std::max(2.0, std::min(box.top(), view_px.height() - box.height() - 2.0)));
    painter.setPen(QPen(colors.line, 1.0));
    painter.setBrush(colors.panel);
    painter.drawRoundedRect(box, 3.0, 3.0);
    painter.setPen(colors.text);
    painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace

void paint_meeting(QPainter& painter, const RayMeeting& meeting, const PlaneView& plane) {
    const QPointF at = plane.to_view(meeting.at);
    painter.setPen(QPen(current_palette().teal, 1.5));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(at, 4.0, 4.0);
    paint_label(
        painter, at,
        LayoutOverlay::tr("surface %1 · %2 · %3° · R %4 % · T %5 %")
            .arg(meeting.row + 1)
            .arg(meeting.reflected ? LayoutOverlay::tr("reflected") : LayoutOverlay::tr("passes"),
                 QString::number(meeting.incidence_deg, 'f', 1),
                 significant(100.0 * meeting.reflectance, 3),
                 significant(100.0 * meeting.transmittance, 4)),
        plane.size_px());
}

void paint_measure(QPainter& painter, DrawingPoint from, DrawingPoint to, const PlaneView& plane) {
    const Palette& colors = current_palette();
    const QPointF a = plane.to_view(from), b = plane.to_view(to);
    painter.setPen(QPen(colors.teal, 1.5));
    painter.drawLine(a, b);
    for (const QPointF& end : {a, b}) {
        painter.drawEllipse(end, 3.0, 3.0);
    }
    paint_label(
        painter, b,
        LayoutOverlay::tr("%1 mm   along %2   across %3")
            .arg(significant(std::hypot(to.x - from.x, to.y - from.y)),
                 significant(std::abs(to.x - from.x)), significant(std::abs(to.y - from.y))),
        plane.size_px());
}

}  // namespace ghostlight
