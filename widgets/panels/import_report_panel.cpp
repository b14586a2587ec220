#include "widgets/panels/import_report_panel.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QMenu>
#include <QStackedWidget>
#include <QTableView>
#include <QVBoxLayout>

#include <algorithm>

#include "core/io/import_report.h"
#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/models/note_table_model.h"
#include "widgets/panel_header.h"
#include "widgets/panels/empty_state.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/table_delegate.h"

namespace ghostlight {

namespace {

QString what_is_here() {
    return ImportReportPanel::tr(
        "What became of each line of a lens file from another program: read, converted, assumed or "
        "left out, and whether it matters for flare.");
}

QTableView* make_table(QAbstractItemModel* model, QObject* parent) {
    QTableView* table = plain_table(model, new TableDelegate(-1, -1, parent));
    table->setObjectName("import_report_table");
    table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table->setSelectionBehavior(QAbstractItemView::SelectRows);
    table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table->horizontalHeader()->setStretchLastSection(true);
    return table;
}

}  // namespace

ImportReportPanel::ImportReportPanel(Document& document, const Actions& actions, QWidget* parent)
    : QWidget(parent),
      document_(document),
      actions_(actions),
      model_(new NoteTableModel(this)),
      filter_(new NoteFilter(this)),
      header_(new PanelHeader(tr("Import report"))),
      table_(nullptr),
      empty_(new EmptyState(what_is_here(), tr("Open a lens…"))),
      remark_(new EmptyState(QString(), QString())),
      pages_(new QStackedWidget) {
    filter_->setSourceModel(model_);
    table_ = make_table(filter_, this);
    pages_->addWidget(empty_);
    pages_->addWidget(table_);
    pages_->addWidget(remark_);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    column->addWidget(pages_, 1);

    connect(empty_, &EmptyState::action_triggered, &actions["file.open"], &QAction::trigger);
    connect(table_, &QTableView::clicked, this, [this](const QModelIndex& index) {
        const int row = index.data(NoteTableModel::surface_role).toInt();
        if (row >= 0) {
            Q_EMIT surface_chosen(row);
        }
    });
    connect(table_, &QWidget::customContextMenuRequested, this, [this](const QPoint& at) {
        QMenu menu;
        actions_.fill(menu, {"report.copy", "-", "report.all", "report.matters"});
        menu.exec(table_->viewport()->mapToGlobal(at));
    });
    const auto copy = [this] { QGuiApplication::clipboard()->setText(text()); };
    connect(&actions["report.copy"], &QAction::triggered, this, copy);
    auto* copy_key = new QAction(table_);
    copy_key->setShortcut(QKeySequence::Copy);
    copy_key->setShortcutContext(Qt::WidgetShortcut);
    table_->addAction(copy_key);
    connect(copy_key, &QAction::triggered, this, copy);
    for (const bool only : {false, true}) {
        connect(&actions[only ? "report.matters" : "report.all"], &QAction::triggered, this,
                [this, only] { set_only_what_matters(only); });
    }
    connect(&document_, &Document::changed, this, [this] {
        if (document_.revision() == document_.first_revision()) {
            show_import();
        }
    });
    set_only_what_matters(false);
}

void ImportReportPanel::show_import() {
    exported_.clear();
    model_->set_notes(document_.notes(), document_.lens());
    show_state();
    fit_table();
    if (!document_.is_own_file() && model_->count(Note::Severity::warning) > 0) {
        Q_EMIT wants_attention();
    }
}

void ImportReportPanel::show_export(const QString& file, const Notes& notes) {
    exported_ = file;
    model_->set_notes(notes, document_.lens());
    show_state();
    fit_table();
    if (model_->rowCount() > 0) {
        Q_EMIT wants_attention();
    }
}

void ImportReportPanel::set_only_what_matters(bool only) {
    filter_->set_only_what_matters(only);
    actions_["report.all"].setChecked(!only);
    actions_["report.matters"].setChecked(only);
    show_state();
}

void ImportReportPanel::show_state() {
    const bool nothing_matters = filter_->only_what_matters() && filter_->rowCount() == 0;
    empty_text_.clear();
    if (document_.is_empty()) {
        empty_text_ = what_is_here();
    } else if (model_->rowCount() == 0) {
        empty_text_ = !exported_.isEmpty() ? tr("%1 holds all of the lens.").arg(exported_)
                      : document_.file().empty()
                          ? tr("This lens has no file yet.")
                          : tr("%1 was read without a remark.")
                                .arg(QString::fromStdString(document_.file().filename().string()));
    } else if (nothing_matters) {
        empty_text_ =
            tr("Nothing here matters for flare. %n line(s) more.", nullptr, model_->rowCount());
    }
    remark_->set_what(empty_text_);
    pages_->setCurrentWidget(empty_text_.isEmpty()  ? static_cast<QWidget*>(table_)
                             : document_.is_empty() ? empty_
                                                    : remark_);

    QString state = exported_.isEmpty() ? QString() : tr("export to %1").arg(exported_);
    if (model_->rowCount() > 0) {
        const int to_mend = model_->count(Note::Severity::error);
        QStringList parts;
        if (!state.isEmpty()) {
            parts << state;
        }
        if (to_mend > 0) {
            parts << tr("%1 to mend").arg(to_mend);
        }
        parts << tr("%1 of %2 matter for flare")
                     .arg(model_->count_what_matters())
                     .arg(model_->rowCount());
        if (filter_->only_what_matters()) {
            parts << tr("only these shown");
        }
        state = parts.join(" · ");
    }
    header_->set_state(state);
    header_->set_warning(model_->count(Note::Severity::error) > 0);
}

void ImportReportPanel::fit_table() {
    fit_columns(*table_);
    // The words matter more than where they come from, and both have to be seen at once.
    constexpr int widest_place = 150;
    constexpr int widest_text = 620;
    table_->setColumnWidth(NoteTableModel::place,
                           std::min(table_->columnWidth(NoteTableModel::place), widest_place));
    table_->setColumnWidth(NoteTableModel::text,
                           std::min(table_->columnWidth(NoteTableModel::text), widest_text));
    table_->scrollToTop();
}

QString ImportReportPanel::empty_text() const { return empty_text_; }

QString ImportReportPanel::state() const { return header_->state(); }

QString ImportReportPanel::text() const {
    Notes shown;
    for (int row = 0; row < filter_->rowCount(); ++row) {
        const QModelIndex index = filter_->mapToSource(filter_->index(row, 0));
        const bool chosen = table_->selectionModel()->isRowSelected(row);
        if (chosen || !table_->selectionModel()->hasSelection()) {
            shown.push_back(model_->notes()[static_cast<std::size_t>(index.row())]);
        }
    }
    return QString::fromStdString(notes_text(shown));
}

}  // namespace ghostlight
