#include "widgets/layout_overlay.h"

#include <QFont>
#include <QObject>
#include <QPainter>
#include <QPolygonF>

#include <algorithm>
#include <cmath>

#include "widgets/ghost_colors.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr double mark_radius_px = 8.0;
constexpr double label_gap_px = 6.0;
constexpr int small_font_px = 11;

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
    painter.drawText(QPointF(end.x() + label_gap_px, end.y()), QObject::tr("sensor"));
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
    QFont font = painter.font();
    font.setPixelSize(small_font_px);
    painter.setFont(font);
    if (hovered != nullptr) {
        paint_hovered(painter, drawing, plane, *hovered);
    }
    paint_sensor_label(painter, drawing, plane);
    paint_marks(painter, fans, plane);
}

}  // namespace ghostlight
