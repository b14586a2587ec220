#pragma once

class QString;
class QToolButton;

namespace ghostlight {

/// A button that looks like text until the mouse is over it.
QToolButton* quiet_button(const QString& text, const QString& tip, bool checkable);

}  // namespace ghostlight
