#pragma once

#include <QAbstractTableModel>

#include <optional>
#include <string>
#include <vector>

#include "core/fit/flare_fit.h"

namespace ghostlight {

/// The ghosts of the lens in a fit: which count, and what became of each.
class FitGhostModel : public QAbstractTableModel {
    Q_OBJECT
   public:
    enum Column { ghost, signal, before, after, gain, fate, column_count };
    using QAbstractTableModel::QAbstractTableModel;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;

    /// All ghosts of the lens, and those that do not count, by name.
    void set_ghosts(const std::vector<std::string>& names,
                    const std::vector<std::string>& left_out);
    /// The strongest first from then on; null: none.
    void set_report(const FitReport* report);
    std::string name_at(int row) const { return rows_[static_cast<std::size_t>(row)].name; }
    std::size_t counted() const;

   Q_SIGNALS:
    void count_asked(const std::string& name, bool counts);

   private:
    struct Row {
        std::string name;
        bool counts = true;
        std::optional<FittedGhost> fitted;  ///< of the photograph that shows it best
        std::optional<double> at_most;      ///< signal to noise of one below the noise
    };
    QString fate_of(const Row& row) const;
    void sort_rows();
    std::vector<Row> rows_;
    bool has_report_ = false;
};

}  // namespace ghostlight
