#include "widgets/flare_view.h"

#include <QEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "render/flare_renderer.h"
#include "widgets/flare_overlay.h"
#include "widgets/light_marker.h"
#include "widgets/palette.h"
#include "widgets/software_picture.h"

namespace ghostlight {

namespace {

constexpr double ev_per_notch = 1.0 / 3.0;
constexpr double zoom_per_notch = 1.25;
constexpr double most_zoom = 64.0;
constexpr double eighths_per_notch = 120.0;  // as Qt counts the wheel
constexpr double drag_start_px = 3.0;        // less is a click
constexpr double grip_reach_px = 14.0;       // of the light's marker

std::array<float, 3> floats(const QColor& color) {
    return {color.redF(), color.greenF(), color.blueF()};
}

/// A picture is judged against a dark, neutral surround in either theme.
Palette picture_palette() { return dark_palette(); }

double length(QPointF p) { return std::hypot(p.x(), p.y()); }

}  // namespace

FlareView::FlareView(QWidget* parent) : GlView(parent) { setCursor(Qt::CrossCursor); }

FlareView::~FlareView() { close_gl(); }

void FlareView::set_image(std::shared_ptr<const FlareImage> image) {
    image_ = std::move(image);
    upload_pending_ = image_ != nullptr;
    if (image_ == nullptr) waiting_for_ = Waiting::lens;
    software_picture_ = {};
    refresh();
}

void FlareView::set_light(const LightDirection& light, double efl_mm) {
    light_ = light;
    if (waiting_for_ == Waiting::lens) waiting_for_ = Waiting::picture;
    efl_mm_ = std::isfinite(efl_mm) && efl_mm != 0.0 ? efl_mm : 50.0;  // an afocal lens: any scale
    refresh();
}

void FlareView::set_failed() {
    waiting_for_ = Waiting::mending;
    refresh();
}

void FlareView::set_exposure_ev(double exposure_ev) {
    exposure_ev_ = exposure_ev;
    refresh();
}

void FlareView::reset_zoom() {
    zoom_ = {};
    refresh();
}

PictureFrame FlareView::frame() const {
    const double sensor_width = image_ ? image_->sensor_width_mm : 36.0;
    const double sensor_height = image_ ? image_->sensor_height_mm : 24.0;
    return framed(width(), height(), sensor_width, sensor_height, zoom_);
}

void FlareView::init_gl() {
    try {
        renderer_ = std::make_unique<FlareRenderer>();
        upload_ = std::make_unique<PictureUpload>();
        upload_pending_ = image_ != nullptr;
    } catch (const Error& error) {
        fail_gl(QString::fromUtf8(error.what()));
    }
}

void FlareView::release_gl() {
    upload_.reset();
    renderer_.reset();
}

void FlareView::paint_gl(unsigned, int width_px, int height_px) {
    try {
        if (upload_pending_) {
            last_upload_ms_ = upload_->upload(*image_);
            upload_pending_ = false;
        }
        PictureLook look;
        look.exposure_ev = exposure_ev_;
        look.surround = floats(picture_palette().ground);
        look.highlight = floats(picture_palette().teal);
        const double ratio = width_px / std::max(1.0, static_cast<double>(width()));
        renderer_->draw(image_ ? upload_->texture() : PictureTexture{}, frame().scaled(ratio), look,
                        width_px, height_px);
    } catch (const Error& error) {
        fail_gl(QString::fromUtf8(error.what()));
    }
}

void FlareView::paint_without_gl(QPainter& painter) {
    painter.fillRect(rect(), picture_palette().ground);
    if (!image_) {
        paint_overlay(painter);
        return;
    }
    const PictureFrame now = frame();
    const bool same = !software_picture_.isNull() && software_exposure_ev_ == exposure_ev_ &&
                      software_frame_ == now && software_picture_.size() == size();
    if (!same) {
        software_picture_ = software_picture(*image_, now, size(), exposure_ev_,
                                             picture_palette().ground, picture_palette().teal);
        software_exposure_ev_ = exposure_ev_;
        software_frame_ = now;
    }
    painter.drawImage(0, 0, software_picture_);
    painter.setPen(picture_palette().dim);
    painter.drawText(rect().adjusted(8, 6, -8, -6), Qt::AlignLeft | Qt::AlignBottom,
                     tr("drawn without OpenGL: %1").arg(gl_failure()));
    paint_overlay(painter);
}

void FlareView::paint_overlay(QPainter& painter) {
    if (!image_) {
        painter.setPen(picture_palette().dim);
        painter.drawText(
            rect().adjusted(16, 16, -16, -16), Qt::AlignCenter | Qt::TextWordWrap,
            waiting_for_ == Waiting::picture ? tr("Tracing the first picture…")
            : waiting_for_ == Waiting::mending
                ? tr("No flare yet: the lens cannot be traced as it stands.\nIt appears once what "
                     "is wrong is mended.")
                : tr("The flare appears here.\nOpen a lens file, or drop one on the window."));
        return;
    }
    paint_light(painter, frame(), size(), light_, efl_mm_);
    if (cursor_ && (drag_ == Drag::none || drag_ == Drag::pressed)) {
        paint_readout(painter, frame(), size(), *image_, *cursor_);
    }
}

void FlareView::drag_light_to(QPointF position) {
    const QPointF at = position + grip_px_;
    const glm::dvec2 point = frame().sensor_from_view({at.x(), at.y()});
    const LightDirection light = light_at_sensor_mm(point, efl_mm_, light_.azimuth_deg);
    if (light != light_) {
        light_ = light;
        refresh();
        Q_EMIT light_dragged(light);
    }
}

void FlareView::mousePressEvent(QMouseEvent* event) {
    if (!image_ || drag_ != Drag::none) {
        event->ignore();
        return;
    }
    pressed_at_ = last_position_ = event->position();
    if (event->button() == Qt::LeftButton) {
        const glm::dvec2 at = frame().view_from_sensor(light_on_sensor_mm(light_, efl_mm_));
        const QPointF off = QPointF(at.x, at.y) - pressed_at_;
        grip_px_ = length(off) <= grip_reach_px ? off : QPointF();
        drag_ = Drag::pressed;
    } else if (event->button() == Qt::MiddleButton) {
        drag_ = Drag::pan;
    } else {
        event->ignore();
    }
}

void FlareView::mouseMoveEvent(QMouseEvent* event) {
    const QPointF position = event->position();
    cursor_ = position;
    if (drag_ == Drag::pressed && length(position - pressed_at_) >= drag_start_px) {
        drag_ = Drag::light;
    }
    if (drag_ == Drag::light) {
        drag_light_to(position);
    } else if (drag_ == Drag::pan) {
        const PictureFrame now = frame();
        const QPointF moved = position - last_position_;
        zoom_.center_mm.x += moved.x() * now.sensor_width_mm / now.width_px;
        zoom_.center_mm.y -= moved.y() * now.sensor_height_mm / now.height_px;
    }
    last_position_ = position;
    refresh();
}

void FlareView::mouseReleaseEvent(QMouseEvent* event) {
    const bool ends = drag_ == Drag::pan ? event->button() == Qt::MiddleButton
                                         : event->button() == Qt::LeftButton;
    if (!ends) {
        return;
    }
    const bool moved_light = drag_ == Drag::light;
    drag_ = Drag::none;
    refresh();
    if (moved_light) {
        Q_EMIT light_drag_finished();
    }
}

void FlareView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton && image_) {
        Q_EMIT auto_exposure_requested();
    }
}

