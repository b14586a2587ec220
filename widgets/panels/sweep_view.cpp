#include "widgets/panels/sweep_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>

#include "core/flare/tone_map.h"
#include "render/auto_exposure.h"
#include "widgets/ghost_colors.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

constexpr std::size_t most_curves = 6;  // besides those selected
constexpr double margin_px = 12.0, left_px = 58.0, legend_px = 170.0, strip_px = 72.0;
constexpr double below_px = 34.0, reach_px = 7.0;
constexpr double shown_decades = 4.0;
constexpr double label_px = 15.0;  // between two labels of the scale, at least

QImage toned(const FlareImage& image, double exposure_ev) {
    QImage picture(image.width_px, image.height_px, QImage::Format_RGB32);
    const std::vector<float> upright =
        upright_picture(image.rgb, image.width_px, image.height_px, 3);
    for (int y = 0; y < image.height_px; ++y) {
        auto* line = reinterpret_cast<QRgb*>(picture.scanLine(y));
        for (int x = 0; x < image.width_px; ++x) {
            const auto at = 3 * static_cast<std::size_t>(y * image.width_px + x);
            const auto shown =
                tone_mapped({upright[at], upright[at + 1], upright[at + 2]}, exposure_ev);
            const auto byte = [](float value) {
                return static_cast<int>(std::lround(255.0F * value));
            };
            line[x] = qRgb(byte(shown[0]), byte(shown[1]), byte(shown[2]));
        }
    }
    return picture;
}

QString title_of(SweepQuantity quantity) {
    switch (quantity) {
        case SweepQuantity::on_sensor_flux:
            return SweepView::tr("flux on the sensor, mm²");
        case SweepQuantity::peak:
            return SweepView::tr("peak, E0");
        case SweepQuantity::flux:
            break;
    }
    return SweepView::tr("flux, mm²");
}

}  // namespace

SweepView::SweepView(QWidget* parent) : QWidget(parent) {
    setObjectName("sweep_view");
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Flares and curves of the sweep"));
    setToolTip(
        tr("A click takes a flare's value, or chooses a curve's ghost. Keys: ← → go from flare to "
           "flare, Return takes its value, ↑ ↓ choose a curve"));
}

void SweepView::show_points(const SweepParameter& parameter, std::vector<SweepPoint> points,
                            std::size_t wanted, std::size_t surface_count) {
    parameter_ = parameter;
    points_ = std::move(points);
    wanted_ = wanted;
    surface_count_ = surface_count;
    current_ = std::min(current_, points_.empty() ? 0 : points_.size() - 1);
    set_quantity(quantity_);
    make_flares();
}

void SweepView::make_flares() {
    // One exposure for all: the strip shows where the flare is worst.
    flares_.assign(points_.size(), QImage());
    std::optional<double> exposure_ev;
    for (const SweepPoint& point : points_) {
        if (point.picture) {
            const double own = auto_exposure_ev(*point.picture);
            exposure_ev = exposure_ev ? std::min(*exposure_ev, own) : own;
        }
    }
    for (std::size_t k = 0; k < points_.size(); ++k) {
        if (points_[k].picture) {
            flares_[k] = toned(*points_[k].picture, *exposure_ev);
        }
    }
    update();
}

void SweepView::set_quantity(SweepQuantity quantity) {
    quantity_ = quantity;
    curves_ = curves_of(points_, quantity);
    low_ = high_ = points_.empty() ? 0.0 : points_.front().value;
    for (const SweepPoint& point : points_) {
        low_ = std::min(low_, point.value);
        high_ = std::max(high_, point.value);
    }
    const double largest = curves_.empty() ? 1.0 : curves_.front().largest();
    top_ = largest > 0.0 ? std::log10(largest) + 0.15 : 0.0;
    bottom_ = top_ - shown_decades;
    update();
}

void SweepView::set_selected(std::vector<GhostPath> ghosts) {
    selected_ = std::move(ghosts);
    update();
}

std::vector<SweepView::Shown> SweepView::shown_curves() const {
    std::vector<Shown> shown;
    for (std::size_t k = 0; k < curves_.size(); ++k) {
        const bool selected = std::ranges::find(selected_, curves_[k].path) != selected_.end();
        if (k < most_curves || selected) {
            shown.push_back({&curves_[k], selected});
        }
    }
    return shown;
}

