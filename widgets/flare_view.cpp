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
constexpr double divider_reach_px = 5.0;
constexpr int rest_ms = 120;           // of the cursor, before ghosts are asked for
constexpr float shown_decades = 4.0F;  // in false colours

std::array<float, 3> floats(const QColor& color) {
    return {color.redF(), color.greenF(), color.blueF()};
}

/// A picture is judged against a dark, neutral surround in either theme.
Palette picture_palette() { return dark_palette(); }

double length(QPointF p) { return std::hypot(p.x(), p.y()); }

}  // namespace

FlareView::FlareView(QWidget* parent) : GlView(parent) {
    setCursor(Qt::CrossCursor);
    look_.surround = floats(picture_palette().ground);
    look_.highlight = floats(picture_palette().teal);
    look_.clipping = floats(picture_palette().red_orange);
    rest_.setSingleShot(true);
    rest_.setInterval(rest_ms);
    connect(&rest_, &QTimer::timeout, this, [this] {
        if (cursor_ && drag_ == Drag::none && image_) {
            Q_EMIT rested(frame().sensor_from_view({cursor_->x(), cursor_->y()}));
        }
    });
}

FlareView::~FlareView() { close_gl(); }

void FlareView::set_image(std::shared_ptr<const FlareImage> image) {
    image_ = std::move(image);
    upload_pending_ = image_ != nullptr;
    if (image_ == nullptr) waiting_for_ = Waiting::lens;
    software_picture_ = {};
    fit_decades();
    if (cursor_ && drag_ == Drag::none) rest_.start();  // the ghosts there may be others
    refresh();
}

void FlareView::set_tone(ToneCurve tone) {
    look_.tone = tone;
    refresh();
}

void FlareView::set_mark_clipping(bool marks) {
    look_.mark_clipping = marks;
    refresh();
}

void FlareView::set_false_color(bool on) {
    look_.false_color = on ? std::optional(PictureLook::Decades{}) : std::nullopt;
    upload_pending_ = image_ != nullptr;
    compared_pending_ = compared_ != nullptr;
    fit_decades();
    refresh();
}

void FlareView::fit_decades() {
    if (!look_.false_color || !image_) {
        return;
    }
    float brightest = 0.0F;
    for (const FlareImage* image : {image_.get(), compared_.get()}) {
        if (image != nullptr && !image->irradiance.empty()) {
            brightest = std::max(brightest, *std::ranges::max_element(image->irradiance));
        }
    }
    // Whole decades, so that the scale does not creep while a light moves.
    const float high = brightest > 0.0F ? std::ceil(std::log10(brightest)) : 0.0F;
    look_.false_color = PictureLook::Decades{high - shown_decades, high};
}

void FlareView::set_compared(std::shared_ptr<const FlareImage> image) {
    compared_ = std::move(image);
    compared_pending_ = compared_ != nullptr;
    software_picture_ = {};
    if (!compared_) shows_a_ = false;
    fit_decades();
    refresh();
}

void FlareView::set_split(bool split) {
    split_ = split;
    software_picture_ = {};
    refresh();
}

void FlareView::set_showing_a(bool shows) {
    shows_a_ = shows && compared_;
    software_picture_ = {};
    refresh();
}

void FlareView::set_probe(glm::dvec2 point_mm, std::vector<ReadoutLine> lines) {
    probe_mm_ = point_mm;
    probe_ = std::move(lines);
    refresh();
}

PictureLook FlareView::look_of(double from_share) const {
    PictureLook look = look_;
    look.from_share = from_share;
    return look;
}

void FlareView::upload(PictureUpload& to, const FlareImage& image) const {
    look_.false_color ? to.upload_irradiance(image) : to.upload(image);
}

void FlareView::set_light(const LightDirection& light, double efl_mm) {
    light_ = light;
    if (waiting_for_ == Waiting::lens) waiting_for_ = Waiting::picture;
    efl_mm_ = std::isfinite(efl_mm) && efl_mm != 0.0 ? efl_mm : 50.0;  // an afocal lens: any scale
    refresh();
}

void FlareView::set_other_lights(std::vector<LightDirection> lights) {
    if (lights == other_lights_) return;
    other_lights_ = std::move(lights);
    refresh();
}

void FlareView::set_failed() {
    waiting_for_ = Waiting::mending;
    refresh();
}

void FlareView::set_exposure_ev(double exposure_ev) {
    look_.exposure_ev = exposure_ev;
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
        compared_upload_ = std::make_unique<PictureUpload>();
        upload_pending_ = image_ != nullptr;
        compared_pending_ = compared_ != nullptr;
    } catch (const Error& error) {
        fail_gl(QString::fromUtf8(error.what()));
    }
}

void FlareView::release_gl() {
    upload_.reset();
    compared_upload_.reset();
    renderer_.reset();
}

