#include "widgets/layout_export.h"

#include <QCoreApplication>

#include <QFileInfo>
#include <QImage>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QPolygonF>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/io/lens_file.h"
#include "widgets/layout_actors.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct LayoutExport {
    Q_DECLARE_TR_FUNCTIONS(LayoutExport)
};

constexpr double longest_px = 1200.0;
constexpr double margin_px = 24.0;
constexpr double png_ratio = 2.0;
constexpr double px_per_inch = 96.0;

/// Where the drawing's plane lies on the paper.
struct Sheet {
    DrawingBox box;
    double px_per_mm = 1.0;
    double width_px = 0.0, height_px = 0.0;

    explicit Sheet(const DrawingBox& drawn) : box(drawn) {
        const double across = std::max(1e-6, box.z_max - box.z_min);
        const double up = std::max(1e-6, box.y_max - box.y_min);
        px_per_mm = (longest_px - 2.0 * margin_px) / std::max(across, up);
        width_px = std::ceil(across * px_per_mm + 2.0 * margin_px);
        height_px = std::ceil(up * px_per_mm + 2.0 * margin_px);
    }
    QPointF at(DrawingPoint point) const {
        return {margin_px + (point.x - box.z_min) * px_per_mm,
                margin_px + (box.y_max - point.y) * px_per_mm};
    }
};

void paint(QPainter& painter, const Sheet& sheet, const std::vector<PaperShape>& shapes) {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setClipRect(QRectF(0.0, 0.0, sheet.width_px, sheet.height_px));
    for (const PaperShape& shape : shapes) {
        QPolygonF line;
        for (const DrawingPoint& point : shape.points) {
            line << sheet.at(point);
        }
        if (shape.width_px <= 0.0) {
            painter.setPen(Qt::NoPen);
            painter.setBrush(shape.color);
            painter.drawPolygon(line);
        } else {
            painter.setPen(QPen(shape.color, shape.width_px));
            painter.setBrush(Qt::NoBrush);
            shape.closed ? painter.drawPolygon(line) : painter.drawPolyline(line);
        }
    }
}

}  // namespace

std::vector<PaperShape> paper_shapes(const LensDrawing& drawing, const std::vector<RayFan>& fans,
                                     const std::vector<AxisMark>& marks) {
    const Palette colors = light_palette();
    std::vector<PaperShape> shapes;
    for (const GlassElement& element : drawing.elements) {
        shapes.push_back({element.outline, glass_tint(element.n, colors), 0.0, true});
        shapes.push_back({element.outline, colors.dim, 1.0, true});
    }
    for (const SurfaceOutline& surface : drawing.surfaces) {
        if (!surface.refracts && !surface.is_stop) {
            shapes.push_back({surface.points, colors.line, 1.0, false});
        }
    }
    shapes.push_back(
        {{{drawing.box.z_min, 0.0}, {drawing.box.z_max, 0.0}}, colors.line, 0.75, false});
    const bool many = is_many(fans);
    for (const RayFan& fan : fans) {
        for (const RayStretch& stretch : fan.stretches) {
            shapes.push_back(
                {stretch.points, ray_color(fan, stretch.leg, many, colors), 0.9, false});
        }
    }
    for (const double side : {-1.0, 1.0}) {
        shapes.push_back({{{drawing.stop.z_mm, side * drawing.stop.opening_mm},
                           {drawing.stop.z_mm, side * drawing.stop.outer_mm}},
                          colors.text,
                          2.0,
                          false});
    }
    shapes.push_back({{{drawing.sensor.z_mm, -drawing.sensor.half_length_mm},
                       {drawing.sensor.z_mm, drawing.sensor.half_length_mm}},
                      colors.text,
                      2.0,
                      false});
    for (const AxisMark& mark : marks) {
        const double half_mm = mark.half_height_mm > 0.0 ? mark.half_height_mm : 1.0;
        shapes.push_back({{{mark.z_mm, -half_mm}, {mark.z_mm, half_mm}}, colors.teal, 1.0, false});
    }
    return shapes;
}

QString layout_as_svg(const std::vector<PaperShape>& shapes, const DrawingBox& box) {
    const Sheet sheet(box);
    QString svg = QStringLiteral(
                      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%1\" height=\"%2\" "
                      "viewBox=\"0 0 %1 %2\">\n<rect width=\"%1\" height=\"%2\" fill=\"#fff\"/>\n")
                      .arg(sheet.width_px)
                      .arg(sheet.height_px);
    for (const PaperShape& shape : shapes) {
        QString points;
        for (const DrawingPoint& point : shape.points) {
            const QPointF at = sheet.at(point);
            points += QStringLiteral("%1,%2 ").arg(QString::number(at.x(), 'f', 2),
                                                   QString::number(at.y(), 'f', 2));
        }
        const QString color = shape.color.name();
        svg += QStringLiteral("<%1 points=\"%2\" ")
                   .arg(shape.closed ? "polygon" : "polyline", points.trimmed());
        svg += shape.width_px <= 0.0
                   ? QStringLiteral("fill=\"%1\"/>\n").arg(color)
                   : QStringLiteral("fill=\"none\" stroke=\"%1\" stroke-width=\"%2\"/>\n")
                         .arg(color)
                         .arg(shape.width_px);
    }
    return svg + QStringLiteral("</svg>\n");
}

void export_layout(const QString& file, const std::vector<PaperShape>& shapes,
                   const DrawingBox& box) {
    const QString kind = QFileInfo(file).suffix().toLower();
    const Sheet sheet(box);
    const auto refuse = [&](const QString& problem, const QString& expected) {
        throw Error({problem.toStdString(), file.toStdString(), {}, {}, expected.toStdString()});
    };
    if (kind == "svg") {
        write_file_safely(file.toStdString(), layout_as_svg(shapes, box).toStdString());
    } else if (kind == "pdf") {
        QPdfWriter writer(file);
        writer.setResolution(static_cast<int>(px_per_inch));
        writer.setPageSize(QPageSize(
            QSizeF(sheet.width_px / px_per_inch, sheet.height_px / px_per_inch), QPageSize::Inch));
        writer.setPageMargins(QMarginsF());
        QPainter painter;
        if (!painter.begin(&writer)) {
            refuse(LayoutExport::tr("cannot write the drawing"),
                   LayoutExport::tr("a file that can be written"));
        }
        paint(painter, sheet, shapes);
    } else if (kind == "png") {
        QImage picture((QSizeF(sheet.width_px, sheet.height_px) * png_ratio).toSize(),
                       QImage::Format_RGB32);
        picture.fill(Qt::white);
        QPainter painter(&picture);
        painter.scale(png_ratio, png_ratio);
        paint(painter, sheet, shapes);
        painter.end();
        if (!picture.save(file)) {
            refuse(LayoutExport::tr("cannot write the drawing"),
                   LayoutExport::tr("a file that can be written"));
        }
    } else {
        refuse(LayoutExport::tr("not a kind of drawing"),
               LayoutExport::tr("a name that ends in .svg, .pdf or .png"));
    }
}

}  // namespace ghostlight
