#pragma once

#include <QWidget>

#include <memory>

#include "core/ghosts/ghost_table.h"

class QFrame;
class QLabel;
class QLineEdit;
class QStackedWidget;
class QTableView;
class QTreeView;
class QToolButton;

namespace ghostlight {

class Actions;
class EmptyState;
class GhostFilter;
class GhostMatrix;
class GhostTableModel;
class PanelHeader;
class Selection;
class SurfaceSumsModel;

/// The ghosts as a table, as a matrix of surfaces, or summed by surface. What is selected here is
/// selected in all views; a line of words says which ghosts are listed.
class GhostPanel : public QWidget {
    Q_OBJECT
   public:
    GhostPanel(Selection& selection, const Actions& actions, QWidget* parent = nullptr);
    ~GhostPanel() override;

    GhostTableModel& model() { return *model_; }
    QTableView& table() { return *table_; }
    GhostMatrix& matrix() { return *matrix_; }
    QTreeView& surfaces() { return *surfaces_; }
    QLineEdit& filter_line() { return *words_; }
    /// What is wrong with the filter's words; empty if nothing is.
    QString filter_problem() const;
    /// The table of the pinned lens, whose columns come with it; null ends the comparison.
    void set_before(std::shared_ptr<const GhostTable> before);

    void set_table(std::shared_ptr<const GhostTable> table);
    /// A newer table is on its way; `share` of it is done.
    void set_refining(double share);
    void set_failed();
    /// Whether dirt lies on the stop, which the table does not have.
    void set_stop_is_dirty(bool dirty);
    void clear();
    void copy_rows() const;

   Q_SIGNALS:
    /// Row from 0 whose coating somebody wants to look at.
    void surface_chosen(int row);

   protected:
    void resizeEvent(QResizeEvent* event) override;

   private:
    enum class Look { table, matrix, surfaces };
    // What is above the ghosts: ghost_panel_strip.cpp.
    void build_strip();
    /// In one line where there is room, else in two.
    void fit_strip();
    void connect_actions(const Actions& actions);
    void set_look(Look look);
    void read_filter();
    void show_columns();
    void choose_columns();
    void set_threshold(double share);
    void select_from_views();
    void select_from_groups();
    void select_in_groups();
    void select_in_table();
    void show_state();
    bool is_refining() const;

    Selection& selection_;
    const Actions& actions_;
    GhostTableModel* model_;
    GhostFilter* filter_;
    PanelHeader* header_;
    QTableView* table_;
    GhostMatrix* matrix_;
    SurfaceSumsModel* sums_;
    QTreeView* surfaces_;
    QFrame* strip_ = nullptr;
    QFrame* words_frame_ = nullptr;
    QLineEdit* words_ = nullptr;
    QToolButton* columns_ = nullptr;
    QLabel* problem_ = nullptr;
    Look look_ = Look::table;
    EmptyState* empty_;
    EmptyState* working_;  ///< until a lens's first table is there
    EmptyState* cannot_;   ///< while a lens cannot be traced, and none could before it
    bool is_working_ = false;
    QStackedWidget* pages_;
    double progress_ = 0.0;
    bool failed_ = false;
    bool stop_is_dirty_ = false;
    bool selecting_ = false;
    bool in_groups_ = false;  ///< what is chosen was chosen there
};

}  // namespace ghostlight
