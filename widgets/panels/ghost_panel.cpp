#include "widgets/panels/ghost_panel.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QMenu>
#include <QSortFilterProxyModel>
#include <QStackedWidget>
#include <QTableView>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <utility>

#include "widgets/actions.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/panel_header.h"
#include "widgets/panels/empty_state.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/table_delegate.h"
#include "widgets/selection.h"
#include "widgets/settings.h"

namespace ghostlight {

/// Sorts by the numbers themselves and leaves out ghosts below a share of the strongest.
class GhostFilter : public QSortFilterProxyModel {
   public:
    GhostFilter(GhostTableModel& model, QObject* parent)
        : QSortFilterProxyModel(parent), model_(model) {
        setSourceModel(&model);
        setSortRole(GhostTableModel::sort_role);
    }
    void set_threshold(double share) {
        threshold_ = share;
        invalidateFilter();
    }

   protected:
    bool filterAcceptsRow(int row, const QModelIndex&) const override {
        const auto& ghosts = model_.table()->ghosts;
        return threshold_ <= 0.0 ||
               model_.row(row).flux_mm2 >= threshold_ * ghosts.front().flux_mm2;
    }

   private:
    GhostTableModel& model_;
    double threshold_ = 0.0;
};

namespace {

struct Threshold {
    const char* action;
    double share;
};
constexpr std::array<Threshold, 3> thresholds = {
    {{"ghosts.all", 0.0}, {"ghosts.above_3", 1e-3}, {"ghosts.above_2", 1e-2}}};

constexpr const char* what_is_here =
    "The lens's ghosts, the strongest first: flux, peak, place and size on the sensor.";

QTableView* make_table(QAbstractItemModel* model, QObject* parent) {
    QTableView* table = plain_table(
        model, new TableDelegate(GhostTableModel::bar_role, GhostTableModel::stale_role, parent));
    table->setObjectName("ghost_table");
    table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table->setSelectionBehavior(QAbstractItemView::SelectRows);
    table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table->setSortingEnabled(true);
    table->sortByColumn(GhostTableModel::flux, Qt::DescendingOrder);
    return table;
}

}  // namespace

GhostPanel::GhostPanel(Selection& selection, const Actions& actions, QWidget* parent)
    : QWidget(parent),
      selection_(selection),
      actions_(actions),
      model_(new GhostTableModel(this)),
      filter_(new GhostFilter(*model_, this)),
      header_(new PanelHeader("Ghosts")),
      table_(make_table(filter_, this)),
      empty_(new EmptyState(what_is_here, "Open a lens…")),
      working_(new EmptyState("Tracing the lens's ghosts…", QString())),
      cannot_(new EmptyState("No ghosts yet: the lens cannot be traced as it stands.", QString())),
      pages_(new QStackedWidget) {
    pages_->addWidget(empty_);
    pages_->addWidget(table_);
    pages_->addWidget(working_);
    pages_->addWidget(cannot_);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    column->addWidget(pages_, 1);

    connect(empty_, &EmptyState::action_triggered, &actions["file.open"], &QAction::trigger);
    connect(&selection_, &Selection::ghosts_changed, this, &GhostPanel::select_in_table);
    connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
            &GhostPanel::select_from_views);
    connect(table_->horizontalHeader(), &QHeaderView::sortIndicatorChanged, this,
            &GhostPanel::show_state);
    connect(table_, &QWidget::customContextMenuRequested, this, [this](const QPoint& at) {
        QMenu menu;
        actions_.fill(menu, {"ghosts.copy", "ghosts.clear", "-", "ghosts.all", "ghosts.above_3",
                             "ghosts.above_2", "-", "file.export_table"});
        menu.exec(table_->viewport()->mapToGlobal(at));
    });
    connect_actions(actions);
    set_threshold(settings::ghost_threshold());
}

GhostPanel::~GhostPanel() = default;

