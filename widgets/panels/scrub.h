#pragma once

#include <QObject>
#include <QPoint>

class QWidget;

namespace ghostlight {

/// Turns a sideways drag over a widget into a number's change: with Shift a tenth as fast. A press
/// that does not move stays a click.
class Scrub : public QObject {
    Q_OBJECT
   public:
    Scrub(QWidget& on, Qt::MouseButton button);
    bool is_dragging() const { return dragging_; }

   Q_SIGNALS:
    /// Where the button went down, in the widget.
    void begun(const QPoint& at);
    /// Pixels to the right since then.
    void moved(double px);
    void ended();

   protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

   private:
    Qt::MouseButton button_;
    bool pressed_ = false;
    bool dragging_ = false;
    QPoint from_;
    QPoint last_;
    double moved_px_ = 0.0;
};

}  // namespace ghostlight
