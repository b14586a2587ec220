#include "widgets/flare_overlay.h"

#include <QCoreApplication>

#include <QFont>
#include <QFontMetricsF>
#include <QObject>
#include <QPainter>
#include <QPolygonF>

#include <algorithm>
#include <cmath>

#include "core/flare/false_color.h"
#include "widgets/light_marker.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct FlareOverlay {
    Q_DECLARE_TR_FUNCTIONS(FlareOverlay)
};

constexpr double ring_radius_px = 7.0;
constexpr double other_radius_px = 5.0, other_opacity = 0.75;  // of lights that are not chosen
constexpr double border_px = 14.0;  // of the arrow's tip from the view's edge
constexpr double arrow_length_px = 12.0, arrow_half_width_px = 6.0;
constexpr double readout_offset_px = 16.0, readout_padding_px = 8.0;
constexpr double swatch_px = 9.0;
constexpr double under_px = 4.0;  // a dark line under the amber one keeps it visible on white

/// Over a picture that is dark in either theme.
QColor light_color() { return dark_palette().amber; }

void paint_ring(QPainter& painter, QPointF at, double radius_px, double line_px) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(0, 0, 0, 150), line_px + under_px - 1.75));
    painter.drawEllipse(at, radius_px, radius_px);
    painter.setPen(QPen(light_color(), line_px));
    painter.drawEllipse(at, radius_px, radius_px);
}

bool is_within(QSizeF view_px, const glm::dvec2& at) {
    return at.x >= 0.0 && at.y >= 0.0 && at.x < view_px.width() && at.y < view_px.height();
}

void paint_arrow(QPainter& painter, QPointF center, QPointF light, QSizeF view_px,
                 const QString& label) {
    QPointF along = light - center;
    along /= std::hypot(along.x(), along.y());
    // From the picture's centre to the border of the view.
    const double right = view_px.width() - border_px, bottom = view_px.height() - border_px;
    double reach = std::hypot(view_px.width(), view_px.height());
    const auto limit = [&](double from, double step, double low, double high) {
        if (step != 0.0) {
            reach = std::min(reach, std::max(0.0, ((step > 0.0 ? high : low) - from) / step));
        }
    };
    limit(center.x(), along.x(), border_px, right);
    limit(center.y(), along.y(), border_px, bottom);
    const QPointF tip = center + along * reach;
    const QPointF across(-along.y(), along.x());
    const QPointF tail = tip - along * arrow_length_px;
    const QPolygonF arrow{{tip, tail + across * arrow_half_width_px, tail + along * 3.0,
                           tail - across * arrow_half_width_px}};
    painter.setBrush(light_color());
    painter.setPen(QPen(QColor(0, 0, 0, 150), 1.5));
    painter.drawPolygon(arrow);

    const QFontMetricsF metrics(painter.font());
    const QSizeF text(metrics.horizontalAdvance(label), metrics.height());
    QPointF middle = tail - along * (6.0 + std::abs(along.x()) * text.width() / 2.0 +
                                     std::abs(along.y()) * text.height() / 2.0);
    QRectF box(middle.x() - text.width() / 2.0, middle.y() - text.height() / 2.0, text.width(),
               text.height());
    box.moveLeft(std::clamp(box.left(), 4.0, std::max(4.0, view_px.width() - text.width() - 4.0)));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(0, 0, 0, 150));
    painter.drawRoundedRect(box.adjusted(-4.0, -1.0, 4.0, 1.0), 3.0, 3.0);
    painter.setPen(light_color());
    painter.drawText(box, Qt::AlignCenter, label);
}

}  // namespace

void paint_light(QPainter& painter, const PictureFrame& frame, QSizeF view_px,
                 const LightDirection& light, double efl_mm) {
    const glm::dvec2 at = frame.view_from_sensor(light_on_sensor_mm(light, efl_mm));
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) {
        return;
    }
    if (is_within(view_px, at)) {
        paint_ring(painter, {at.x, at.y}, ring_radius_px, 1.75);
        return;
    }
    const glm::dvec2 center = frame.view_from_sensor({0.0, 0.0});
    const QPointF from(std::clamp(center.x, border_px, view_px.width() - border_px),
                       std::clamp(center.y, border_px, view_px.height() - border_px));
    paint_arrow(painter, from, {at.x, at.y}, view_px,
                QString::number(light.field_deg, 'f', 1) + QChar(0xb0));
}

void paint_other_lights(QPainter& painter, const PictureFrame& frame, QSizeF view_px,
                        const std::vector<LightDirection>& lights, double efl_mm) {
    painter.save();
    painter.setOpacity(other_opacity);
    for (const LightDirection& light : lights) {
        const glm::dvec2 at = frame.view_from_sensor(light_on_sensor_mm(light, efl_mm));
        if (is_within(view_px, at)) {
            paint_ring(painter, {at.x, at.y}, other_radius_px, 1.0);
        }
    }
    painter.restore();
}

std::optional<float> irradiance_at(const FlareImage& image, double x_mm, double y_mm) {
    const double across = x_mm / image.sensor_width_mm + 0.5;
    const double up = y_mm / image.sensor_height_mm + 0.5;
    if (!(across >= 0.0 && across < 1.0 && up >= 0.0 && up < 1.0)) {
        return std::nullopt;
    }
    const auto column = static_cast<std::size_t>(across * image.width_px);
    const auto row = static_cast<std::size_t>(up * image.height_px);
    const std::size_t index = row * static_cast<std::size_t>(image.width_px) + column;
    return index < image.irradiance.size() ? std::optional(image.irradiance[index]) : std::nullopt;
}

