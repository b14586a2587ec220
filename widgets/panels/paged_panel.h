#pragma once

#include <QWidget>

class QStackedWidget;

namespace ghostlight {

class Actions;
class PanelHeader;

/// A panel with its header on top and its content below it, or, while no lens is open, what would
/// be there.
class PagedPanel : public QWidget {
    Q_OBJECT
   public:
    PagedPanel(const QString& title, const QString& what_is_here, const Actions& actions,
               QWidget* parent = nullptr);
    /// What the header says on the right.
    QString state() const;

   protected:
    void set_content(QWidget* content);
    void show_content(bool is_there);
    PanelHeader& header() { return *header_; }

   private:
    PanelHeader* header_;
    QStackedWidget* pages_;
};

}  // namespace ghostlight
