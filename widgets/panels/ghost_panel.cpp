#include "widgets/panels/ghost_panel.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QTableView>
#include <QTreeView>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <utility>

#include "widgets/actions.h"
#include "widgets/models/ghost_filter.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/models/surface_sums_model.h"
#include "widgets/panel_header.h"
#include "widgets/panels/empty_state.h"
#include "widgets/panels/ghost_matrix.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/table_delegate.h"
#include "widgets/selection.h"
#include "widgets/settings.h"

namespace ghostlight {

namespace {

struct Threshold {
    const char* action;
    double share;
};
constexpr std::array<Threshold, 3> thresholds = {
    {{"ghosts.all", 0.0}, {"ghosts.above_3", 1e-3}, {"ghosts.above_2", 1e-2}}};

QString what_is_here() {
    return GhostPanel::tr(
        "The lens's ghosts, the strongest first: flux, peak, place and size on the sensor.");
}

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

QTreeView* make_sums(QAbstractItemModel* model, QObject* parent) {
    QTreeView* tree = plain_tree(
        model, new TableDelegate(SurfaceSumsModel::bar_role, SurfaceSumsModel::stale_role, parent));
    tree->setObjectName("surface_sums");
    tree->setSelectionMode(QAbstractItemView::ExtendedSelection);
    tree->setSelectionBehavior(QAbstractItemView::SelectRows);
    tree->setEditTriggers(QAbstractItemView::NoEditTriggers);
    return tree;
}

}  // namespace

GhostPanel::GhostPanel(Selection& selection, const Actions& actions, QWidget* parent)
    : QWidget(parent),
      selection_(selection),
      actions_(actions),
      model_(new GhostTableModel(this)),
      filter_(new GhostFilter(*model_, this)),
      header_(new PanelHeader(tr("Ghosts"))),
      table_(make_table(filter_, this)),
      matrix_(new GhostMatrix),
      sums_(new SurfaceSumsModel(this)),
      surfaces_(make_sums(sums_, this)),
      empty_(new EmptyState(what_is_here(), tr("Open a lens…"))),
      working_(new EmptyState(tr("Tracing the lens's ghosts…"), QString())),
      cannot_(
          new EmptyState(tr("No ghosts yet: the lens cannot be traced as it stands."), QString())),
      pages_(new QStackedWidget) {
    pages_->addWidget(empty_);
    pages_->addWidget(table_);
    pages_->addWidget(matrix_);
    pages_->addWidget(surfaces_);
    pages_->addWidget(working_);
    pages_->addWidget(cannot_);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    build_strip();
    column->addWidget(strip_);
    column->addWidget(problem_);
    column->addWidget(pages_, 1);

    connect(empty_, &EmptyState::action_triggered, &actions["file.open"], &QAction::trigger);
    connect(&selection_, &Selection::ghosts_changed, this, &GhostPanel::select_in_table);
    connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
            &GhostPanel::select_from_views);
    connect(table_->horizontalHeader(), &QHeaderView::sortIndicatorChanged, this,
            &GhostPanel::show_state);
    connect(table_, &QWidget::customContextMenuRequested, this, [this](const QPoint& at) {
        QMenu menu;
        actions_.fill(menu, {"ghosts.filter", "-", "ghosts.copy", "ghosts.clear", "-", "ghosts.all",
                             "ghosts.above_3", "ghosts.above_2", "-", "file.export_table"});
        menu.exec(table_->viewport()->mapToGlobal(at));
    });
    connect(matrix_, &GhostMatrix::selected, &selection_, &Selection::set_ghosts);
    connect(surfaces_, &QTreeView::doubleClicked, this, [this](const QModelIndex& index) {
        const QModelIndex group = index.parent().isValid() ? index.parent() : index;
        const std::size_t row = sums_->sum(group.row()).surface;
        if (row < sums_->surface_count()) {
            Q_EMIT surface_chosen(static_cast<int>(row));
        }
    });
    connect(surfaces_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
            &GhostPanel::select_from_groups);
    table_->horizontalHeader()->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(table_->horizontalHeader(), &QWidget::customContextMenuRequested, this,
            &GhostPanel::choose_columns);
    connect_actions(actions);
    show_columns();
    set_look(Look::table);
    set_threshold(settings::ghost_threshold());
}

GhostPanel::~GhostPanel() = default;

void GhostPanel::set_before(std::shared_ptr<const GhostTable> before) {
    const bool compared = model_->compares();
    model_->set_before(std::move(before));
    if (model_->compares() != compared) {
        show_columns();
        // What is compared comes first: beside the flux.
        QHeaderView* header = table_->horizontalHeader();
        for (int k = 0; k < 3; ++k) {
            const int column = GhostTableModel::flux_a + k;
            header->moveSection(header->visualIndex(column), model_->compares() ? 2 + k : column);
        }
        fit_columns(*table_);
    }
}

