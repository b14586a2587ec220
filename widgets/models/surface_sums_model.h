#pragma once

#include <QAbstractItemModel>

#include <memory>
#include <vector>

#include "core/ghosts/ghost_sums.h"

namespace ghostlight {

/// Ghosts in groups by surface: what each surface feeds, the flux of all ghosts that turn there,
/// the largest first, and below it those ghosts, the strongest first. It says which surface should
/// get the better coating first. A ghost is in the groups of both of its surfaces.
class SurfaceSumsModel : public QAbstractItemModel {
    Q_OBJECT
   public:
    enum Column { surface, media, flux, bar, share, on_sensor, ghosts, column_count };
    enum Role { sort_role = Qt::UserRole, bar_role, stale_role };
    using QAbstractItemModel::QAbstractItemModel;

    QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    QModelIndex parent(const QModelIndex& index) const override;
    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

    void set_table(std::shared_ptr<const GhostTable> table);
    const SurfaceSum& sum(int row) const { return groups_[static_cast<std::size_t>(row)].sum; }
    /// The group of a surface, or an invalid index.
    QModelIndex group_of(std::size_t row) const;
    /// The ghost in a group's row; null for the group's own.
    const GhostRow* ghost(const QModelIndex& index) const;
    /// Of the lens; the next one is the sensor.
    std::size_t surface_count() const { return table_ ? table_->surface_count : 0; }

   private:
    struct Group {
        SurfaceSum sum;
        std::vector<std::size_t> ghosts;  ///< in the table
    };
    QString surface_text(std::size_t row) const;
    QString media_text(std::size_t row) const;
    QVariant group_data(const Group& group, int column, int role) const;
    QVariant ghost_data(const Group& group, const GhostRow& ghost, int column, int role) const;

    std::shared_ptr<const GhostTable> table_;
    std::vector<Group> groups_;
    GhostSum all_;
};

}  // namespace ghostlight
