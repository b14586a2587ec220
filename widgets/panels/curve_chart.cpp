#include "widgets/panels/curve_chart.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>
#include <utility>

#include "widgets/number_text.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

/// The value of a curve at x, linear between its points.
double value_at(const CurveChart::Curve& curve, double x) {
    const auto after = std::ranges::lower_bound(curve.points, x, {}, &QPointF::x);
    if (after == curve.points.begin()) {
        return after->y();
    }
    if (after == curve.points.end()) {
        return curve.points.back().y();
    }
    const QPointF a = *std::prev(after), b = *after;
    return std::lerp(a.y(), b.y(), (x - a.x()) / (b.x() - a.x()));
}

QString axis_number(double value) { return QString::number(value, 'g', 4); }

}  // namespace

double round_step(double span, int about) {
    if (!(span > 0.0)) {
        return 1.0;
    }
    const double raw = span / about;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= raw * (1.0 - 1e-9)) {
            return step * power;
        }
    }
    return 10.0 * power;
}

CurveChart::CurveChart(const QString& title, const QString& unit, QWidget* parent)
    : QWidget(parent), title_(title), unit_(unit) {
    setMinimumSize(160, 120);
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void CurveChart::show_curves(std::vector<Curve> curves, std::vector<Mark> marks,
                             const QString& title) {
    curves_ = std::move(curves);
    marks_ = std::move(marks);
    title_ = title;
    reason_.clear();
    if (!curves_.empty() && !curves_.front().points.empty()) {
        first_ = curves_.front().points.front().x();
        last_ = curves_.front().points.back().x();
    }
    update();
}

void CurveChart::show_reason(const QString& reason) {
    curves_.clear();
    marks_.clear();
    reason_ = reason;
    update();
}

QRectF CurveChart::plot() const {
    const int line = fontMetrics().height();
    return QRectF(rect()).adjusted(44, line + 10, -14, -line - 8);
}

double CurveChart::top_percent() const {
    double largest = 0.0;
    for (const Curve& curve : curves_) {
        // Total reflection would leave nothing to see of a coating.
        std::vector<double> values;
        for (const QPointF& point : curve.points) {
            values.push_back(point.y());
        }
        std::ranges::sort(values);
        if (!values.empty()) {
            const double usual = values[values.size() * 85 / 100];
            largest = std::max(largest, std::min(values.back(), 3.0 * usual));
        }
    }
    const double step = round_step(std::max(largest, 0.1) * 1.15, 4);
    return std::min(100.0, std::ceil(std::max(largest, 0.1) * 1.15 / step) * step);
}

void CurveChart::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const Palette& colors = current_palette();
    painter.fillRect(rect(), colors.panel);
    const int line = fontMetrics().height();
    painter.setPen(colors.dim);
    if (curves_.empty()) {
        painter.drawText(rect().adjusted(12, 8, -12, -8), Qt::AlignCenter | Qt::TextWordWrap,
                         reason_);
        return;
    }
    const QRectF area = plot();
    const double top = top_percent();
    const auto x_of = [&](double x) {
        return area.left() + (x - first_) / (last_ - first_) * area.width();
    };
    const auto y_of = [&](double percent) { return area.bottom() - percent / top * area.height(); };
    for (const Mark& mark : marks_) {
        if (mark.to > mark.at) {
            QColor band = colors.amber;
            band.setAlphaF(0.14F);
            painter.fillRect(QRectF(QPointF(x_of(mark.at), area.top()),
                                    QPointF(std::min(x_of(mark.to), area.right()), area.bottom())),
                             band);
        }
    }
    const double y_step = round_step(top, 4);
    for (double y = 0.0; y <= top * (1.0 + 1e-9); y += y_step) {
        painter.setPen(QPen(colors.line, 1));
        painter.drawLine(QPointF(area.left(), y_of(y)), QPointF(area.right(), y_of(y)));
        painter.setPen(colors.dim);
        painter.drawText(QRectF(0, y_of(y) - line / 2.0, area.left() - 6, line),
                         Qt::AlignRight | Qt::AlignVCenter, axis_number(y));
    }
    const double x_step =
        round_step(last_ - first_, std::max(2, static_cast<int>(area.width() / 60)));
    for (double x = std::ceil(first_ / x_step) * x_step; x <= last_ * (1.0 + 1e-9); x += x_step) {
        painter.setPen(QPen(colors.line, 1));
        painter.drawLine(QPointF(x_of(x), area.bottom()), QPointF(x_of(x), area.bottom() + 4));
        painter.setPen(colors.dim);
        const bool is_last = x + x_step > last_ * (1.0 + 1e-9);
        QRectF place(x_of(x) - 40, area.bottom() + 4, 80, line);
        const QString text = axis_number(x) + (is_last ? " " + unit_ : QString());
        const double overhang =
            x_of(x) + fontMetrics().horizontalAdvance(text) / 2.0 + 4.0 - width();
        place.translate(-std::max(0.0, overhang), 0.0);
        painter.drawText(place, Qt::AlignCenter, text);
    }
    painter.save();
    painter.setClipRect(area.adjusted(-1, -1, 1, 1));
    for (const Curve& curve : curves_) {
        QPainterPath path;
        for (std::size_t k = 0; k < curve.points.size(); ++k) {
            const QPointF at(x_of(curve.points[k].x()),
                             y_of(std::min(curve.points[k].y(), 2 * top)));
            k == 0 ? path.moveTo(at) : path.lineTo(at);
        }
        painter.setPen(QPen(curve.color, 1.6, curve.dashed ? Qt::DashLine : Qt::SolidLine));
        painter.drawPath(path);
    }
    painter.restore();
    double taken = -1e9;
    int level = 0;
    for (const Mark& mark : marks_) {
        const double x = x_of(mark.at);
        painter.setPen(QPen(colors.amber, 1.4));
        painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
        // Labels that would meet go on lines of their own.
        const int width = fontMetrics().horizontalAdvance(mark.text) + 6;
        level = x < taken ? level + 1 : 0;
        taken = x + width;
        const bool leftwards = x + width > area.right();
        painter.drawText(
            QRectF(leftwards ? x - width : x + 3, area.top() + level * line, width, line),
            (leftwards ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter, mark.text);
    }
    // What each line is, on the right of the title; the values there, under the mouse.
    const bool reads = cursor_ >= 0.0;
    const double x = std::lerp(first_, last_, cursor_);
    painter.setPen(colors.text);
    painter.drawText(
        QRectF(12, 4, width() - 24, line), Qt::AlignLeft | Qt::AlignVCenter,
        reads ? QStringLiteral("%1 %2").arg(QString::number(x, 'f', 1), unit_) : title_);
    double right = width() - 14;
    for (auto curve = curves_.rbegin(); curve != curves_.rend(); ++curve) {
        const QString text =
            reads ? curve->name + " " + significant(value_at(*curve, x), 3) + " %" : curve->name;
        const int wide = fontMetrics().horizontalAdvance(text);
        painter.setPen(curve->color);
        painter.drawText(QRectF(right - wide, 4, wide, line), Qt::AlignVCenter, text);
        right -= wide + 12;
    }
    if (reads) {
        painter.setPen(QPen(colors.dim, 1, Qt::DotLine));
        painter.drawLine(QPointF(x_of(x), area.top()), QPointF(x_of(x), area.bottom()));
    }
}

void CurveChart::mouseMoveEvent(QMouseEvent* event) {
    const QRectF area = plot();
    const double share = (event->position().x() - area.left()) / area.width();
    cursor_ = share >= 0.0 && share <= 1.0 ? share : -1.0;
    update();
}

void CurveChart::leaveEvent(QEvent*) {
    cursor_ = -1.0;
    update();
}

}  // namespace ghostlight
