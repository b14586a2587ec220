#include "widgets/panels/scrub.h"

#include <QApplication>
#include <QMouseEvent>
#include <QWidget>

#include <cstdlib>

#include "widgets/panels/mouse_stroke.h"

namespace ghostlight {

Scrub::Scrub(QWidget& on, Qt::MouseButton button) : QObject(&on), button_(button) {
    on.installEventFilter(this);
}

bool Scrub::eventFilter(QObject* watched, QEvent* event) {
    constexpr double slow = 0.1;
    const QMouseEvent* mouse = mouse_stroke(event);
    if (mouse == nullptr) {
        return QObject::eventFilter(watched, event);
    }
    const auto type = event->type();
    const QPoint at = mouse->position().toPoint();
    if (type == QEvent::MouseButtonPress && mouse->button() == button_) {
        pressed_ = true;
        from_ = last_ = at;
        moved_px_ = 0.0;
        return true;
    }
    if (type == QEvent::MouseMove && pressed_) {
        if (!dragging_ && std::abs(at.x() - from_.x()) >= QApplication::startDragDistance()) {
            dragging_ = true;
            last_ = at;  // the slack does not count
            Q_EMIT begun(from_);
        }
        if (dragging_) {
            const bool fine = mouse->modifiers() & Qt::ShiftModifier;
            moved_px_ += (at.x() - last_.x()) * (fine ? slow : 1.0);
            last_ = at;
            Q_EMIT moved(moved_px_);
        }
        return true;
    }
    if (type == QEvent::MouseButtonRelease && mouse->button() == button_ && pressed_) {
        pressed_ = false;
        if (dragging_) {
            dragging_ = false;
            Q_EMIT ended();
        }
        return true;
    }
    return QObject::eventFilter(watched, event);
}

}  // namespace ghostlight
