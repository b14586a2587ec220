#pragma once

#include <QFont>
#include <QString>
#include <QWidget>

class QPainter;
class QRect;

namespace ghostlight {

/// Text with all digits of one width, so that columns line up and changing numbers do not jump.
/// (The font has such figures, but this Qt cannot ask for them.)
int tabular_width(const QFont& font, const QString& text);

/// Draws one line in the painter's font and pen, elided if it does not fit. `alignment` is
/// horizontal; the line is centred vertically.
void draw_tabular(QPainter& painter, const QRect& rect, Qt::Alignment alignment,
                  const QString& text);

/// A one-line label with tabular figures, cut off with an ellipsis where it must be narrower than
/// its text. Text between '*' is in the text colour, the rest dim.
class TabularLabel : public QWidget {
   public:
    explicit TabularLabel(QWidget* parent = nullptr);
    void set_text(const QString& text);
    QString text() const { return text_; }
    void set_warning(bool warning);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

   protected:
    void paintEvent(QPaintEvent* event) override;

   private:
    QString text_;
    bool warning_ = false;
};

}  // namespace ghostlight
