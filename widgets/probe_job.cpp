#include "widgets/probe_job.h"

#include <algorithm>
#include <exception>

#include "core/error.h"

namespace ghostlight {

namespace {

/// As wide as the pictures at rest are.
constexpr int probed_width_px = 1280;

}  // namespace

ProbeJob::ProbeJob(Document& document, QObject* parent) : QObject(parent), document_(document) {
    job_ = std::make_unique<NewestJob<Question>>(
        [this](const Question& question, std::stop_token stop) { work(question, stop); });
}

ProbeJob::~ProbeJob() { job_.reset(); }

void ProbeJob::ask(const Purpose& purpose) {
    if (document_.is_empty()) {
        return;
    }
    const Scene& scene = document_.scene();
    Question question;
    try {
        question.lens = document_.configured_lens();
    } catch (const Error&) {
        return;  // the views say what is wrong with it
    }
    question.request.light = scene.light().direction;
    question.request.spectrum = scene.light().spectrum;
    question.request.tolerance = scene.flare_tolerance;
    question.request.width_px = probed_width_px;
    question.purpose = purpose;
    question.revision = document_.revision();
    job_->submit(std::move(question));
}

void ProbeJob::work(const Question& question, const std::stop_token& stop) {
    try {
        const FlareRequest& wanted = question.request;
        const bool is_known =
            probe_ && probed_lens_ == question.lens && probed_light_ == wanted.light &&
            probed_spectrum_ == wanted.spectrum && probed_tolerance_ == wanted.tolerance;
        if (!is_known) {
            probe_.reset();
            // A cursor that moves on asks again: what is begun for this lens and light is worth
            // ending, and takes as long as a picture.
            probe_ = PixelProbe::make(question.lens, wanted, {});
            probed_lens_ = question.lens;
            probed_light_ = wanted.light;
            probed_spectrum_ = wanted.spectrum;
            probed_tolerance_ = wanted.tolerance;
        }
        if (!probe_ || (stop.stop_requested() && !question.purpose.picks)) {
            return;
        }
        const auto pixel = probe_->at(question.purpose.point_mm.x, question.purpose.point_mm.y);
        if (!pixel) {
            return;
        }
        QMetaObject::invokeMethod(
            this,
            [this, purpose = question.purpose, pixel = *pixel, revision = question.revision] {
                if (revision == document_.revision()) {
                    Q_EMIT answered(purpose, pixel);
                }
            },
            Qt::QueuedConnection);
    } catch (const std::exception&) {
        probe_.reset();  // the picture's own job says why the lens cannot be traced
    }
}

}  // namespace ghostlight
