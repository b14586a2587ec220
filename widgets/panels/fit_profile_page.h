#pragma once

#include <QWidget>

#include <optional>

#include "core/fit/flare_fit.h"

class QComboBox;
class QLabel;

namespace ghostlight {

class LinePlot;

/// What a profile likelihood and a bootstrap say of each number that they were asked of.
class FitProfilePage : public QWidget {
    Q_OBJECT
   public:
    explicit FitProfilePage(QWidget* parent = nullptr);

    void clear();
    void show_report(const FitReport& report);
    QComboBox& numbers() { return *numbers_; }
    LinePlot& plot() { return *plot_; }
    /// The sentences below the plot.
    QString words() const;

   private:
    void show_number(int index);

    std::optional<FitReport> report_;
    QComboBox* numbers_;
    LinePlot* plot_;
    QLabel* words_;
};

}  // namespace ghostlight
