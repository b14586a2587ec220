#pragma once

#include <QAbstractTableModel>

#include <utility>
#include <vector>

#include "core/fit/flare_fit.h"

namespace ghostlight {

/// What a fit varies, one number a row, with what the fit has found beside it.
class FitParameterModel : public QAbstractTableModel {
    Q_OBJECT
   public:
    enum Column {
        what,
        unit_of,
        start,
        lower,
        upper,
        prior,
        fitted,
        error,
        interval,
        known,
        column_count
    };
    enum Role { stale_role = Qt::UserRole };
    struct Row {
        FitParameter parameter;
        bool varies = true;
        bool is_profiled = false;
    };
    using QAbstractTableModel::QAbstractTableModel;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;

    void set_rows(std::vector<Row> rows);
    const std::vector<Row>& rows() const { return rows_; }
    /// Values without errors while a fit goes on; with them when it is done. Empty: none.
    void set_numbers(std::vector<FittedNumber> numbers, bool have_errors);
    /// Those of the numbers that they were asked of.
    void set_profiles(std::vector<FittedProfile> profiles) { profiles_ = std::move(profiles); }

   Q_SIGNALS:
    /// A bound, a prior or a mark was typed; the rows are as they were until they are set anew.
    void edited(const std::vector<ghostlight::FitParameterModel::Row>& wanted);
    void refused(const QString& reason);

   private:
    const FittedNumber* number_of(const FitParameter& parameter) const;
    std::vector<Row> rows_;
    std::vector<FittedNumber> numbers_;
    std::vector<FittedProfile> profiles_;
    bool have_errors_ = false;
};

}  // namespace ghostlight
