#pragma once

#include <QAbstractTableModel>

#include <memory>
#include <vector>

#include "core/ghosts/ghost_sums.h"

namespace ghostlight {

/// What each surface feeds: the flux of all ghosts that turn there, the largest first. It says
/// which surface should get the better coating first.
class SurfaceSumsModel : public QAbstractTableModel {
    Q_OBJECT
   public:
    enum Column { surface, media, flux, bar, share, on_sensor, ghosts, column_count };
    enum Role { sort_role = Qt::UserRole, bar_role, stale_role };
    using QAbstractTableModel::QAbstractTableModel;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

    void set_table(std::shared_ptr<const GhostTable> table);
    const SurfaceSum& sum(int row) const { return sums_[static_cast<std::size_t>(row)]; }
    /// Of the lens; the next one is the sensor.
    std::size_t surface_count() const { return table_ ? table_->surface_count : 0; }

   private:
    std::shared_ptr<const GhostTable> table_;
    std::vector<SurfaceSum> sums_;
    GhostSum all_;
};

}  // namespace ghostlight
