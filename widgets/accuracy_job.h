#pragma once

#include <QObject>
#include <QString>

#include <cstdint>
#include <memory>
#include <optional>

#include "core/flare/accuracy.h"
#include "core/flare/plan_report.h"
#include "render/gl_flare/gl_engine.h"
#include "widgets/newest_job.h"

namespace ghostlight {

/// What was measured, of what, and by which engines.
struct AccuracyResult {
    AccuracyReport report;
    std::string renderer;  ///< OpenGL's name of itself; empty where it took no part
    QString without_gl;    ///< why it took no part
};

/// Measures errors against times, what a plan leaves out, and a picture's true error, off the GUI
/// thread. Every call replaces the one before of its kind.
class AccuracyJob : public QObject {
    Q_OBJECT
   public:
    explicit AccuracyJob(MakeGlEngine make_gl, QObject* parent = nullptr);
    ~AccuracyJob() override;

    /// Answered by measured() or failed(). `lens` is configured.
    void measure(const Prescription& lens, const AccuracyRequest& request, bool with_gl);
    void cancel();
    bool is_measuring() const { return measuring_; }

    /// Answered by planned(), and with `measure_error` by error_measured().
    struct PlanTask {
        Prescription lens;
        FlareRequest request;
        std::shared_ptr<const FlareImage> image;
        std::shared_ptr<const PlanProof> proof;
        bool measure_error = false;
        std::uint64_t serial = 0;
    };
    void report_plan(PlanTask task);
    void cancel_plan();
    bool is_reporting() const { return reporting_; }

   Q_SIGNALS:
    void progressed(double share, const QString& what);
    void measured(std::shared_ptr<const ghostlight::AccuracyResult> result);
    void failed(const QString& reason);
    void planned(std::shared_ptr<const ghostlight::PlanReport> report);
    void error_progressed(double share);
    void error_measured(const ghostlight::MeasuredPlan& error);
    void plan_failed(const QString& reason);

   private:
    struct Task {
        Prescription lens;
        AccuracyRequest request;
        bool with_gl = true;
        std::uint64_t serial = 0;
    };
    void work(const Task& task, const std::stop_token& stop);
    void work_on_plan(const PlanTask& task, const std::stop_token& stop);

    MakeGlEngine make_gl_;
    std::uint64_t serial_ = 0, plan_serial_ = 0;
    bool measuring_ = false, reporting_ = false;
    std::unique_ptr<NewestJob<Task>> job_;
    std::unique_ptr<NewestJob<PlanTask>> plan_job_;
};

}  // namespace ghostlight
