#include "widgets/panels/line_plot.h"

#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "widgets/number_text.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr int left_px = 58, right_px = 12, top_px = 24, bottom_px = 38;

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void take(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool is_empty() const { return !(low <= high); }
    double share(double value) const { return (value - low) / (high - low); }
};

/// Some four steps of 1, 2 or 5 times a power of ten.
double step_of(const Range& range) {
    const double rough = (range.high - range.low) / 4.0;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double in_power = rough / power;
    return power * (in_power < 1.5 ? 1.0 : in_power < 3.5 ? 2.0 : in_power < 7.5 ? 5.0 : 10.0);
}

}  // namespace

LinePlot::LinePlot(QWidget* parent) : QWidget(parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void LinePlot::set_axes(const QString& x_title, const QString& y_title, bool log_y) {
    x_title_ = x_title;
    y_title_ = y_title;
    log_y_ = log_y;
}

void LinePlot::set_curves(std::vector<Curve> curves) {
    curves_ = std::move(curves);
    update();
}

void LinePlot::paintEvent(QPaintEvent*) {
    const Palette& colors = current_palette();
    QPainter painter(this);
    painter.fillRect(rect(), colors.panel);
    const auto height_of = [this](double y) { return log_y_ ? std::log10(y) : y; };
    Range x, y;
    for (const Curve& curve : curves_) {
        for (const QPolygonF* points : {&curve.points, &curve.band}) {
            for (const QPointF& point : *points) {
                if (std::isfinite(height_of(point.y()))) {
                    x.take(point.x());
                    y.take(height_of(point.y()));
                }
            }
        }
    }
    const QRectF area(left_px, top_px, std::max(10, width() - left_px - right_px),
                      std::max(10, height() - top_px - bottom_px));
    painter.setPen(colors.dim);
    painter.drawText(QRectF(0, area.bottom() + 19, width(), 18), Qt::AlignCenter, x_title_);
    painter.drawText(QRectF(8, 2, width() - 16.0, 18), Qt::AlignLeft | Qt::AlignVCenter,
                     title_.isEmpty() ? y_title_ : title_ + QStringLiteral(" · ") + y_title_);
    if (x.is_empty()) {
        painter.drawText(area, Qt::AlignCenter, tr("nothing yet"));
        return;
    }
    if (!log_y_) {
        y.take(0.0);
    }
    if (x.high - x.low < 1e-12) {
        x.high = x.low + 1.0;
    }
    const double least = std::max(1e-12, 0.02 * std::abs(y.high));
    if (y.high - y.low < least) {
        y.high += 0.5 * least;
        y.low -= 0.5 * least;
    }
    const auto at = [&](const QPointF& point) {
        return QPointF(area.left() + x.share(point.x()) * area.width(),
                       area.bottom() - y.share(height_of(point.y())) * area.height());
    };
    const QFontMetrics& font = painter.fontMetrics();
    const double dy = step_of(y);
    for (double value = std::ceil(y.low / dy) * dy; value <= y.high + 1e-9 * dy; value += dy) {
        const double v = area.bottom() - y.share(value) * area.height();
        painter.setPen(colors.line);
        painter.drawLine(QPointF(area.left(), v), QPointF(area.right(), v));
        painter.setPen(colors.dim);
        const double shown =
            log_y_ ? std::pow(10.0, value) : (std::abs(value) < 1e-9 * dy ? 0 : value);
        painter.drawText(QRectF(0, v - 9, left_px - 8.0, 18), Qt::AlignRight | Qt::AlignVCenter,
                         significant(shown, 3));
    }
    const double dx = step_of(x);
    for (double value = std::ceil(x.low / dx) * dx; value <= x.high + 1e-9 * dx; value += dx) {
        const double u = area.left() + x.share(value) * area.width();
        const QString text = shortest(std::abs(value) < 1e-9 * dx ? 0 : value);
        painter.setPen(colors.dim);
        const double half = 0.5 * font.horizontalAdvance(text) + 2.0;
        painter.drawText(QRectF(u - half, area.bottom() + 3, 2.0 * half, 16), Qt::AlignCenter,
                         text);
    }
    painter.setClipRect(area.adjusted(-1, -1, 1, 1));
    painter.setRenderHint(QPainter::Antialiasing);
    for (const Curve& curve : curves_) {
        if (!curve.band.isEmpty()) {
            QPolygonF band;
            for (const QPointF& point : curve.band) {
                band << at(point);
            }
            QColor faint = curve.color;
            faint.setAlphaF(0.25F);
            painter.setPen(Qt::NoPen);
            painter.setBrush(faint);
            painter.drawPolygon(band);
            painter.setBrush(Qt::NoBrush);
        }
        QPainterPath path;
        bool is_open = false;
        for (const QPointF& point : curve.points) {
            if (!std::isfinite(height_of(point.y()))) {
                is_open = false;
                continue;
            }
            is_open ? path.lineTo(at(point)) : path.moveTo(at(point));
            is_open = true;
        }
        painter.setPen(QPen(curve.color, 1.5, curve.dashed ? Qt::DashLine : Qt::SolidLine));
        painter.drawPath(path);
    }
    painter.setClipping(false);
    double from = area.right();
    for (const Curve& curve : curves_) {
        if (curve.name.isEmpty()) {
            continue;
        }
        from -= font.horizontalAdvance(curve.name) + 14;
        painter.setPen(curve.color);
        painter.drawText(QRectF(from, 2, font.horizontalAdvance(curve.name) + 12.0, 18),
                         Qt::AlignLeft | Qt::AlignVCenter, curve.name);
    }
}

}  // namespace ghostlight
