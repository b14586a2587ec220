#pragma once

#include <memory>
#include <optional>

#include "core/io/accuracy_page.h"
#include "widgets/accuracy_job.h"
#include "widgets/jobs.h"
#include "widgets/panels/paged_panel.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QTableWidget;
class QTabWidget;

namespace ghostlight {

class Actions;
class Document;
class LogChartView;
class PlanPage;

/// Error against time of every method and engine for the lens and light at hand, measured on
/// request, and what the picture on screen leaves out.
class AccuracyPanel : public PagedPanel {
    Q_OBJECT
   public:
    AccuracyPanel(Document& document, const Actions& actions,
                  MakeGlEngine make_gl = offscreen_gl_engine, QWidget* parent = nullptr);
    ~AccuracyPanel() override;

    /// Pictures are told from here; those at rest are reported on while the page is seen.
    void take_picture(const FlarePicture& picture);
    void take_proof(std::shared_ptr<const PlanProof> proof);
    /// Writes accuracy.csv, ghosts.csv, the charts and accuracy.html; false, with the reason
    /// shown, where it cannot.
    bool save(const QString& folder);
    /// Brings the page of what is not computed to the front.
    void show_plan();

    QPushButton& measure_button() { return *measure_; }
    QPushButton& cancel_button() { return *cancel_; }
    QPushButton& save_button() { return *save_; }
    QSpinBox& width_px() { return *width_; }
    QDoubleSpinBox& reference_percent() { return *reference_; }
    QDoubleSpinBox& budget_s() { return *budget_; }
    QCheckBox& with_gl() { return *with_gl_; }
    LogChartView& error_chart() { return *error_chart_; }
    LogChartView& promise_chart() { return *promise_chart_; }
    QTableWidget& table() { return *table_; }
    PlanPage& plan() { return *plan_; }
    QTabWidget& pages() { return *tabs_; }
    bool is_settled() const { return !is_measuring() && !is_reporting(); }
    bool is_measuring() const { return job_->is_measuring(); }
    bool is_reporting() const { return job_->is_reporting(); }
    QString reason() const;
    const std::optional<AccuracyRun>& measured() const { return run_; }

   protected:
    void showEvent(QShowEvent* event) override;

   private:
    QWidget* make_controls();
    void measure();
    void cancel();
    void show_result(const AccuracyResult& result);
    void show_rows();
    void show_reason(const QString& reason);
    void show_buttons();
    void follow_document();
    /// Where the page is seen and its picture is the document's.
    void report_plan(bool measure_error);

    Document& document_;
    QTabWidget* tabs_;
    LogChartView *error_chart_, *promise_chart_;
    QTableWidget* table_;
    PlanPage* plan_;
    QSpinBox* width_;
    QDoubleSpinBox *reference_, *budget_;
    QComboBox* spectrum_;
    QCheckBox* with_gl_;
    QPushButton *measure_, *cancel_, *save_;
    QProgressBar* progress_;
    QLabel* reason_label_;

    std::optional<AccuracyRun> run_;
    AccuracyRun asked_;  ///< what is being measured, without its report
    std::optional<FlarePicture> picture_;
    std::shared_ptr<const PlanProof> proof_;
    std::uint64_t reported_ = 0;  ///< revision that the plan's page is about
    std::unique_ptr<AccuracyJob> job_;
};

}  // namespace ghostlight
