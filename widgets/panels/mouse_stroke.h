#pragma once

class QEvent;
class QMouseEvent;

namespace ghostlight {

/// The event as a press, a move or a release of the mouse; null for any other.
const QMouseEvent* mouse_stroke(const QEvent* event);

}  // namespace ghostlight
