#pragma once

#include <QAbstractTableModel>
#include <QTimer>
#include <QWidget>

#include <memory>
#include <vector>

#include "core/ghosts/lens_check.h"
#include "widgets/document.h"
#include "widgets/newest_job.h"

class QTableView;

namespace ghostlight {

class EmptyState;
class PanelHeader;
class Selection;

/// What check_lens() found, a row each.
class FindingsModel : public QAbstractTableModel {
    Q_OBJECT
   public:
    enum Column { surface, cell, text, proposal, column_count };
    using QAbstractTableModel::QAbstractTableModel;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

    void set_findings(std::vector<Finding> findings);
    const Finding& finding(int row) const { return findings_[static_cast<std::size_t>(row)]; }

   private:
    std::vector<Finding> findings_;
};

/// What is suspicious in the lens in hand. A click goes to the cell, and selects the ghosts that a
/// finding is about. It follows every change, off the GUI thread.
class CheckPanel : public QWidget {
    Q_OBJECT
   public:
    CheckPanel(Document& document, Selection& selection, QWidget* parent = nullptr);
    ~CheckPanel() override;

    FindingsModel& model() { return *model_; }
    QTableView& table() { return *table_; }
    bool is_settled() const { return !open_; }

   Q_SIGNALS:
    /// Row from 0, and which of its cells.
    void cell_chosen(int row, ghostlight::LensCell cell);
    /// How many errors and warnings there are.
    void counted(int grave);

   private:
    void follow_document();
    void go_to(const QModelIndex& index);
    void take(std::vector<Finding> findings);

    struct Wanted {
        Prescription lens;
        LensCheckRequest request;
        std::uint64_t serial = 0;
    };
    Document& document_;
    Selection& selection_;
    FindingsModel* model_;
    PanelHeader* header_;
    QTableView* table_;
    EmptyState* fine_;
    QTimer delay_;
    std::uint64_t serial_ = 0;
    bool open_ = false;
    std::unique_ptr<NewestJob<Wanted>> job_;
};

}  // namespace ghostlight