void GhostPanel::connect_actions(const Actions& actions) {
    for (const Threshold& threshold : thresholds) {
        connect(&actions[threshold.action], &QAction::triggered, this,
                [this, share = threshold.share] {
                    settings::set_ghost_threshold(share);
                    set_threshold(share);
                });
    }
    connect(&actions["ghosts.filter"], &QAction::triggered, this, [this] {
        set_look(look_ == Look::surfaces ? Look::table : look_);
        words_->setFocus();
        words_->selectAll();
    });
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
    const bool other_surfaces =
        !model_->table() || model_->table()->surface_count != table->surface_count;
    model_->set_table(table);
    matrix_->show_table(table);
    {
        const QSignalBlocker quiet(surfaces_->selectionModel());
        std::vector<std::size_t> open;  // groups that stay so
        for (int row = 0; row < sums_->rowCount(); ++row) {
            if (surfaces_->isExpanded(sums_->index(row, 0))) {
                open.push_back(sums_->sum(row).surface);
            }
        }
        sums_->set_table(table);
        for (const std::size_t surface : open) {
            if (const QModelIndex group = sums_->group_of(surface); group.isValid()) {
                surfaces_->expand(group);
            }
        }
    }
    filter_->invalidate();
    selecting_ = false;
    if (other_surfaces) {
        read_filter();
    }
    select_in_table();
    if (was_empty) {
        fit_columns(*table_);
        fit_columns(*surfaces_);
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

void GhostPanel::set_stop_is_dirty(bool dirty) {
    stop_is_dirty_ = dirty;
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
    matrix_->show_table(nullptr);
    sums_->set_table(nullptr);
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

void GhostPanel::select_from_groups() {
    if (selecting_) {
        return;
    }
    std::vector<GhostPath> ghosts;
    for (const QModelIndex& index : surfaces_->selectionModel()->selectedRows()) {
        if (const GhostRow* row = sums_->ghost(index)) {
            if (std::ranges::find(ghosts, row->path) == ghosts.end()) {
                ghosts.push_back(row->path);
            }
        } else {
            const std::size_t surface = sums_->sum(index.row()).surface;
            words_->setText(surface == sums_->surface_count()
                                ? QStringLiteral("touches sensor")
                                : QStringLiteral("touches %1").arg(surface + 1));
        }
    }
    if (!ghosts.empty()) {
        in_groups_ = true;
        selection_.set_ghosts(std::move(ghosts));
        in_groups_ = false;
    }
}

void GhostPanel::select_in_groups() {
    if (in_groups_) {
        return;
    }
    QItemSelection rows;
    for (int group = 0; group < sums_->rowCount(); ++group) {
        const QModelIndex top = sums_->index(group, 0);
        for (int k = 0; k < sums_->rowCount(top); ++k) {
            const QModelIndex index = sums_->index(k, 0, top);
            if (std::ranges::find(selection_.ghosts(), sums_->ghost(index)->path) !=
                selection_.ghosts().end()) {
                rows.select(index, index);
            }
        }
    }
    const bool selecting = std::exchange(selecting_, true);
    surfaces_->selectionModel()->select(
        rows, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    selecting_ = selecting;
}

void GhostPanel::select_in_table() {
    matrix_->set_selected(selection_.ghosts());
    select_in_groups();
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
                               ? tr("tracing %1 %").arg(qRound(progress_ * 100.0))
                               : QString());
        return;
    }
    matrix_->set_stale(model_->is_stale());
    pages_->setCurrentWidget(look_ == Look::matrix     ? static_cast<QWidget*>(matrix_)
                             : look_ == Look::surfaces ? static_cast<QWidget*>(surfaces_)
                                                       : table_);
    const int listed = filter_->rowCount();
    QString state = listed == all ? QString::number(all) : tr("%1 of %2").arg(listed).arg(all);
    const QHeaderView* order = table_->horizontalHeader();
    state += tr(" · by %1 %2")
                 .arg(sorted_by(order->sortIndicatorSection()),
                      order->sortIndicatorOrder() == Qt::DescendingOrder ? "▾" : "▴");
    if (is_refining()) {
        state += progress_ > 0.0 ? tr(" · refining %1 %").arg(qRound(progress_ * 100.0))
                                 : tr(" · refining");
    } else if (failed_) {
        state += tr(" · of the last lens that could be traced");
    }
    if (stop_is_dirty_) {
        state += tr(" · without the stop's dirt");
    }
    header_->set_state(state);
    header_->setToolTip(
        stop_is_dirty_
            ? tr("Ghosts are listed, and but for those near focus drawn, as through a clean "
                 "stop: what its\ndirt takes of one depends on where its beam meets the stop. "
                 "Of the direct light the Stop\npanel says how much passes; three crossings "
                 "take about three times as much as one.")
            : QString());
}

}  // namespace ghostlight
