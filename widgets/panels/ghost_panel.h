#pragma once

#include <QWidget>

#include <memory>

#include "core/ghosts/ghost_table.h"

class QLabel;
class QStackedWidget;
class QTableView;

namespace ghostlight {

class Actions;
class EmptyState;
class GhostFilter;
class GhostTableModel;
class PanelHeader;
class Selection;

/// The ghost table: sorted and filtered as the reader likes, its selected rows are the selected
/// ghosts of all views.
class GhostPanel : public QWidget {
    Q_OBJECT
   public:
    GhostPanel(Selection& selection, const Actions& actions, QWidget* parent = nullptr);
    ~GhostPanel() override;

    GhostTableModel& model() { return *model_; }
    QTableView& table() { return *table_; }

    void set_table(std::shared_ptr<const GhostTable> table);
    /// A newer table is on its way; `share` of it is done.
    void set_refining(double share);
    void set_failed();
    void clear();
    void copy_rows() const;

   private:
    void connect_actions(const Actions& actions);
    void set_threshold(double share);
    void select_from_views();
    void select_in_table();
    void show_state();
    bool is_refining() const;

    Selection& selection_;
    const Actions& actions_;
    GhostTableModel* model_;
    GhostFilter* filter_;
    PanelHeader* header_;
    QTableView* table_;
    EmptyState* empty_;
    EmptyState* working_;  ///< until a lens's first table is there
    EmptyState* cannot_;   ///< while a lens cannot be traced, and none could before it
    bool is_working_ = false;
    QStackedWidget* pages_;
    double progress_ = 0.0;
    bool failed_ = false;
    bool selecting_ = false;
};

}  // namespace ghostlight
