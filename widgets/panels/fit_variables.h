#pragma once

#include <QWidget>

#include <vector>

#include "core/fit/fit_setup.h"
#include "widgets/models/fit_parameter_model.h"

class QCheckBox;
class QComboBox;
class QHBoxLayout;
class QLineEdit;
class QSpinBox;
class QTableView;
class QTabWidget;
class QToolButton;
class QVBoxLayout;

namespace ghostlight {

class FitGhostPage;

/// What a fit varies, by which ghosts, light and loss.
class FitVariables : public QWidget {
    Q_OBJECT
   public:
    explicit FitVariables(QWidget* parent = nullptr);

    /// `lens` is configured. Throws Error where the set-up's words cannot be read for this lens.
    void set_setup(const FitSetup& setup, const Prescription& lens);
    void set_numbers(const std::vector<FittedNumber>& numbers, bool have_errors);
    void set_report(const FitReport* report);

    FitParameterModel& model() { return *model_; }
    QTableView& table() { return *table_; }
    QLineEdit& spec() { return *spec_; }
    FitGhostPage& ghosts() { return *ghosts_; }
    QTabWidget& pages() { return *pages_; }
    QComboBox& loss() { return *loss_; }
    QLineEdit& loss_scale() { return *loss_scale_; }
    QSpinBox& bootstrap() { return *bootstrap_; }

   Q_SIGNALS:
    void edited(const ghostlight::FitSetup& setup, const QString& step);
    void refused(const QString& reason);

   private:
    QHBoxLayout* make_add();
    QVBoxLayout* make_more();
    QHBoxLayout* make_kinds();
    void add_spec(const QString& text, const QString& step);
    void add_all_coatings();
    void add_marked();
    void set_rows(const std::vector<FitParameterModel::Row>& rows, const QString& step);
    /// A change of the set-up by what is typed; refused where it cannot be taken.
    template <class Change>
    void change(const QString& step, const Change& change);
    void profile_chosen();
    void show_columns();

    FitSetup setup_;
    Prescription lens_;
    QTabWidget* pages_;
    FitParameterModel* model_;
    QTableView* table_;
    QLineEdit *spec_ = nullptr, *spectrum_ = nullptr, *loss_scale_ = nullptr, *kinds_ = nullptr,
              *kind_rows_ = nullptr;
    QComboBox* loss_ = nullptr;
    QCheckBox *merge_ = nullptr, *suggest_ = nullptr;
    QSpinBox* bootstrap_ = nullptr;
    FitGhostPage* ghosts_;
};

}  // namespace ghostlight
