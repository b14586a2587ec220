#pragma once

#include <QWidget>

class QLabel;
class QPushButton;

namespace ghostlight {

/// In place of a panel's content: what would be there, and the one action that puts it there.
class EmptyState : public QWidget {
    Q_OBJECT
   public:
    EmptyState(const QString& what, const QString& action_text, QWidget* parent = nullptr);
    void set_what(const QString& what);

   Q_SIGNALS:
    void action_triggered();

   private:
    QLabel* what_;
};

}  // namespace ghostlight
