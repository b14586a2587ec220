#pragma once

#include <QFont>

#include <functional>

class QTableView;
class QWidget;

namespace ghostlight {

/// How large letters are against the usual size (View ▸ Larger Text), by the application's font.
double text_scale();

/// A length in pixels that has to hold text, at the present size of letters: never below
/// `usual_px`.
int with_text(int usual_px);

/// The font of labels within pictures, a sixth smaller than the application's.
QFont small_font();

/// Calls `fit` now and whenever the size of letters changes, as long as the widget lives.
void follow_text_scale(QWidget& widget, std::function<void()> fit);

/// A widget of one line: `usual_px` high, and higher with larger letters. The same for its width.
void set_line_height(QWidget& widget, int usual_px);
void set_line_width(QWidget& widget, int usual_px);

}  // namespace ghostlight
