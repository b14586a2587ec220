#pragma once

#include <QWidget>

class QTextBrowser;

namespace ghostlight {

/// The user guide and its neighbours, read from the installed Markdown, without a network.
class HelpWindow : public QWidget {
    Q_OBJECT
   public:
    explicit HelpWindow(QWidget* parent = nullptr);

    /// The user guide at the heading about a panel of this title; an empty one means its beginning.
    /// False if the guide is not installed.
    bool show_guide(const QString& panel_title = {});
    /// A page made by the program.
    void show_page(const QString& title, const QString& html);

    QTextBrowser& browser() { return *browser_; }
    /// The heading at the top of what is seen.
    QString heading_in_view() const;

   private:
    class Browser;
    void go_to_heading(const QString& heading, int tries);
    void come();

    Browser* pages_;
    QTextBrowser* browser_;
    bool shows_page_ = false;  ///< made by the program, over the guide
};

}  // namespace ghostlight
