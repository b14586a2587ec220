#include "widgets/panels/mouse_stroke.h"

#include <QMouseEvent>

namespace ghostlight {

const QMouseEvent* mouse_stroke(const QEvent* event) {
    switch (event->type()) {
        case QEvent::MouseButtonPress:
        case QEvent::MouseMove:
        case QEvent::MouseButtonRelease:
            return static_cast<const QMouseEvent*>(event);
        default:
            return nullptr;
    }
}

}  // namespace ghostlight
