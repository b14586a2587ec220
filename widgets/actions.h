#pragma once

#include <QAction>
#include <QKeySequence>
#include <QMap>
#include <QObject>
#include <QString>

#include <functional>
#include <span>

class QMenu;
class QMenuBar;

namespace ghostlight {

/// One thing the program can do: its id, its text, its key, and what it does, in one sentence.
struct ActionText {
    const char* id;
    const char* text;
    const char* keys;
    const char* tip;
    bool checkable = false;
};

/// All of them, in the order of the menus.
std::span<const ActionText> action_texts();

/// The actions of one window. Menus, keys and tests reach them by id ("file.open").
class Actions : public QObject {
    Q_OBJECT
   public:
    explicit Actions(QWidget* window);

    /// Unknown ids are a programmer's mistake.
    QAction& operator[](const QString& id) const;
    void on(const QString& id, std::function<void()> run);
    /// A menu of actions by id; "-" is a separator.
    QMenu* add_menu(QMenuBar& bar, const QString& title, const QStringList& ids) const;
    void fill(QMenu& menu, const QStringList& ids) const;

   private:
    QMap<QString, QAction*> actions_;
};

}  // namespace ghostlight
