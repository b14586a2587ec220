#pragma once

#include <QWidget>

#include <string>
#include <vector>

#include "core/fit/fit_setup.h"
#include "widgets/models/fit_ghost_model.h"

class QLabel;
class QTableView;

namespace ghostlight {

/// Which ghosts count in a fit, by hand, and which the fit leaves out, being below the noise.
class FitGhostPage : public QWidget {
    Q_OBJECT
   public:
    explicit FitGhostPage(QWidget* parent = nullptr);

    void set_setup(const FitSetup& setup, const Prescription& lens);
    void set_report(const FitReport* report);
    FitGhostModel& model() { return *model_; }
    QTableView& table() { return *table_; }
    /// The sentence below the table.
    QString sum() const;

   Q_SIGNALS:
    void edited(const ghostlight::FitSetup& setup, const QString& step);

   private:
    std::vector<std::string> chosen() const;
    void edit(const std::string& left_out, const std::string& only, const QString& step);
    void set_counts(const std::vector<std::string>& names, bool counts, const QString& step);
    void show_sum();

    FitSetup setup_;
    FitGhostModel* model_;
    QTableView* table_;
    QLabel* sum_;
    std::size_t below_noise_ = 0;
    double below_noise_signal_ = 0.0;
};

}  // namespace ghostlight