QString position_text(double x_mm, double y_mm) {
    const auto hundredths = [](double mm) {
        return QString::number(std::round(mm * 100.0) / 100.0 + 0.0, 'f', 2);  // no minus zero
    };
    QString text = QStringLiteral("%1, %2 mm").arg(hundredths(x_mm), hundredths(y_mm));
    return text.replace('-', QChar(0x2212));
}

void paint_readout(QPainter& painter, const PictureFrame& frame, QSizeF view_px,
                   const FlareImage& image, QPointF cursor, const std::vector<ReadoutLine>& lines) {
    const glm::dvec2 point = frame.sensor_from_view({cursor.x(), cursor.y()});
    const std::optional<float> irradiance = irradiance_at(image, point.x, point.y);
    if (!irradiance) {
        return;
    }
    const Palette& colors = current_palette();
    const QString position = position_text(point.x, point.y);
    const QString amount = *irradiance > 0.0F
                               ? FlareOverlay::tr("irradiance %1 E₀")
                                     .arg(significant(static_cast<double>(*irradiance), 2))
                               : FlareOverlay::tr("no ghost here");
    QFont bold = painter.font();
    bold.setWeight(QFont::DemiBold);
    const QFontMetricsF bold_metrics(bold), metrics(painter.font());
    const double line = metrics.height() + 2.0;
    double width =
        std::max(bold_metrics.horizontalAdvance(position), metrics.horizontalAdvance(amount)) +
        2.0 * readout_padding_px;
    for (const ReadoutLine& each : lines) {
        width = std::max(width, metrics.horizontalAdvance(each.name) +
                                    metrics.horizontalAdvance(each.amount) +
                                    2.0 * readout_padding_px + swatch_px + 24.0);
    }
    QRectF box(cursor.x() + readout_offset_px, cursor.y() + readout_offset_px, std::ceil(width),

               std::ceil((2.0 + static_cast<double>(lines.size())) * line +
                         2.0 * readout_padding_px - 2.0));
    // On the cursor's other side where there is no room.
    if (box.right() > view_px.width() - 4.0) {
        box.moveRight(cursor.x() - readout_offset_px);
    }
    if (box.bottom() > view_px.height() - 4.0) {
        box.moveBottom(cursor.y() - readout_offset_px);
    }
    QColor ground = colors.panel;
    ground.setAlphaF(0.93F);
    painter.setBrush(ground);
    painter.setPen(QPen(colors.line, 1.0));
    painter.drawRoundedRect(box, 4.0, 4.0);
    const QFont plain = painter.font();
    const QRectF inside = box.adjusted(readout_padding_px, readout_padding_px - 1.0, 0.0, 0.0);
    painter.setFont(bold);
    painter.setPen(colors.text);
    painter.drawText(inside, Qt::AlignLeft | Qt::AlignTop, position);
    painter.setFont(plain);
    painter.drawText(inside.translated(0.0, line), Qt::AlignLeft | Qt::AlignTop, amount);
    double top = inside.top() + 2.0 * line;
    for (const ReadoutLine& each : lines) {
        double left = inside.left();
        if (each.swatch.isValid()) {
            painter.fillRect(QRectF(left, top + (line - swatch_px) / 2.0, swatch_px, swatch_px),
                             each.swatch);
            left += swatch_px + 6.0;
        }
        const QRectF place(left, top, box.right() - readout_padding_px - left, line);
        painter.setPen(each.amount.isEmpty() ? colors.dim : colors.text);
        painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter, each.name);
        painter.drawText(place, Qt::AlignRight | Qt::AlignVCenter, each.amount);
        top += line;
    }
}

void paint_false_color_scale(QPainter& painter, QSizeF view_px,
                             const PictureLook::Decades& decades) {
    constexpr int bands = 96;
    const double height = std::min(220.0, view_px.height() - 80.0);
    if (height < 40.0) {
        return;
    }
    const QRectF bar(view_px.width() - 66.0, 44.0, 12.0, height);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(0, 0, 0, 225));
    painter.drawRoundedRect(bar.adjusted(-10.0, -28.0, 50.0, 12.0), 4.0, 4.0);
    for (int k = 0; k < bands; ++k) {
        const auto rgb = false_color((static_cast<float>(k) + 0.5F) / bands);
        painter.fillRect(QRectF(bar.left(), bar.bottom() - (k + 1) * height / bands, bar.width(),
                                height / bands + 0.5),
                         QColor::fromRgbF(rgb[0], rgb[1], rgb[2]));
    }
    painter.setPen(dark_palette().text);
    painter.drawText(QRectF(bar.left() - 8.0, bar.top() - 24.0, 60.0, 16.0), Qt::AlignLeft,
                     FlareOverlay::tr("E / E₀"));
    const int low = static_cast<int>(std::lround(decades.low));
    const int high = static_cast<int>(std::lround(decades.high));
    for (int decade = low; decade <= high; ++decade) {
        const double y = bar.bottom() - height * (decade - low) / std::max(1, high - low);
        painter.drawText(QRectF(bar.right() + 5.0, y - 8.0, 44.0, 16.0),
                         Qt::AlignLeft | Qt::AlignVCenter, significant(std::pow(10.0, decade), 1));
    }
}

}  // namespace ghostlight
