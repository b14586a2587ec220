#include <QClipboard>
#include <QGuiApplication>
#include <QTableView>

#include <algorithm>

#include "core/error.h"
#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/models/prescription_model.h"
#include "widgets/panels/number_handle.h"
#include "widgets/panels/prescription_clipboard.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/panels/row_drag.h"
#include "widgets/panels/scale_strip.h"
#include "widgets/panels/scrub.h"
#include "widgets/prescription_edits.h"

namespace ghostlight {

namespace {

/// As far as a drag over a cell goes for what the handle's slider gives at its end.
constexpr double reach_px = 300.0;

void add_key(QTableView& table, QKeySequence::StandardKey key, QAction& does) {
    auto* action = new QAction(&table);
    action->setShortcut(key);
    action->setShortcutContext(Qt::WidgetShortcut);
    table.addAction(action);
    QObject::connect(action, &QAction::triggered, &does, &QAction::trigger);
}

}  // namespace

void PrescriptionPanel::connect_cells(const Actions& actions) {
    const auto on = [this, &actions](const char* id, auto method) {
        connect(&actions[id], &QAction::triggered, this, [this, method] {
            show_reason({});
            (this->*method)();
        });
    };
    on("edit.copy_cells", &PrescriptionPanel::copy_cells);
    on("edit.paste_cells", &PrescriptionPanel::paste_cells);
    on("edit.vary", &PrescriptionPanel::vary_cells);
    on("edit.auto_size", &PrescriptionPanel::size_automatically);
    add_key(*table_, QKeySequence::Copy, actions["edit.copy_cells"]);
    add_key(*table_, QKeySequence::Paste, actions["edit.paste_cells"]);
    connect(&actions["edit.own_thickness"], &QAction::triggered, this, [this] {
        show_reason({});
        if (current_row() >= 0) {
            const std::string& configuration = document_.scene().configuration;
            model_->set_own_thickness(
                current_row(), !overrides_thickness(document_.lens(), configuration,
                                                    static_cast<std::size_t>(current_row())));
        }
    });
    connect(&actions["edit.reverse"], &QAction::triggered, this, [this] {
        show_reason({});
        model_->reverse();
    });
    connect(&actions["edit.scale"], &QAction::triggered, this, [this] {
        show_reason({});
        if (!document_.is_empty()) {
            scale_->ask();
        }
    });
    connect(scale_, &ScaleStrip::chosen, this, [this](double factor) {
        show_reason({});
        model_->scale(factor);
    });
    connect(scale_, &ScaleStrip::refused, this, &PrescriptionPanel::show_reason);
    auto* rows = new RowDrag(*table_);
    connect(rows, &RowDrag::row_moved, this, [this](int from, int to) {
        if (model_->move(from, to)) {
            go_to(to);
        }
    });
}

void PrescriptionPanel::connect_handle() {
    connect(table_->selectionModel(), &QItemSelectionModel::currentChanged, this,
            [this](const QModelIndex& current) {
                handle_->set_cell(current);
                Q_EMIT row_chosen(current.row());
            });
    // The handle, and the panels about a surface, have one to begin with; and after rows have come
    // or gone, the one that is in hand by now.
    connect(
        model_, &QAbstractItemModel::modelReset, this,
        [this] {
            if (current_row() < 0 && model_->rowCount() > 0) {
                go_to(0);
            }
            handle_->set_cell(table_->currentIndex());
            Q_EMIT row_chosen(current_row());
        },
        Qt::QueuedConnection);
    // The middle button draws the number under the cursor, in any cell.
    auto* scrub = new Scrub(*table_->viewport(), Qt::MiddleButton);
    connect(scrub, &Scrub::begun, this, [this](const QPoint& at) {
        show_reason({});
        table_->setCurrentIndex(table_->indexAt(at));
        handle_->begin(table_->indexAt(at));
        table_->viewport()->setCursor(Qt::SizeHorCursor);
    });
    connect(scrub, &Scrub::moved, this, [this](double px) { handle_->draw(px / reach_px); });
    connect(scrub, &Scrub::ended, this, [this] { table_->viewport()->unsetCursor(); });
}

void PrescriptionPanel::copy_cells() {
    QGuiApplication::clipboard()->setText(copied_cells(*table_));
}

void PrescriptionPanel::paste_cells() {
    try {
        const auto cells = pasted_cells(*table_, QGuiApplication::clipboard()->text());
        model_->set_texts(cells, tr("paste %n cell(s)", nullptr, static_cast<int>(cells.size())));
    } catch (const Error& error) {
        show_reason(error.what());
    }
}

void PrescriptionPanel::vary_cells() {
    QModelIndexList cells = table_->selectionModel()->selectedIndexes();
    cells.removeIf([](const QModelIndex& cell) {
        return cell.data(PrescriptionModel::vary_kind_role).toString().isEmpty();
    });
    if (cells.isEmpty()) {
        show_reason(
            tr("A fit varies radii, thicknesses, glasses, semi-diameters and coatings: choose "
               "such cells."));
        return;
    }
    const bool all_vary = std::ranges::all_of(cells, [](const QModelIndex& cell) {
        return cell.data(PrescriptionModel::mark_role).toString().contains('V');
    });
    model_->set_varied(cells, !all_vary);
}

void PrescriptionPanel::size_automatically() {
    std::vector<CellText> cells;
    for (const QModelIndex& cell : table_->selectionModel()->selectedIndexes()) {
        const auto row = static_cast<std::size_t>(cell.row());
        const bool is_in =
            std::ranges::any_of(cells, [row](const CellText& other) { return other.row == row; });
        if (!is_in && row != document_.lens().stop.surface) {
            cells.push_back({row, PrescriptionModel::semi_diameter, "auto"});
        }
    }
    if (!cells.empty()) {
        model_->set_texts(cells, tr("size by the direct beam"));
    }
}

}  // namespace ghostlight
