#include "widgets/panels/prescription_panel.h"

#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QStackedWidget>
#include <QTableView>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>

#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/models/prescription_model.h"
#include "widgets/panel_header.h"
#include "widgets/panels/empty_state.h"
#include "widgets/panels/number_handle.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/prescription_delegate.h"
#include "widgets/panels/scale_strip.h"
#include "widgets/settings.h"
#include "widgets/unknown_glass.h"

namespace ghostlight {

namespace {

QTableView* make_table(QAbstractItemModel* model, QAbstractItemDelegate* delegate) {
    QTableView* table = plain_table(model, delegate);
    table->setObjectName("prescription_table");
    table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table->setSelectionBehavior(QAbstractItemView::SelectItems);
    table->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed |
                           QAbstractItemView::AnyKeyPressed);
    table->horizontalHeader()->setStretchLastSection(true);
    return table;
}

}  // namespace

PrescriptionPanel::PrescriptionPanel(Document& document, const Actions& actions, QWidget* parent)
    : QWidget(parent),
      document_(document),
      model_(new PrescriptionModel(document, this)),
      header_(new PanelHeader(tr("Prescription"))),
      handle_(new NumberHandle(*model_)),
      scale_(new ScaleStrip(document)),
      pages_(new QStackedWidget) {
    auto* delegate = new PrescriptionDelegate(this);
    table_ = make_table(model_, delegate);
    // Beside the cell that it is about; it scrolls with it.
    reason_ = new QLabel(table_->viewport());
    reason_->setObjectName("refusal");
    reason_->setWordWrap(true);
    reason_->hide();
    auto* empty = new EmptyState(
        tr("The lens's surfaces: radii, thicknesses, glasses and coatings, to be edited here."),
        tr("Open a lens…"));
    connect(empty, &EmptyState::action_triggered, &actions["file.open"], &QAction::trigger);
    pages_->addWidget(empty);
    pages_->addWidget(table_);

    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    column->addWidget(pages_, 1);
    column->addWidget(scale_);
    column->addWidget(handle_);

    connect(delegate, &PrescriptionDelegate::refusal_changed, this,
            &PrescriptionPanel::show_reason);
    connect(model_, &PrescriptionModel::refused, this,
            [this](const QModelIndex&, const QString& reason) { show_reason(reason); });
    // The cell in hand stays in hand when rows come and go.
    connect(model_, &QAbstractItemModel::modelAboutToBeReset, this,
            [this] { kept_row_ = current_row(); });
    connect(model_, &QAbstractItemModel::modelReset, this, [this] {
        if (kept_row_ >= 0) {
            go_to(std::min(kept_row_, model_->rowCount() - 1));
        }
    });
    connect(table_->selectionModel(), &QItemSelectionModel::currentChanged, this,
            [this] { show_reason({}); });
    connect(table_, &QWidget::customContextMenuRequested, this,
            [this, &actions](const QPoint& at) { show_menu(at, actions); });
    connect(&document_, &Document::changed, this, &PrescriptionPanel::follow_document);
    connect(&document_, &Document::opened, this,
            // After the views have got the new rows.
            [this] { QTimer::singleShot(0, this, &PrescriptionPanel::show_columns); });
    connect_actions(actions);
    connect_cells(actions);
    connect_handle();
    follow_document();
    show_columns();
}

void PrescriptionPanel::connect_actions(const Actions& actions) {
    const auto on_row = [this, &actions](const char* id, auto edit) {
        connect(&actions[id], &QAction::triggered, this, [this, edit] {
            if (current_row() >= 0) {
                show_reason({});
                edit(current_row());
            }
        });
    };
    on_row("edit.insert", [this](int row) {
        if (model_->insert_after(row)) {
            go_to(row + 1);
        }
    });
    on_row("edit.delete", [this](int row) {
        if (model_->remove(row)) {
            go_to(std::min(row, model_->rowCount() - 1));
        }
    });
    on_row("edit.move_up", [this](int row) {
        if (row > 0 && model_->move(row, row - 1)) {
            go_to(row - 1);
        }
    });
    on_row("edit.move_down", [this](int row) {
        if (row + 1 < model_->rowCount() && model_->move(row, row + 1)) {
            go_to(row + 1);
        }
    });
    connect(&actions["edit.mend_glass"], &QAction::triggered, this, [this] { mend_glass(); });
    on_row("edit.make_stop", [this](int row) { model_->make_stop(row); });

    const auto on_columns = [this, &actions](const char* id, bool shown, void (*keep)(bool)) {
        actions[id].setChecked(shown);
        connect(&actions[id], &QAction::toggled, this, [this, keep](bool wanted) {
            keep(wanted);
            show_columns();
        });
    };
    on_columns("view.aspheres", settings::shows_aspheres(), settings::set_shows_aspheres);
    on_columns("view.comments", settings::shows_comments(), settings::set_shows_comments);
    model_->set_shows_curvatures(settings::shows_curvatures());
    on_columns("view.curvatures", settings::shows_curvatures(),
               [](bool wanted) { settings::set_shows_curvatures(wanted); });
    connect(&actions["view.curvatures"], &QAction::toggled, this, [this](bool wanted) {
        model_->set_shows_curvatures(wanted);
        show_columns();
    });
    QHeaderView* header = table_->horizontalHeader();
    header->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(header, &QWidget::customContextMenuRequested, this,
            [header, &actions](const QPoint& at) {
                QMenu menu;
                actions.fill(menu, {"view.curvatures", "view.aspheres", "view.comments"});
                menu.exec(header->mapToGlobal(at));
            });
}

