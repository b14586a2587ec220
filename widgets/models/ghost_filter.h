#pragma once

#include <QSortFilterProxyModel>

#include <utility>

#include "core/ghosts/ghost_query.h"
#include "widgets/models/ghost_table_model.h"

namespace ghostlight {

/// Sorts by the numbers themselves and leaves out ghosts below a share of the strongest, and those
/// that the filter's words do not want.
class GhostFilter : public QSortFilterProxyModel {
   public:
    GhostFilter(GhostTableModel& model, QObject* parent)
        : QSortFilterProxyModel(parent), model_(model) {
        setSourceModel(&model);
        setSortRole(GhostTableModel::sort_role);
    }
    void set_threshold(double share) {
        threshold_ = share;
        invalidateFilter();
    }

    void set_query(GhostQuery query) {
        if (query != query_) {
            query_ = std::move(query);
            invalidateFilter();
        }
    }

   protected:
    bool filterAcceptsRow(int row, const QModelIndex&) const override {
        const GhostTable& table = *model_.table();
        const GhostRow& ghost = model_.row(row);
        return (threshold_ <= 0.0 ||
                ghost.flux_mm2 >= threshold_ * table.ghosts.front().flux_mm2) &&
               passes(query_, ghost, table);
    }

   private:
    GhostTableModel& model_;
    double threshold_ = 0.0;
    GhostQuery query_;
};

}  // namespace ghostlight