void GhostPanel::connect_actions(const Actions& actions) {
    for (const Threshold& threshold : thresholds) {
        connect(&actions[threshold.action], &QAction::triggered, this,
                [this, share = threshold.share] {
                    settings::set_ghost_threshold(share);
                    set_threshold(share);
                });
    }
    connect(&actions["ghosts.copy"], &QAction::triggered, this, &GhostPanel::copy_rows);
    connect(&actions["ghosts.clear"], &QAction::triggered, this,
            [this] { selection_.set_ghosts({}); });
    // The platform's copy key, where the table has the focus; the menu's entry shows no key
    // because cells elsewhere have their own.
    auto* copy = new QAction(table_);
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetShortcut);
    table_->addAction(copy);
    connect(copy, &QAction::triggered, this, &GhostPanel::copy_rows);
}

void GhostPanel::set_threshold(double share) {
    filter_->set_threshold(share);
    for (const Threshold& threshold : thresholds) {
        actions_[threshold.action].setChecked(threshold.share == share);
    }
    select_in_table();
    show_state();
}

void GhostPanel::set_table(std::shared_ptr<const GhostTable> table) {
    const bool was_empty = model_->rowCount() == 0;
    failed_ = false;
    is_working_ = false;
    selecting_ = true;  // rows may change their places, ghosts stay selected
    model_->set_table(std::move(table));
    filter_->invalidate();
    selecting_ = false;
    select_in_table();
    if (was_empty) {
        fit_columns(*table_);
    }
    show_state();
}

void GhostPanel::set_refining(double share) {
    progress_ = share;
    failed_ = false;
    is_working_ = true;
    model_->set_stale(true);
    show_state();
}

void GhostPanel::set_failed() {
    failed_ = true;
    is_working_ = false;
    model_->set_stale(true);
    show_state();
}

void GhostPanel::clear() {
    failed_ = false;
    is_working_ = false;
    model_->set_table(nullptr);
    show_state();
}

void GhostPanel::copy_rows() const {
    std::vector<int> rows;
    for (int row = 0; row < filter_->rowCount(); ++row) {
        const QModelIndex index = filter_->index(row, 0);
        if (table_->selectionModel()->isRowSelected(row) ||
            !table_->selectionModel()->hasSelection()) {
            rows.push_back(filter_->mapToSource(index).row());
        }
    }
    QGuiApplication::clipboard()->setText(model_->clipboard_text(rows));
}

void GhostPanel::select_from_views() {
    if (selecting_) {
        return;
    }
    std::vector<GhostPath> ghosts;
    for (const QModelIndex& index : table_->selectionModel()->selectedRows()) {
        ghosts.push_back(model_->row(filter_->mapToSource(index).row()).path);
    }
    selecting_ = true;
    selection_.set_ghosts(std::move(ghosts));
    selecting_ = false;
}

void GhostPanel::select_in_table() {
    if (selecting_) {
        return;
    }
    QItemSelection rows;
    for (const GhostPath& path : selection_.ghosts()) {
        const int row = model_->find(path);
        const QModelIndex index =
            row < 0 ? QModelIndex() : filter_->mapFromSource(model_->index(row, 0));
        if (index.isValid()) {
            rows.select(index, index);
        }
    }
    selecting_ = true;
    table_->selectionModel()->select(
        rows, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    selecting_ = false;
}

bool GhostPanel::is_refining() const { return model_->is_stale() && !failed_; }

void GhostPanel::show_state() {
    const int all = model_->rowCount();
    if (!model_->table()) {
        pages_->setCurrentWidget(is_working_ ? working_ : failed_ ? cannot_ : empty_);
        header_->set_state(is_working_ && progress_ > 0.0
                               ? QStringLiteral("tracing %1 %").arg(qRound(progress_ * 100.0))
                               : QString());
        return;
    }
    pages_->setCurrentWidget(table_);
    const int listed = filter_->rowCount();
    QString state =
        listed == all ? QString::number(all) : QStringLiteral("%1 of %2").arg(listed).arg(all);
    const QHeaderView* order = table_->horizontalHeader();
    state += QStringLiteral(" · by %1 %2")
                 .arg(sorted_by(order->sortIndicatorSection()),
                      order->sortIndicatorOrder() == Qt::DescendingOrder ? "▾" : "▴");
    if (is_refining()) {
        state += progress_ > 0.0 ? QStringLiteral(" · refining %1 %").arg(qRound(progress_ * 100.0))
                                 : QStringLiteral(" · refining");
    } else if (failed_) {
        state += QStringLiteral(" · of the last lens that could be traced");
    }
    header_->set_state(state);
}

}  // namespace ghostlight
