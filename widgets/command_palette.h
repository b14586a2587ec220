#pragma once

#include <QDialog>
#include <QList>
#include <QPointer>

class QAction;
class QLineEdit;
class QListWidget;
class QMenu;
class QMenuBar;

namespace ghostlight {

/// One thing that the window can do, and where in the menus it is.
struct Command {
    QPointer<QAction> action;
    QString text;  ///< "View ▸ Restore Panels"
    QString keys;
    QString tip;

    /// The tip without the key at its end.
    QString plain_tip() const;
};

enum class Include { enabled, disabled };

/// Everything below a menu bar, submenus that are filled when they open too, and what else of the
/// window's own actions has a text; those that cannot be done now if they are to be included.
QList<Command> all_commands(QMenuBar& bar, const QList<QAction*>& others,
                            Include include = Include::enabled);

/// A line to type in and the commands that answer to it, the best first. Return does the chosen
/// one, Escape none.
class CommandPalette : public QDialog {
    Q_OBJECT
   public:
    explicit CommandPalette(QList<Command> commands, QWidget* parent = nullptr);

    QLineEdit& line() { return *line_; }
    QListWidget& list() { return *list_; }

   protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

   private:
    void show_matches(const QString& typed);
    void run_chosen();

    QList<Command> commands_;
    QLineEdit* line_;
    QListWidget* list_;
};

}  // namespace ghostlight
