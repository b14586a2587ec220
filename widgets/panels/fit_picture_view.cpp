#include "widgets/panels/fit_picture_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>
#include <utility>

#include "widgets/palette.h"

namespace ghostlight {

namespace {

/// Slow enough to compare, fast enough to see what jumps.
constexpr int blink_ms = 600;
constexpr double light_radius_px = 9.0;
/// Of the screen: what is smaller was a click, not a box; points closer than that are one.
constexpr double least_box_px = 4.0, least_step_px = 2.0;
const QColor quiet_on_black(0xb0, 0xb5, 0xbd);  // in either theme

/// A tenth of a pixel is enough to paint by, and keeps the lens's file short.
FilePoint rounded(const FilePoint& point) {
    return {std::round(10.0 * point.x_px) / 10.0, std::round(10.0 * point.y_px) / 10.0};
}

FileBox box_of(const FilePoint& a, const FilePoint& b) {
    const auto [left, right] = std::minmax(a.x_px, b.x_px);
    const auto [top, bottom] = std::minmax(a.y_px, b.y_px);
    return {left, top, right - left, bottom - top};
}

MaskRegion region_of(const FileBox& box) {
    const double right = box.left_px + box.width_px, bottom = box.top_px + box.height_px;
    return {.points = {{box.left_px, box.top_px},
                       {right, box.top_px},
                       {right, bottom},
                       {box.left_px, bottom}},
            .brush_px = 0.0};
}

QPainterPath path_of(const MaskRegion& region) {
    QPolygonF points;
    for (const FilePoint& each : region.points) {
        points << QPointF(each.x_px, each.y_px);
    }
    QPainterPath path;
    path.setFillRule(Qt::OddEvenFill);
    if (region.brush_px > 0.0) {
        QPainterPath way(points.value(0));
        for (const QPointF& each : points) {
            way.lineTo(each);
        }
        // A dot has no way: a hair's length gives it one.
        way.lineTo(points.value(points.size() - 1) + QPointF(1e-3, 0.0));
        QPainterPathStroker brush;
        brush.setWidth(region.brush_px);
        brush.setCapStyle(Qt::RoundCap);
        brush.setJoinStyle(Qt::RoundJoin);
        path = brush.createStroke(way);
        path.setFillRule(Qt::WindingFill);
    } else {
        path.addPolygon(points);
        path.closeSubpath();
    }
    return path;
}

QString tip_of(FitPictureView::Tool tool) {
    switch (tool) {
        case FitPictureView::Tool::light:
            return FitPictureView::tr("Click where the light is");
        case FitPictureView::Tool::box:
            return FitPictureView::tr("Drag over what is not to count");
        case FitPictureView::Tool::lasso:
            return FitPictureView::tr("Draw around what is not to count");
        case FitPictureView::Tool::brush:
            return FitPictureView::tr("Paint over what is not to count");
        case FitPictureView::Tool::erase:
            return FitPictureView::tr("Click a painted region to take it away");
        case FitPictureView::Tool::crop:
            return FitPictureView::tr("Drag over what is to count; a click: all");
    }
    return {};
}

}  // namespace

FitPictureView::FitPictureView(QWidget* parent) : QWidget(parent) {
    setObjectName("fit_picture");
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setMouseTracking(true);
    setFocusPolicy(Qt::ClickFocus);
    set_tool(Tool::light);
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

void FitPictureView::set_photograph(Photograph photograph) {
    photograph_ = std::move(photograph);
    under_mouse_.reset();
    update();
}

void FitPictureView::set_mode(Mode mode) {
    mode_ = mode;
    shows_model_ = false;
    mode == Mode::blink ? blink_.start() : blink_.stop();
    update();
}

void FitPictureView::set_tool(Tool tool) {
    tool_ = tool;
    forget_drawing();
    setToolTip(tip_of(tool));
    setCursor(tool == Tool::erase ? Qt::ArrowCursor : Qt::CrossCursor);
}

void FitPictureView::show_mask(bool shown) {
    mask_is_shown_ = shown;
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

void FitPictureView::forget_drawing() {
    drawn_.clear();
    under_mouse_.reset();
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

bool FitPictureView::is_on_sensor() const {
    return mode_ != Mode::photograph && !pictures_.measured.isNull();
}

QRectF FitPictureView::picture_rect() const {
    const QSize of = is_on_sensor()                  ? pictures_.measured.size()
                     : pictures_.photograph.isNull() ? shown().size()
                                                     : pictures_.photograph.size();
    if (of.isEmpty()) {
        return {};
    }
    const QSizeF size = QSizeF(of).scaled(QSizeF(this->size()), Qt::KeepAspectRatio);
    return {QPointF(0.5 * (width() - size.width()), 0.5 * (height() - size.height())), size};
}

QTransform FitPictureView::file_to_screen() const {
    const QRectF at = picture_rect();
    const QSize file = photograph_.size_px;
    QTransform map =
        QTransform::fromScale(1.0 / std::max(1, file.width()), 1.0 / std::max(1, file.height()));
    if (is_on_sensor()) {
        map *= photograph_.to_sensor;
    }
    return map * QTransform::fromScale(at.width(), at.height()) *
           QTransform::fromTranslate(at.left(), at.top());
}

QPointF FitPictureView::on_screen(const FilePoint& point) const {
    return file_to_screen().map(QPointF(point.x_px, point.y_px));
}

std::optional<FilePoint> FitPictureView::file_at(const QPointF& screen) const {
    if (photograph_.size_px.isEmpty() || picture_rect().isEmpty()) {
        return std::nullopt;
    }
    const QPointF at = file_to_screen().inverted().map(screen);
    return FilePoint{at.x(), at.y()};
}

std::optional<std::size_t> FitPictureView::region_at(const QPointF& screen) const {
    const auto point = file_at(screen);
    for (std::size_t k = photograph_.masked.size(); point && k-- > 0;) {
        if (covers(photograph_.masked[k], *point)) {
            return k;
        }
    }
    return std::nullopt;
}

void FitPictureView::paint_regions(QPainter& painter) const {
    const Palette colors = dark_palette();  // pictures are dark in either theme
    const QTransform map = file_to_screen();
    painter.setRenderHint(QPainter::Antialiasing);
    QColor fill = colors.amber;
    fill.setAlpha(70);
    for (std::size_t k = 0; k < photograph_.masked.size(); ++k) {
        const bool marked = under_mouse_ == k;
        painter.setPen(QPen(marked ? colors.red_orange : colors.amber, marked ? 2.0 : 1.0));
        painter.setBrush(fill);
        painter.drawPath(map.map(path_of(photograph_.masked[k])));
    }
    painter.setBrush(Qt::NoBrush);
    if (photograph_.crop) {
        painter.setPen(QPen(colors.amber, 1.0, Qt::DashLine));
        painter.drawPath(map.map(path_of(region_of(*photograph_.crop))));
    }
    if (drawn_.empty()) {
        return;
    }
    painter.setPen(QPen(colors.amber, 1.5, tool_ == Tool::crop ? Qt::DashLine : Qt::SolidLine));
    if (tool_ == Tool::box || tool_ == Tool::crop) {
        painter.drawPath(map.map(path_of(region_of(box_of(drawn_.front(), drawn_.back())))));
    } else {
        if (tool_ == Tool::brush) {
            painter.setBrush(fill);
        }
        painter.drawPath(map.map(
            path_of({.points = drawn_, .brush_px = tool_ == Tool::brush ? brush_px_ : 0.0})));
        painter.setBrush(Qt::NoBrush);
    }
}

void FitPictureView::paint_light(QPainter& painter) const {
    const QSize file = photograph_.size_px;
    const QPointF center = on_screen({light_->x() * file.width(), light_->y() * file.height()});
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(dark_palette().teal, 1.5));
    painter.drawEllipse(center, light_radius_px, light_radius_px);
    painter.drawLine(center - QPointF(light_radius_px + 5, 0), center - QPointF(4, 0));
    painter.drawLine(center + QPointF(4, 0), center + QPointF(light_radius_px + 5, 0));
    painter.drawLine(center - QPointF(0, light_radius_px + 5), center - QPointF(0, 4));
    painter.drawLine(center + QPointF(0, 4), center + QPointF(0, light_radius_px + 5));
}

void FitPictureView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), Qt::black);
    const QRectF at = picture_rect();
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const QImage& picture = shown();
    if (picture.isNull()) {
        painter.setPen(quiet_on_black);
        painter.drawText(
            rect().adjusted(16, 8, -16, -8), Qt::AlignCenter | Qt::TextWordWrap,
            !text_.isEmpty() ? text_ : tr("The model's picture comes with the fit's first step."));
        return;
    }
    painter.drawImage(at, picture);
    if (mode_ == Mode::overlay && !pictures_.model.isNull()) {
        painter.setOpacity(0.5);
        painter.drawImage(at, pictures_.model);
        painter.setOpacity(1.0);
    }
    if (mode_ == Mode::photograph && mask_is_shown_ && !pictures_.mask.isNull()) {
        painter.drawImage(at, pictures_.mask);
    }
    if (mode_ == Mode::blink) {
        painter.setPen(quiet_on_black);
        painter.drawText(at.adjusted(8, 6, -8, -6), Qt::AlignTop | Qt::AlignLeft,
                         shows_model_ ? tr("model") : tr("photograph"));
    }
    painter.setClipRect(at.adjusted(-1, -1, 1, 1));
    paint_regions(painter);
    if (light_) {
        paint_light(painter);
    }
}

