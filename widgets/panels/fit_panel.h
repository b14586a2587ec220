#pragma once

#include <QStringList>
#include <QTimer>

#include <memory>
#include <optional>
#include <vector>

#include "core/fit/fit_setup.h"
#include "widgets/fit_job.h"
#include "widgets/models/fit_parameter_model.h"
#include "widgets/panels/fit_picture_view.h"
#include "widgets/panels/paged_panel.h"

class QAbstractButton;
class QLineEdit;
class QTableView;

namespace ghostlight {

class Document;
class FitControls;
class FitPhotographs;
class FitResults;
class FitVariables;

/// Fits the lens to photographs of its flare: photographs and the model on the left, what varies in
/// the middle, what the fit says on the right. The set-up is the document's.
class FitPanel : public PagedPanel {
    Q_OBJECT
   public:
    FitPanel(Document& document, const Actions& actions, QWidget* parent = nullptr);
    ~FitPanel() override;

    /// As one step of the document's history.
    void add_photographs(const QStringList& files);
    /// Writes what "Save Report…" writes; false, with the reason shown, where it cannot.
    bool save_report(const QString& file);

    FitPhotographs& photographs() { return *photographs_; }
    FitVariables& variables() { return *variables_; }
    FitResults& results() { return *results_; }
    FitParameterModel& model();
    QTableView& table();
    FitPictureView& picture();
    QLineEdit& light();
    QLineEdit& spec();
    /// "add", "remove", "all_coatings", "vary_marked", "vary_add", "vary_remove", "find", "mask",
    /// "details", "ghosts_leave", "ghosts_only", "ghosts_all", "start", "pause", "cancel", "apply",
    /// "report", "mode_photograph" … "mode_blink", and "tool_light" … "tool_crop".
    QAbstractButton& button(const QString& name) const;
    /// Why something was not taken, or the fit cannot be made; empty otherwise.
    QString reason() const;
    const std::optional<FitReport>& report() const { return report_; }
    /// Photographs are read, and no fit runs or is about to.
    bool is_settled() const {
        return !job_->is_loading() && !delay_.isActive() && !job_->is_running() && !wants_start_;
    }
    /// Starts the fit as soon as its photographs are read.
    void start_when_read();
    bool is_running() const { return job_->is_running(); }

   private:
    void connect_parts();
    void connect_job();
    void follow_document();
    void load();
    void edit_setup(const FitSetup& setup, const QString& step);
    void show_reason(const QString& reason);
    void show_state();
    void take_photos(const LoadedPhotos& photos);
    void take_glance(const FitGlance& glance);
    void take_report(const FitReport& report);
    void start();
    void cancel();
    void apply();
    void drop_result();

    Document& document_;
    FitPhotographs* photographs_;
    FitVariables* variables_;
    FitResults* results_;
    FitControls* controls_;
    QTimer delay_;  ///< many changes, one reading

    FitSetup setup_;
    bool setup_is_wrong_ = false;  ///< its variables cannot be read for this lens
    LoadedPhotos loaded_;
    Prescription fitted_lens_;  ///< that the result belongs to, configured
    FitSetup fitted_setup_;
    std::optional<FitReport> report_;
    std::shared_ptr<const FitLook> kept_;  ///< best iteration of a fit that was stopped
    double share_ = 0.0;
    bool is_paused_ = false;  ///< it waits, and is not merely asked to
    bool was_stopped_ = false, has_failed_ = false;
    QString stage_;
    bool wants_start_ = false;
    std::unique_ptr<FitJob> job_;
};

}  // namespace ghostlight
