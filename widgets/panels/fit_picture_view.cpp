#include "widgets/panels/fit_picture_view.h"

#include <QMouseEvent>
#include <QPainter>

#include <utility>

#include "widgets/palette.h"

namespace ghostlight {

namespace {

/// Slow enough to compare, fast enough to see what jumps.
constexpr int blink_ms = 600;
constexpr double light_radius_px = 9.0;

}  // namespace

FitPictureView::FitPictureView(QWidget* parent) : QWidget(parent) {
    setObjectName("fit_picture");
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setToolTip("Click where the light is");
    blink_.setInterval(blink_ms);
    connect(&blink_, &QTimer::timeout, this, [this] {
        shows_model_ = !shows_model_;
        update();
    });
}

void FitPictureView::set_pictures(Pictures pictures) {
    pictures_ = std::move(pictures);
    update();
}

void FitPictureView::set_mode(Mode mode) {
    mode_ = mode;
    shows_model_ = false;
    mode == Mode::blink ? blink_.start() : blink_.stop();
    update();
}

void FitPictureView::set_light(std::optional<QPointF> share) {
    light_ = share;
    update();
}

void FitPictureView::set_text(const QString& text) {
    text_ = text;
    update();
}

const QImage& FitPictureView::shown() const {
    const QImage& photograph =
        pictures_.measured.isNull() ? pictures_.photograph : pictures_.measured;
    switch (mode_) {
        case Mode::model:
            return pictures_.model;
        case Mode::difference:
            return pictures_.difference;
        case Mode::blink:
            return shows_model_ ? pictures_.model : photograph;
        case Mode::overlay:
            return photograph;
        case Mode::photograph:
            break;
    }
    return pictures_.photograph;
}

QRectF FitPictureView::picture_rect() const {
    const QSize of = pictures_.photograph.isNull() ? shown().size() : pictures_.photograph.size();
    if (of.isEmpty()) {
        return {};
    }
    const QSizeF size = QSizeF(of).scaled(QSizeF(this->size()), Qt::KeepAspectRatio);
    return {QPointF(0.5 * (width() - size.width()), 0.5 * (height() - size.height())), size};
}

void FitPictureView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), Qt::black);
    const Palette& colors = current_palette();
    const QRectF at = picture_rect();
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const QImage& picture = shown();
    const auto say = [&](const QString& text) {
        painter.setPen(QColor(0xb0, 0xb5, 0xbd));  // on black in either theme
        painter.drawText(rect().adjusted(16, 8, -16, -8), Qt::AlignCenter | Qt::TextWordWrap, text);
    };
    if (picture.isNull()) {
        say(!text_.isEmpty() ? text_ : tr("The model's picture comes with the fit's first step."));
    } else {
        painter.drawImage(at, picture);
        if (mode_ == Mode::overlay && !pictures_.model.isNull()) {
            painter.setOpacity(0.5);
            painter.drawImage(at, pictures_.model);
            painter.setOpacity(1.0);
        }
        if (mode_ == Mode::blink) {
            painter.setPen(QColor(0xb0, 0xb5, 0xbd));
            painter.drawText(at.adjusted(8, 6, -8, -6), Qt::AlignTop | Qt::AlignLeft,
                             shows_model_ ? tr("model") : tr("photograph"));
        }
    }
    if (light_ && !picture.isNull()) {
        const QPointF center(at.left() + light_->x() * at.width(),
                             at.top() + light_->y() * at.height());
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(QPen(colors.teal, 1.5));
        painter.drawEllipse(center, light_radius_px, light_radius_px);
        painter.drawLine(center - QPointF(light_radius_px + 5, 0), center - QPointF(4, 0));
        painter.drawLine(center + QPointF(4, 0), center + QPointF(light_radius_px + 5, 0));
        painter.drawLine(center - QPointF(0, light_radius_px + 5), center - QPointF(0, 4));
        painter.drawLine(center + QPointF(0, 4), center + QPointF(0, light_radius_px + 5));
    }
}

void FitPictureView::mousePressEvent(QMouseEvent* event) {
    const QRectF at = picture_rect();
    if (event->button() != Qt::LeftButton || !at.contains(event->position())) {
        QWidget::mousePressEvent(event);
        return;
    }
    Q_EMIT clicked({(event->position().x() - at.left()) / at.width(),
                    (event->position().y() - at.top()) / at.height()});
}

}  // namespace ghostlight