void PrescriptionPanel::show_menu(const QPoint& position, const Actions& actions) {
    QMenu menu;
    add_offers(menu, table_->indexAt(position));
    actions.fill(menu,
                 {"edit.insert", "edit.delete", "-", "edit.move_up", "edit.move_down", "-",
                  "edit.make_stop", "-", "edit.copy_cells", "edit.paste_cells", "-", "edit.vary",
                  "edit.auto_size", "edit.own_thickness", "-", "edit.undo", "edit.redo"});
    menu.exec(table_->viewport()->mapToGlobal(position));
}

void PrescriptionPanel::add_offers(QMenu& menu, const QModelIndex& index) {
    const QStringList offers = index.data(PrescriptionModel::offers_role).toStringList();
    if (offers.isEmpty()) {
        return;
    }
    menu.addAction(tr("Nearest glasses:"))->setEnabled(false);
    for (const QString& glass : offers) {
        menu.addAction(glass, this, [this, glass, cell = QPersistentModelIndex(index)] {
            model_->setData(cell, glass, Qt::EditRole);
        });
    }
    menu.addSeparator();
}

void PrescriptionPanel::select_surface(int row) {
    if (row >= 0 && row < model_->rowCount()) {
        go_to(row);
        table_->scrollTo(table_->currentIndex());
    }
}

bool PrescriptionPanel::mend_glass() {
    const auto row = first_unknown_glass(document_.lens());
    if (!row) {
        return false;
    }
    const QModelIndex cell = model_->index(static_cast<int>(*row), PrescriptionModel::medium);
    table_->setFocus();
    table_->setCurrentIndex(cell);
    table_->scrollTo(cell);
    table_->edit(cell);
    return true;
}

void PrescriptionPanel::follow_document() {
    pages_->setCurrentIndex(document_.is_empty() ? 0 : 1);
    handle_->setVisible(!document_.is_empty());
    if (document_.is_empty()) {
        header_->set_state(QString());
        return;
    }
    const auto unknown = std::ranges::count_if(document_.lens().surfaces, [](const Surface& each) {
        return std::holds_alternative<UnknownGlass>(each.medium_after.dispersion);
    });
    header_->set_warning(unknown > 0);
    if (unknown > 0) {
        header_->set_state(
            tr("%n glass(es) not known: mend here", nullptr, static_cast<int>(unknown)));
        return;
    }
    QString state = tr("mm · R > 0: centre towards the sensor");
    if (!document_.scene().configuration.empty()) {
        state.prepend(QString::fromStdString(document_.scene().configuration) + " · ");
    }
    header_->set_state(state);
}

void PrescriptionPanel::show_columns() {
    const Prescription& lens = document_.lens();
    bool aspheric = settings::shows_aspheres();
    bool commented = settings::shows_comments();
    // What most lenses do not have takes no room unless this one does. Nearly every lens says at
    // its stop that it is the stop; that is no reason for a column.
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const Surface& surface = lens.surfaces[row];
        aspheric = aspheric || surface.conic != 0.0 || !surface.aspheric.empty();
        commented = commented || (!surface.comment.empty() && row != lens.stop.surface);
    }
    table_->setColumnHidden(PrescriptionModel::conic, !aspheric);
    table_->setColumnHidden(PrescriptionModel::aspheric, !aspheric);
    table_->setColumnHidden(PrescriptionModel::comment, !commented);
    // Glasses given by their numbers say them in their own column.
    table_->setColumnHidden(PrescriptionModel::dispersion,
                            std::ranges::none_of(lens.surfaces, [](const Surface& surface) {
                                return !surface.medium_after.name.empty();
                            }));
    fit_columns(*table_);
}

void PrescriptionPanel::show_reason(const QString& reason) {
    reason_->setText(reason);
    reason_->setVisible(!reason.isEmpty());
    if (reason.isEmpty()) {
        return;
    }
    constexpr int most_width = 360;
    constexpr int margin = 8;
    const QRect cell = table_->visualRect(table_->currentIndex());
    const QRect room = table_->viewport()->rect().adjusted(margin, 0, -margin, 0);
    const int width = std::min(room.width(), most_width);
    const int height = reason_->heightForWidth(width);
    // Below the cell, or above it where there is no room below.
    const bool fits = cell.bottom() + 4 + height <= room.bottom();
    reason_->setGeometry(std::clamp(cell.left(), room.left(), room.right() + 1 - width),
                         fits ? cell.bottom() + 4 : cell.top() - 4 - height, width, height);
    reason_->raise();
}

QString PrescriptionPanel::reason() const { return reason_->text(); }

int PrescriptionPanel::current_row() const { return table_->currentIndex().row(); }

void PrescriptionPanel::go_to(int row) {
    const int column = table_->currentIndex().column();
    table_->setCurrentIndex(model_->index(row, std::max<int>(column, PrescriptionModel::radius)));
}

void PrescriptionPanel::set_hovered_row(int row) { model_->set_marked_row(row - 1); }

}  // namespace ghostlight
