#pragma once

#include <QAbstractTableModel>

#include <map>
#include <memory>
#include <vector>

#include "core/ghosts/ghost_table.h"

namespace ghostlight {

/// The ghosts of the last table that was computed, strongest first. While a newer one is on its
/// way the numbers stay, marked as stale.
class GhostTableModel : public QAbstractTableModel {
    Q_OBJECT
   public:
    enum Column {
        ghost,
        flux,
        magnitude,
        relative,
        peak,
        centroid_x,
        centroid_y,
        rms_radius,
        on_sensor,
        reflectance_1,
        reflectance_2,
        incidence_1,
        incidence_2,
        focus,
        width,
        height,
        flux_a,  ///< these three while there is a table to compare with
        difference,
        ratio,
        rays,
        column_count
    };
    enum Role {
        sort_role = Qt::UserRole,  ///< the number itself
        bar_role,                  ///< 0 to 1, of the magnitude column
        stale_role
    };
    using QAbstractTableModel::QAbstractTableModel;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

    void set_table(std::shared_ptr<const GhostTable> table);
    const std::shared_ptr<const GhostTable>& table() const { return table_; }
    /// The table of the pinned lens, to compare with; null ends that.
    void set_before(std::shared_ptr<const GhostTable> before);
    bool compares() const { return before_ != nullptr; }
    void set_stale(bool stale);
    bool is_stale() const { return stale_; }

    const GhostRow& row(int row) const { return table_->ghosts[static_cast<std::size_t>(row)]; }
    /// Row of a ghost, or −1.
    int find(const GhostPath& path) const;
    /// Rows as text with tabs between columns, every digit, headers first.
    QString clipboard_text(const std::vector<int>& rows) const;

   private:
    double number(const GhostRow& row, int column) const;
    QVariant text(const GhostRow& row, int column) const;

    std::shared_ptr<const GhostTable> table_, before_;
    std::map<GhostPath, double> flux_before_mm2_;
    bool stale_ = false;
};

/// The name of a column that scripts know, empty for the bar's; and what people call it.
QString column_id(int column);
QString column_title(int column);
/// The columns that are only there while two lenses are compared.
bool is_of_comparison(int column);

/// What a column is sorted by, in words: "flux".
QString sorted_by(int column);

}  // namespace ghostlight
