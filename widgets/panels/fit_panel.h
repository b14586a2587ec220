#pragma once

#include <QStringList>
#include <QTimer>
#include <QWidget>

#include <memory>
#include <optional>
#include <vector>

#include "core/fit/fit_setup.h"
#include "widgets/fit_job.h"
#include "widgets/models/fit_parameter_model.h"
#include "widgets/panels/fit_picture_view.h"

class QAbstractButton;
class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QStackedWidget;
class QTableView;
class QToolButton;

namespace ghostlight {

class Actions;
class Document;
class EmptyState;
class FitResults;
class PanelHeader;

/// Fits the lens to photographs of its flare: photographs and the model on the left, what varies in
/// the middle, what the fit says on the right. The set-up is the document's.
class FitPanel : public QWidget {
    Q_OBJECT
   public:
    FitPanel(Document& document, const Actions& actions, QWidget* parent = nullptr);
    ~FitPanel() override;

    /// As one step of the document's history.
    void add_photographs(const QStringList& files);
    /// Writes what "Save Report…" writes; false, with the reason shown, where it cannot.
    bool save_report(const QString& file);

    FitParameterModel& model() { return *model_; }
    QTableView& table() { return *table_; }
    FitPictureView& picture() { return *picture_; }
    FitResults& results() { return *results_; }
    /// "add", "remove", "all_coatings", "vary_marked", "vary_add", "vary_remove", "find", "start", "pause",
    /// "cancel", "apply", "report", and "mode_photograph" … "mode_blink".
    QAbstractButton& button(const QString& name) const;
    QLineEdit& light() { return *light_; }
    QLineEdit& spec() { return *spec_; }
    /// Why something was not taken, or the fit cannot be made; empty otherwise.
    QString reason() const;
    QString state() const;
    const std::optional<FitReport>& report() const { return report_; }
    /// Photographs are read, and no fit runs or is about to.
    bool is_settled() const {
        return !job_->is_loading() && !delay_.isActive() && !job_->is_running() && !wants_start_;
    }
    /// Starts the fit as soon as its photographs are read.
    void start_when_read();
    bool is_running() const { return job_->is_running(); }

   private:
    QWidget* make_photographs();
    QWidget* make_parameters();
    QWidget* make_controls();
    QToolButton* quiet(const QString& name, const QString& text, const QString& tip,
                       bool checkable = false);

    void follow_document();
    void load();
    void edit_setup(const FitSetup& setup, const QString& step);
    void set_parameters(const std::vector<FitParameterModel::Row>& rows, const QString& step);
    void add_spec(const QString& text, const QString& step);
    void set_light_of_shown(const QString& text);
    void show_photograph();
    void show_fitted(const FittedPhoto& photo);
    void show_reason(const QString& reason);
    void show_buttons();
    void take_photos(const LoadedPhotos& photos);
    void take_glance(const FitGlance& glance);
    void take_report(const FitReport& report);
    void start();
    void cancel();
    void apply();
    void drop_result();
    std::size_t shown_photo() const;

    Document& document_;
    PanelHeader* header_;
    EmptyState* empty_;
    QStackedWidget* pages_;
    FitPictureView* picture_;
    QComboBox* photos_;
    QLineEdit* light_;
    QLabel* about_;
    QTableView* table_;
    FitParameterModel* model_;
    QLineEdit* spec_;
    QLineEdit* spectrum_;
    QCheckBox* merge_;
    QCheckBox* suggest_;
    FitResults* results_;
    QLabel* reason_label_;
    QProgressBar* progress_;
    QPushButton *start_, *pause_, *cancel_, *apply_, *save_;
    QTimer delay_;  ///< many changes, one reading

    FitSetup setup_;
    bool setup_is_wrong_ = false;  ///< its variables cannot be read for this lens
    LoadedPhotos loaded_;
    Prescription fitted_lens_;  ///< that the result belongs to, configured
    FitSetup fitted_setup_;
    std::optional<FitReport> report_;
    std::shared_ptr<const FitLook> kept_;  ///< best iteration of a fit that was stopped
    std::optional<FittedPhoto> shown_;     ///< pictures of the fit, of the photograph shown
    std::vector<FittedPhoto> fitted_photos_;
    double share_ = 0.0;
    bool wants_start_ = false;
    std::unique_ptr<FitJob> job_;
};

}  // namespace ghostlight