QRectF SweepView::chart() const {
    const bool has_flares = std::ranges::any_of(
        points_, [](const SweepPoint& point) { return point.picture != nullptr; });
    const double top = margin_px + (has_flares ? strip_px + 22.0 : 16.0);
    return {left_px, top, std::max(40.0, width() - left_px - legend_px),
            std::max(30.0, height() - top - below_px)};
}

QRectF SweepView::flare_place(std::size_t point) const {
    const QRectF within(left_px, margin_px, std::max(40.0, width() - left_px - margin_px),
                        strip_px);
    const double breadth = within.width() / static_cast<double>(std::max<std::size_t>(1, wanted_));
    return {within.left() + static_cast<double>(point) * breadth, within.top(), breadth - 4.0,
            strip_px};
}

QPointF SweepView::curve_place(const GhostCurve& curve, std::size_t point) const {
    const QRectF box = chart();
    const double across = high_ > low_ ? (points_[point].value - low_) / (high_ - low_) : 0.5;
    const double value = curve.values[point];
    const double up =
        value > 0.0 ? std::clamp((std::log10(value) - bottom_) / (top_ - bottom_), 0.0, 1.0) : 0.0;
    return {box.left() + across * box.width(), box.bottom() - up * box.height()};
}

void SweepView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const Palette& colors = current_palette();
    painter.fillRect(rect(), colors.panel);
    painter.setFont(small_font());
    if (points_.empty()) {
        painter.setPen(colors.dim);
        painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                         tr("Flares and ghosts while one number runs through its range.\n"
                            "Name it above and press Sweep."));
        return;
    }
    const QString unit = QString::fromUtf8(unit_of(parameter_));
    for (std::size_t k = 0; k < points_.size(); ++k) {
        if (!flares_[k].isNull()) {
            const QRectF place = flare_place(k);
            const QSizeF size = QSizeF(flares_[k].size()).scaled(place.size(), Qt::KeepAspectRatio);
            const QRectF picture(place.left() + (place.width() - size.width()) / 2.0, place.top(),
                                 size.width(), size.height());
            painter.drawImage(picture, flares_[k]);
            const bool is_current = hasFocus() && k == current_;
            if (is_current) {
                painter.setPen(QPen(colors.teal, 2.0));
                painter.setBrush(Qt::NoBrush);
                painter.drawRect(picture.adjusted(-1.0, -1.0, 1.0, 1.0));
            }
            painter.setPen(is_current ? colors.teal : colors.dim);
            painter.drawText(
                QRectF(place.left(), place.bottom(), place.width(), 16.0), Qt::AlignCenter,
                QString::number(points_[k].value, 'g', 4) + (unit == "°" ? unit : QString()));
        }
    }
    const QRectF box = chart();
    painter.setPen(QPen(colors.line, 1.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(box);
    double last_label = box.bottom() + label_px;
    for (int decade = static_cast<int>(std::ceil(bottom_)); decade <= std::floor(top_); ++decade) {
        const double y = box.bottom() - (decade - bottom_) / (top_ - bottom_) * box.height();
        painter.setPen(QPen(colors.line, 1.0));
        painter.drawLine(QPointF(box.left(), y), QPointF(box.right(), y));
        if (y > last_label - label_px) {
            continue;
        }
        last_label = y;
        painter.setPen(colors.dim);
        painter.drawText(QRectF(0.0, y - 8.0, left_px - 6.0, 16.0),
                         Qt::AlignRight | Qt::AlignVCenter, significant(std::pow(10.0, decade), 1));
    }
    painter.setPen(colors.dim);
    for (const SweepPoint& point : points_) {
        const double across = high_ > low_ ? (point.value - low_) / (high_ - low_) : 0.5;
        const double x = box.left() + across * box.width();
        painter.drawLine(QPointF(x, box.bottom()), QPointF(x, box.bottom() + 3.0));
    }
    painter.drawText(QRectF(box.left() - 30.0, box.bottom() + 4.0, 60.0, 14.0), Qt::AlignCenter,
                     QString::number(low_, 'g', 4));
    painter.drawText(QRectF(box.right() - 30.0, box.bottom() + 4.0, 60.0, 14.0), Qt::AlignCenter,
                     QString::number(high_, 'g', 4));
    painter.drawText(QRectF(box.left(), box.bottom() + 4.0, box.width(), 14.0), Qt::AlignCenter,
                     QString::fromStdString(name(parameter_)) +
                         (unit.isEmpty() ? QString() : ", " + unit) + QStringLiteral("   (") +
                         title_of(quantity_) + ")");

    double legend = box.top() + 2.0;
    for (const Shown& each : shown_curves()) {
        const GhostCurve& curve = *each.curve;
        const QColor color = ghost_color(curve.path);
        QPainterPath line;
        bool begun = false;
        for (std::size_t k = 0; k < points_.size(); ++k) {
            if (!(curve.values[k] > 0.0)) {
                begun = false;
                continue;
            }
            const QPointF at = curve_place(curve, k);
            begun ? line.lineTo(at) : line.moveTo(at);
            begun = true;
        }
        painter.setPen(QPen(color, each.selected ? 3.0 : 1.5));
        painter.setBrush(Qt::NoBrush);
        painter.drawPath(line);
        painter.setBrush(color);
        painter.setPen(Qt::NoPen);
        painter.drawEllipse(curve_place(curve, curve.worst), 4.0, 4.0);
        if (legend + 16.0 <= height()) {
            painter.fillRect(QRectF(box.right() + 12.0, legend + 3.0, 9.0, 9.0), color);
            painter.setPen(each.selected ? colors.teal : colors.text);
            painter.drawText(QRectF(box.right() + 27.0, legend, legend_px - 30.0, 16.0),
                             Qt::AlignLeft | Qt::AlignVCenter,
                             tr("%1   worst at %2%3")
                                 .arg(QString::fromStdString(name(curve.path, surface_count_)),
                                      QString::number(points_[curve.worst].value, 'g', 4),
                                      unit == "°" ? unit : QString()));
            legend += 17.0;
        }
    }
}

void SweepView::mousePressEvent(QMouseEvent* event) {
    for (std::size_t k = 0; k < points_.size(); ++k) {
        if (!flares_[k].isNull() && flare_place(k).contains(event->position())) {
            Q_EMIT value_chosen(points_[k].value);
            return;
        }
    }
    const GhostPath* nearest = nullptr;
    double least = reach_px;
    for (const Shown& each : shown_curves()) {
        for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
            const QPointF a = curve_place(*each.curve, k), b = curve_place(*each.curve, k + 1);
            const QPointF along = b - a, to = event->position() - a;
            const double length2 = QPointF::dotProduct(along, along);
            const double share =
                length2 > 0.0 ? std::clamp(QPointF::dotProduct(to, along) / length2, 0.0, 1.0)
                              : 0.0;
            const QPointF off = to - share * along;
            const double distance = std::hypot(off.x(), off.y());
            if (distance < least) {
                least = distance;
                nearest = &each.curve->path;
            }
        }
    }
    if (nearest != nullptr) {
        Q_EMIT ghost_chosen(*nearest);
    }
}

