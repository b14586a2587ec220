#pragma once

#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;

namespace ghostlight {

/// Start, pause, cancel and what to do with the result; and why something was not taken.
class FitControls : public QWidget {
    Q_OBJECT
   public:
    explicit FitControls(QWidget* parent = nullptr);

    struct State {
        bool can_start = false, runs = false, is_paused = false, can_apply = false,
             can_save = false;
        QString why_not;  ///< it cannot be started; empty where it can
    };
    void set_state(const State& state);
    void set_share(double share);
    void show_reason(const QString& reason);
    /// Empty where nothing is wrong.
    QString reason() const;
    QPushButton& start() { return *start_; }

   Q_SIGNALS:
    void start_asked();
    void pause_asked();
    void cancel_asked();
    void apply_asked();
    void save_asked();

   private:
    QLabel* reason_;
    QProgressBar* progress_;
    QPushButton *start_ = nullptr, *pause_ = nullptr, *cancel_ = nullptr, *apply_ = nullptr,
                *save_ = nullptr;
};

}  // namespace ghostlight
