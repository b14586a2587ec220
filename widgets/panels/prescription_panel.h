#pragma once

#include <QWidget>

class QLabel;
class QMenu;
class QModelIndex;
class QStackedWidget;
class QTableView;

namespace ghostlight {

class Actions;
class Document;
class EmptyState;
class PanelHeader;
class PrescriptionModel;

/// The surfaces as a table that can be typed into.
class PrescriptionPanel : public QWidget {
    Q_OBJECT
   public:
    PrescriptionPanel(Document& document, const Actions& actions, QWidget* parent = nullptr);

    PrescriptionModel& model() { return *model_; }
    QTableView& table() { return *table_; }
    /// Marks the surface that is pointed at elsewhere; 0 for none.
    void set_hovered_row(int row);
    QString reason() const;
    /// The surface in that row, from 0, is the one in hand.
    void select_surface(int row);
    /// Opens the editor of the first glass that nobody knows; false if there is none.
    bool mend_glass();

   private:
    void connect_actions(const Actions& actions);
    void show_menu(const QPoint& position, const Actions& actions);
    void add_offers(QMenu& menu, const QModelIndex& index);
    void follow_document();
    void show_columns();
    void show_reason(const QString& reason);
    int current_row() const;
    void go_to(int row);

    Document& document_;
    PrescriptionModel* model_;
    PanelHeader* header_;
    QTableView* table_;
    QLabel* reason_ = nullptr;
    QStackedWidget* pages_;
    int kept_row_ = -1;  ///< while the rows are replaced
};

}  // namespace ghostlight
