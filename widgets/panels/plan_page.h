#pragma once

#include <QWidget>

#include <memory>
#include <optional>

#include "core/flare/plan_report.h"

class QLabel;
class QPushButton;
class QTableWidget;

namespace ghostlight {

/// What the picture on screen does not compute, with the bound of each and of all together.
class PlanPage : public QWidget {
    Q_OBJECT
   public:
    explicit PlanPage(QWidget* parent = nullptr);

    void show_report(std::shared_ptr<const PlanReport> report);
    void show_nothing(const QString& why);
    void show_progress(double share);
    void show_error(const MeasuredPlan& error);
    /// The sentence below the table.
    QString sum() const;
    QTableWidget& table() { return *table_; }
    QPushButton& measure() { return *measure_; }

   private:
    void show_sum();
    QTableWidget* table_;
    QLabel* sum_;
    QPushButton* measure_;
    std::shared_ptr<const PlanReport> report_;
    std::optional<MeasuredPlan> error_;
};

}  // namespace ghostlight
