#pragma once

#include <QAbstractTableModel>

#include <vector>

#include "core/io/lens_quantities.h"

namespace ghostlight {

/// First-order data, one quantity a row.
class QuantityModel : public QAbstractTableModel {
    Q_OBJECT
   public:
    enum Column { name, value, unit, column_count };
    enum Role { stale_role = Qt::UserRole };
    using QAbstractTableModel::QAbstractTableModel;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

    void set_quantities(std::vector<LensQuantity> quantities);
    /// Newer numbers are on their way; the next ones are fresh again.
    void set_stale(bool stale);
    /// Rows as text with tabs between columns, every digit, headers first.
    QString clipboard_text(const std::vector<int>& rows) const;

   private:
    std::vector<LensQuantity> quantities_;
    bool stale_ = false;
};

}  // namespace ghostlight