void SweepView::choose_curve(int step) {
    const std::vector<Shown> shown = shown_curves();
    if (shown.empty()) {
        return;
    }
    const auto now = std::ranges::find_if(shown, [](const Shown& each) { return each.selected; });
    const auto count = static_cast<int>(shown.size());
    const int from =
        now == shown.end() ? (step > 0 ? -1 : count) : static_cast<int>(now - shown.begin());
    Q_EMIT ghost_chosen(
        shown[static_cast<std::size_t>(std::clamp(from + step, 0, count - 1))].curve->path);
}

void SweepView::keyPressEvent(QKeyEvent* event) {
    const auto go_to = [this](std::size_t point) {
        current_ = point;
        update();
    };
    const bool has_points = !points_.empty();
    switch (event->key()) {
        case Qt::Key_Left:
            go_to(current_ > 0 ? current_ - 1 : 0);
            break;
        case Qt::Key_Right:
            go_to(has_points ? std::min(current_ + 1, points_.size() - 1) : 0);
            break;
        case Qt::Key_Home:
            go_to(0);
            break;
        case Qt::Key_End:
            go_to(has_points ? points_.size() - 1 : 0);
            break;
        case Qt::Key_Up:
            choose_curve(-1);
            break;
        case Qt::Key_Down:
            choose_curve(1);
            break;
        case Qt::Key_Return:
        case Qt::Key_Enter:
        case Qt::Key_Space:
            if (has_points) {
                Q_EMIT value_chosen(points_[current_].value);
            }
            break;
        default:
            QWidget::keyPressEvent(event);
    }
}

void SweepView::focusInEvent(QFocusEvent* event) {
    QWidget::focusInEvent(event);
    update();
}

void SweepView::focusOutEvent(QFocusEvent* event) {
    QWidget::focusOutEvent(event);
    update();
}

}  // namespace ghostlight