void FlareView::zoom_about(QPointF position, double factor) {
    const glm::dvec2 fixed = frame().sensor_from_view({position.x(), position.y()});
    zoom_.factor = std::clamp(zoom_.factor * factor, 1.0, most_zoom);
    if (zoom_.factor == 1.0) {
        zoom_.center_mm = {0.0, 0.0};
    } else {
        zoom_.center_mm += fixed - frame().sensor_from_view({position.x(), position.y()});
    }
    refresh();
}

void FlareView::wheelEvent(QWheelEvent* event) {
    const double notches = event->angleDelta().y() / eighths_per_notch;
    if (notches == 0.0 || !image_) {
        event->ignore();
        return;
    }
    if ((event->modifiers() & Qt::ControlModifier) != 0) {
        zoom_about(event->position(), std::pow(zoom_per_notch, notches));
    } else {
        Q_EMIT exposure_requested(exposure_ev_ + notches * ev_per_notch);
    }
    event->accept();
}

void FlareView::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_F && event->modifiers() == Qt::NoModifier) {
        reset_zoom();
    } else {
        GlView::keyPressEvent(event);
    }
}

void FlareView::leaveEvent(QEvent*) {
    cursor_.reset();
    refresh();
}

void FlareView::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange) {
        software_picture_ = {};
        refresh();
    }
    GlView::changeEvent(event);
}

}  // namespace ghostlight
