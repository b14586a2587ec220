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
class NumberHandle;
class PanelHeader;
class PrescriptionModel;
class ScaleStrip;

/// The surfaces as a table that can be typed into.
class PrescriptionPanel : public QWidget {
    Q_OBJECT
   public:
    PrescriptionPanel(Document& document, const Actions& actions, QWidget* parent = nullptr);

    PrescriptionModel& model() { return *model_; }
    QTableView& table() { return *table_; }
    NumberHandle& handle() { return *handle_; }
    ScaleStrip& scale_strip() { return *scale_; }
    /// Marks the surface that is pointed at elsewhere; 0 for none.
    void set_hovered_row(int row);
    QString reason() const;
    /// The surface in that row, from 0, is the one in hand.
    void select_surface(int row);
    /// Opens the editor of the first glass that nobody knows; false if there is none.
    bool mend_glass();
    int current_row() const;

   Q_SIGNALS:
    /// Another surface is the one in hand, from 0; −1 for none.
    void row_chosen(int row);

   private:
    void connect_actions(const Actions& actions);
    /// What is done to cells rather than to rows: prescription_panel_cells.cpp.
    void connect_cells(const Actions& actions);
    void connect_handle();
    void copy_cells();
    void paste_cells();
    void vary_cells();
    void size_automatically();
    void show_menu(const QPoint& position, const Actions& actions);
    void add_offers(QMenu& menu, const QModelIndex& index);
    void follow_document();
    void show_columns();
    void show_reason(const QString& reason);
    void go_to(int row);

    Document& document_;
    PrescriptionModel* model_;
    PanelHeader* header_;
    QTableView* table_;
    QLabel* reason_ = nullptr;
    NumberHandle* handle_;
    ScaleStrip* scale_;
    QStackedWidget* pages_;
    int kept_row_ = -1;  ///< while the rows are replaced
};

}  // namespace ghostlight
