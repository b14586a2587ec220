#include "widgets/accuracy_job.h"

#include <exception>
#include <utility>

namespace ghostlight {

namespace {

/// The reference is finer than the picture by so much.
constexpr double reference_share = 0.1;
/// Of the picture by which OpenGL shows that it can draw this lens.
constexpr double trial_tolerance = 0.1;

}  // namespace

AccuracyJob::AccuracyJob(MakeGlEngine make_gl, QObject* parent)
    : QObject(parent), make_gl_(std::move(make_gl)) {
    job_ = std::make_unique<NewestJob<Task>>(
        [this](const Task& task, std::stop_token stop) { work(task, stop); });
    plan_job_ = std::make_unique<NewestJob<PlanTask>>(
        [this](const PlanTask& task, std::stop_token stop) { work_on_plan(task, stop); });
}

AccuracyJob::~AccuracyJob() {
    job_->cancel();
    plan_job_->cancel();
}

void AccuracyJob::measure(const Prescription& lens, const AccuracyRequest& request, bool with_gl) {
    measuring_ = true;
    job_->submit({lens, request, with_gl, ++serial_});
}

void AccuracyJob::cancel() {
    job_->cancel();
    ++serial_;
    measuring_ = false;
}

void AccuracyJob::report_plan(PlanTask task) {
    reporting_ = true;
    task.serial = ++plan_serial_;
    plan_job_->submit(std::move(task));
}

void AccuracyJob::cancel_plan() {
    plan_job_->cancel();
    ++plan_serial_;
    reporting_ = false;
}

void AccuracyJob::work(const Task& task, const std::stop_token& stop) {
    const auto say = [this, serial = task.serial](auto&& what) {
        QMetaObject::invokeMethod(
            this,
            [this, serial, what] {
                if (serial == serial_) {
                    what();
                }
            },
            Qt::QueuedConnection);
    };
    auto result = std::make_shared<AccuracyResult>();
    AccuracyRequest request = task.request;
    std::optional<GlEngine> gl;  // made, used and destroyed on this thread
    if (task.with_gl) {
        try {
            say([this] { Q_EMIT progressed(0.0, tr("OpenGL")); });
            gl = make_gl_();
            FlareRequest trial;
            trial.light = request.light;
            trial.spectrum = request.spectrum;
            trial.width_px = request.width_px;
            trial.tolerance = trial_tolerance;
            if (!gl->draw(flare_scene(task.lens, request.spectrum), trial, stop)) {
                return;
            }
            request.engines.push_back({.name = "OpenGL", .draw = gl->draw});
            result->renderer = gl->renderer;
        } catch (const std::exception& error) {
            gl.reset();
            result->without_gl = QString::fromUtf8(error.what());
        }
    }
    try {
        auto report =
            measure_accuracy(task.lens, request, stop, [&](double share, const std::string& what) {
                say([this, share, what = QString::fromStdString(what)] {
                    Q_EMIT progressed(share, what);
                });
            });
        if (report) {
            result->report = std::move(*report);
            say([this, result] {
                measuring_ = false;
                Q_EMIT measured(result);
            });
        }
    } catch (const std::exception& error) {
        say([this, reason = QString::fromUtf8(error.what())] {
            measuring_ = false;
            Q_EMIT failed(reason);
        });
    }
}

void AccuracyJob::work_on_plan(const PlanTask& task, const std::stop_token& stop) {
    const auto say = [this, serial = task.serial](auto&& what) {
        QMetaObject::invokeMethod(
            this,
            [this, serial, what] {
                if (serial == plan_serial_) {
                    what();
                }
            },
            Qt::QueuedConnection);
    };
    try {
        const FlareScene scene = flare_scene(task.lens, task.request.spectrum);
        const auto report = std::make_shared<const PlanReport>(
            plan_report(scene, task.request, task.image->plan, task.proof.get()));
        say([this, report, is_last = !task.measure_error] {
            reporting_ = reporting_ && !is_last;
            Q_EMIT planned(report);
        });
        if (!task.measure_error) {
            return;
        }
        const auto error = measure_plan(
            task.lens, task.request, *task.image, reference_share * task.request.tolerance, stop,
            [&](double share) { say([this, share] { Q_EMIT error_progressed(share); }); });
        if (error) {
            say([this, error = *error] {
                reporting_ = false;
                Q_EMIT error_measured(error);
            });
        }
    } catch (const std::exception& error) {
        say([this, reason = QString::fromUtf8(error.what())] {
            reporting_ = false;
            Q_EMIT plan_failed(reason);
        });
    }
}

}  // namespace ghostlight
