#include "widgets/panels/first_order_panel.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QMenu>
#include <QStackedWidget>
#include <QTableView>
#include <QVBoxLayout>

#include <exception>
#include <utility>

#include "core/error.h"
#include "core/units.h"
#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/models/quantity_model.h"
#include "widgets/number_text.h"
#include "widgets/panel_header.h"
#include "widgets/panels/empty_state.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/table_delegate.h"
#include "widgets/panels/veiling_strip.h"

namespace ghostlight {

namespace {

QString what_is_here() {
    return FirstOrderPanel::tr(
        "The lens's first-order data: focal length, pupils, principal points, field and length.");
}

QTableView* make_table(QAbstractItemModel* model, QObject* parent) {
    QTableView* table =
        plain_table(model, new TableDelegate(-1, QuantityModel::stale_role, parent));
    table->setObjectName("first_order_table");
    table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table->setSelectionBehavior(QAbstractItemView::SelectRows);
    table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    // Names may be cut off, numbers and units not.
    table->horizontalHeader()->setSectionResizeMode(QuantityModel::name, QHeaderView::Stretch);
    return table;
}

}  // namespace

FirstOrderPanel::FirstOrderPanel(Document& document, const Actions& actions, QWidget* parent)
    : QWidget(parent),
      document_(document),
      model_(new QuantityModel(this)),
      header_(new PanelHeader(tr("First order"))),
      table_(make_table(model_, this)),
      empty_(new EmptyState(what_is_here(), tr("Open a lens…"))),
      cannot_(new EmptyState(QString(), QString())),
      pages_(new QStackedWidget) {
    pages_->addWidget(empty_);
    pages_->addWidget(table_);
    pages_->addWidget(cannot_);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    column->addWidget(pages_, 1);
    column->addWidget(new VeilingStrip(document_));

    job_ = std::make_unique<NewestJob<Request>>(
        [this](const Request& request, const std::stop_token&) { work_on(request); });
    delay_.setSingleShot(true);
    delay_.setInterval(0);
    connect(&delay_, &QTimer::timeout, this, &FirstOrderPanel::request);
    connect(empty_, &EmptyState::action_triggered, &actions["file.open"], &QAction::trigger);
    connect(&document_, &Document::changed, &delay_, qOverload<>(&QTimer::start));
    connect(&actions["first_order.copy"], &QAction::triggered, this, &FirstOrderPanel::copy_rows);
    auto* copy_key = new QAction(table_);
    copy_key->setShortcut(QKeySequence::Copy);
    copy_key->setShortcutContext(Qt::WidgetShortcut);
    table_->addAction(copy_key);
    connect(copy_key, &QAction::triggered, this, &FirstOrderPanel::copy_rows);
    connect(table_, &QWidget::customContextMenuRequested, this, [this, &actions](const QPoint& at) {
        QMenu menu;
        actions.fill(menu, {"first_order.copy"});
        menu.exec(table_->viewport()->mapToGlobal(at));
    });
}

FirstOrderPanel::~FirstOrderPanel() = default;

void FirstOrderPanel::request() {
    if (document_.is_empty()) {
        return;
    }
    QString state = tr("%1 nm · far object").arg(significant(d_line_nm, 4));
    if (!document_.scene().configuration.empty()) {
        state.prepend(QString::fromStdString(document_.scene().configuration) + " · ");
    }
    header_->set_state(state);
    try {
        Prescription lens = document_.configured_lens();
        if (lens == asked_) {
            return;  // the light moves, and nothing here changes
        }
        asked_ = lens;
        model_->set_stale(true);
        job_->submit({std::move(lens), ++serial_});
    } catch (const Error& error) {  // the configuration is not one of the lens's
        asked_ = {};
        ++serial_;
        show_reason(QString::fromUtf8(error.what()), serial_);
    }
}

void FirstOrderPanel::work_on(const Request& request) {
    try {
        auto quantities = lens_quantities(compile(request.lens, d_line_nm));
        QMetaObject::invokeMethod(
            this,
            [this, quantities = std::move(quantities), serial = request.serial] {
                show_quantities(quantities, serial);
            },
            Qt::QueuedConnection);
    } catch (const std::exception& error) {
        QMetaObject::invokeMethod(
            this,
            [this, reason = QString::fromUtf8(error.what()), serial = request.serial] {
                show_reason(reason, serial);
            },
            Qt::QueuedConnection);
    }
}

void FirstOrderPanel::show_quantities(std::vector<LensQuantity> quantities, std::uint64_t serial) {
    if (serial != serial_) {
        return;  // of an older lens
    }
    shown_serial_ = serial;
    const bool was_empty = model_->rowCount() == 0;
    reason_.clear();
    model_->set_quantities(std::move(quantities));
    pages_->setCurrentWidget(table_);
    if (was_empty) {
        fit_columns(*table_);
    }
}

void FirstOrderPanel::show_reason(const QString& reason, std::uint64_t serial) {
    if (serial != serial_) {
        return;
    }
    shown_serial_ = serial;
    reason_ = reason;
    model_->set_quantities({});
    cannot_->set_what(tr("Nothing can be worked out yet: %1").arg(reason));
    pages_->setCurrentWidget(cannot_);
}

QString FirstOrderPanel::state() const { return header_->state(); }

void FirstOrderPanel::copy_rows() const {
    std::vector<int> rows;
    for (int row = 0; row < model_->rowCount(); ++row) {
        if (table_->selectionModel()->isRowSelected(row) ||
            !table_->selectionModel()->hasSelection()) {
            rows.push_back(row);
        }
    }
    QGuiApplication::clipboard()->setText(model_->clipboard_text(rows));
}

}  // namespace ghostlight
