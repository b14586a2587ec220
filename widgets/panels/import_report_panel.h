#pragma once

#include <QWidget>

#include "core/error.h"

class QStackedWidget;
class QTableView;

namespace ghostlight {

class Actions;
class Document;
class EmptyState;
class NoteFilter;
class NoteTableModel;
class PanelHeader;

/// What became of each thing in the file that was opened, or in the one that was written last.
class ImportReportPanel : public QWidget {
    Q_OBJECT
   public:
    ImportReportPanel(Document& document, const Actions& actions, QWidget* parent = nullptr);

    NoteTableModel& model() { return *model_; }
    NoteFilter& filter() { return *filter_; }
    QTableView& table() { return *table_; }
    /// What an export could not take along; stays until another lens is opened.
    void show_export(const QString& file, const Notes& notes);
    /// What stands in place of the table; empty while the table is shown.
    QString empty_text() const;
    QString state() const;
    /// The rows shown, as the command line writes them.
    QString text() const;

   Q_SIGNALS:
    /// A row about this surface was chosen; rows count from 0.
    void surface_chosen(int row);
    /// There is something here that must not be missed.
    void wants_attention();

   private:
    void show_import();
    void show_state();
    void set_only_what_matters(bool only);
    void fit_table();

    Document& document_;
    const Actions& actions_;
    NoteTableModel* model_;
    NoteFilter* filter_;
    PanelHeader* header_;
    QTableView* table_;
    EmptyState* empty_;
    EmptyState* remark_;  ///< why a lens has no lines here
    QStackedWidget* pages_;
    QString exported_;  ///< the file that the notes are about; empty for an import
    QString empty_text_;
};

}  // namespace ghostlight