void FitPictureView::mousePressEvent(QMouseEvent* event) {
    const auto point = file_at(event->position());
    if (event->button() != Qt::LeftButton || !point ||
        !picture_rect().contains(event->position())) {
        QWidget::mousePressEvent(event);
        return;
    }
    if (tool_ == Tool::light) {
        Q_EMIT clicked({point->x_px / photograph_.size_px.width(),
                        point->y_px / photograph_.size_px.height()});
    } else if (tool_ == Tool::erase) {
        if (const auto index = region_at(event->position())) {
            Q_EMIT region_erased(*index);
        }
    } else {
        drawn_ = {rounded(*point)};
        update();
    }
}

void FitPictureView::mouseMoveEvent(QMouseEvent* event) {
    if (tool_ == Tool::erase) {
        const auto index = region_at(event->position());
        if (index != std::exchange(under_mouse_, index)) {
            update();
        }
        return;
    }
    const auto point = file_at(event->position());
    if (drawn_.empty() || !point) {
        return;
    }
    if (tool_ == Tool::box || tool_ == Tool::crop) {
        drawn_.resize(1);
        drawn_.push_back(rounded(*point));
    } else if (QLineF(on_screen(drawn_.back()), event->position()).length() >= least_step_px) {
        drawn_.push_back(rounded(*point));
    }
    update();
}