void FlareView::paint_gl(unsigned, int width_px, int height_px) {
    try {
        if (upload_pending_) {
            last_upload_ms_ =
                look_.false_color ? upload_->upload_irradiance(*image_) : upload_->upload(*image_);
            upload_pending_ = false;
        }
        if (compared_pending_) {
            upload(*compared_upload_, *compared_);
            compared_pending_ = false;
        }
        const PictureFrame place =
            frame().scaled(width_px / std::max(1.0, static_cast<double>(width())));
        const auto draw = [&](const PictureTexture& texture, double from_share) {
            renderer_->draw(texture, place, look_of(from_share), width_px, height_px);
        };
        const bool compares_now = compared_ && image_;
        if (compares_now && (split_ || shows_a_)) {
            draw(compared_upload_->texture(), 0.0);
        }
        if (!shows_a_) {
            draw(image_ ? upload_->texture() : PictureTexture{},
                 compares_now && split_ ? split_share_ : 0.0);
        }
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
    const bool same = !software_picture_.isNull() && software_look_ == look_ &&
                      software_frame_ == now && software_picture_.size() == size();
    if (!same) {
        software_picture_ = software_picture(shows_a_ ? *compared_ : *image_, now, size(), look_);
        if (compared_ && split_ && !shows_a_) {
            const QImage mine = software_picture(*image_, now, size(), look_of(split_share_));
            software_picture_ = software_picture(*compared_, now, size(), look_);
            QPainter over(&software_picture_);
            over.drawImage(0, 0, mine);
        }
        software_look_ = look_;
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
    paint_other_lights(painter, frame(), size(), other_lights_, efl_mm_);
    paint_light(painter, frame(), size(), light_, efl_mm_);
    if (look_.false_color) {
        paint_false_color_scale(painter, size(), *look_.false_color);
    }
    if (compared_) {
        paint_comparison(painter);
    }
    if (cursor_ && (drag_ == Drag::none || drag_ == Drag::pressed)) {
        const glm::dvec2 at = frame().sensor_from_view({cursor_->x(), cursor_->y()});
        const double pixel_mm = image_->sensor_width_mm / std::max(1, image_->width_px);
        const bool is_there = std::hypot(at.x - probe_mm_.x, at.y - probe_mm_.y) < 3.0 * pixel_mm;
        const bool on_a =
            compared_ && (shows_a_ || (split_ && cursor_->x() < split_share_ * width()));
        paint_readout(painter, frame(), size(), on_a ? *compared_ : *image_, *cursor_,
                      is_there && !on_a ? probe_ : std::vector<ReadoutLine>());
    }
}

void FlareView::paint_comparison(QPainter& painter) const {
    const auto label = [&](double x, const QString& text) {
        const QRectF box(x, 10.0, 22.0, 22.0);
        painter.setPen(Qt::NoPen);
        painter.setBrush(QColor(0, 0, 0, 150));
        painter.drawRoundedRect(box, 3.0, 3.0);
        painter.setPen(picture_palette().text);
        painter.drawText(box, Qt::AlignCenter, text);
    };
    if (shows_a_ || !split_) {
        label(width() / 2.0 - 11.0, shows_a_ ? QStringLiteral("A") : QStringLiteral("B"));
        return;
    }
    const double x = split_share_ * width();
    painter.setPen(QPen(QColor(0, 0, 0, 150), 3.0));
    painter.drawLine(QPointF(x, 0.0), QPointF(x, height()));
    painter.setPen(QPen(picture_palette().text, 1.0));
    painter.drawLine(QPointF(x, 0.0), QPointF(x, height()));
    label(x - 28.0, QStringLiteral("A"));
    label(x + 6.0, QStringLiteral("B"));
}

bool FlareView::is_over_divider(QPointF position) const {
    return compared_ && split_ && !shows_a_ &&
           std::abs(position.x() - split_share_ * width()) <= divider_reach_px;
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
        const bool is_on_light = length(off) <= grip_reach_px;
        grip_px_ = is_on_light ? off : QPointF();
        drag_ = !is_on_light && is_over_divider(pressed_at_) ? Drag::divider : Drag::pressed;
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
    setCursor(drag_ == Drag::divider || (drag_ == Drag::none && is_over_divider(position))
                  ? Qt::SplitHCursor
                  : Qt::CrossCursor);
    if (drag_ == Drag::none && image_) rest_.start();
    if (drag_ == Drag::light) {
        drag_light_to(position);
    } else if (drag_ == Drag::divider) {
        split_share_ = std::clamp(position.x() / std::max(1, width()), 0.02, 0.98);
        software_picture_ = {};
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
    const bool clicked = drag_ == Drag::pressed;
    drag_ = Drag::none;
    refresh();
    if (clicked) {
        const QPointF at = event->position();
        Q_EMIT picked(frame().sensor_from_view({at.x(), at.y()}),
                      (event->modifiers() & Qt::ControlModifier) != 0);
    }
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
        Q_EMIT exposure_requested(look_.exposure_ev + notches * ev_per_notch);
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
    probe_.clear();
    rest_.stop();
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
