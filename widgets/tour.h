#pragma once

#include <QFrame>
#include <QPointer>
#include <QString>

#include <vector>

class QLabel;
class QPushButton;

namespace ghostlight {

/// One stop of the tour: where it points and what it says.
struct TourStep {
    QPointer<QWidget> target;
    QString title, text;
};

/// A card beside one part of the window after another, which it frames. The window stays in use
/// meanwhile: nothing waits for the tour.
class Tour : public QFrame {
    Q_OBJECT
   public:
    Tour(std::vector<TourStep> steps, QWidget* window);
    ~Tour() override;

    /// From its first step.
    void begin();
    void end();
    int step() const { return step_; }
    void go_to(int step);

   Q_SIGNALS:
    void ended();
    /// Comes before a step is shown, so that its target can be brought up.
    void step_begins(QWidget* target);

   protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

   private:
    void place();

    std::vector<TourStep> steps_;
    int step_ = 0;
    QWidget* outline_;  ///< around the target
    QLabel* title_;
    QLabel* text_;
    QLabel* count_;
    QPushButton* back_;
    QPushButton* next_;
};

}  // namespace ghostlight