void FitPictureView::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || drawn_.empty()) {
        QWidget::mouseReleaseEvent(event);
        return;
    }
    const std::vector<FilePoint> drawn = std::exchange(drawn_, {});
    update();
    const QPointF extent = on_screen(drawn.back()) - on_screen(drawn.front());
    const bool is_box =
        std::abs(extent.x()) >= least_box_px && std::abs(extent.y()) >= least_box_px;
    const FileBox box = box_of(drawn.front(), drawn.back());
    if (tool_ == Tool::crop) {
        Q_EMIT crop_drawn(is_box ? box : FileBox{});
    } else if (tool_ == Tool::brush) {
        Q_EMIT region_drawn({.points = drawn, .brush_px = brush_px_});
    } else if (tool_ == Tool::box ? is_box : drawn.size() >= 3) {
        Q_EMIT region_drawn(tool_ == Tool::box ? region_of(box)
                                               : MaskRegion{.points = drawn, .brush_px = 0.0});
    }
}

void FitPictureView::leaveEvent(QEvent* event) {
    if (under_mouse_.has_value()) {
        under_mouse_.reset();
        update();
    }
    QWidget::leaveEvent(event);
}

void FitPictureView::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && !drawn_.empty()) {
        forget_drawing();
        return;
    }
    QWidget::keyPressEvent(event);
}

}  // namespace ghostlight
