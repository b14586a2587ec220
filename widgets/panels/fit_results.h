#pragma once

#include <QTabWidget>

#include <memory>
#include <vector>

#include "core/fit/flare_fit.h"

class QComboBox;
class QTextBrowser;

namespace ghostlight {

class CorrelationView;
class FitProfilePage;
class LinePlot;

/// What a fit says: its cost as it goes on, the verdict in words with what is not determined,
/// correlations, and reflectances with their bands.
class FitResults : public QTabWidget {
    Q_OBJECT
   public:
    explicit FitResults(QWidget* parent = nullptr);

    void clear();
    void show_costs(const std::vector<double>& costs);
    void show_report(const FitReport& report);
    /// The verdict with all remarks, as plain text.
    QString words() const;
    LinePlot& costs() { return *costs_; }
    CorrelationView& correlations() { return *correlations_; }
    LinePlot& reflectances() { return *band_; }
    FitProfilePage& profiles() { return *profiles_; }

   private:
    void show_band(int index);
    LinePlot* costs_;
    QTextBrowser* words_;
    CorrelationView* correlations_;
    QComboBox* surfaces_;
    LinePlot* band_;
    FitProfilePage* profiles_;
    std::vector<ReflectanceBand> bands_;
};

}  // namespace ghostlight
