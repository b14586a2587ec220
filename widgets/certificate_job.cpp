#include "widgets/certificate_job.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/flare/flare_scene.h"
#include "core/parallel.h"

namespace ghostlight {

namespace {

constexpr int rest_ms = 1000;
/// Each round takes so many times the cells of the last, up to a limit.
constexpr std::size_t more_cells = 4;
constexpr std::size_t most_cells = 16'000;

}  // namespace

CertificateJob::CertificateJob(Document& document, Jobs& jobs, QObject* parent)
    : QObject(parent), document_(document), jobs_(jobs) {
    job_ = std::make_unique<NewestJob<Task>>(
        [this](const Task& task, std::stop_token stop) { work(task, stop); });
    rest_.setSingleShot(true);
    rest_.setInterval(rest_ms);
    connect(&rest_, &QTimer::timeout, this, &CertificateJob::begin);
    connect(&document_, &Document::changed, this, &CertificateJob::withdraw);
    connect(&jobs_, &Jobs::flare_ready, this, &CertificateJob::take_picture);
    connect(&jobs_, &Jobs::settled, this, [this] {
        if (image_ != nullptr && !is_busy_) {
            is_busy_ = true;
            rest_.start();
        }
    });
}

CertificateJob::~CertificateJob() { job_->cancel(); }

void CertificateJob::take_picture(const FlarePicture& picture) {
    const bool is_present = picture.is_final && picture.revision == document_.revision();
    if (is_present && has_plain_ghosts(document_.scene()) && !picture.image->plan.ghosts.empty() &&
        picture.revision != revision_) {
        image_ = picture.image;
        revision_ = picture.revision;
    }
}

void CertificateJob::begin() {
    const std::shared_ptr<const FlareImage> image = std::exchange(image_, nullptr);
    if (image != nullptr) {
        job_->submit(
            {document_.configured_lens(), document_.scene(), image->plan, document_.revision()});
    }
}

void CertificateJob::withdraw() {
    rest_.stop();
    job_->cancel();
    image_ = nullptr;
    is_busy_ = false;
    Q_EMIT withdrawn();
}

void CertificateJob::work(const Task& task, const std::stop_token& stop) {
    const auto say = [this, revision = task.revision](auto&& what) {
        QMetaObject::invokeMethod(
            this,
            [this, revision, what] {
                if (revision == document_.revision()) {
                    what();
                }
            },
            Qt::QueuedConnection);
    };
    try {
        // Half of the cores: what the hand does next finds the others free.
        PlanProofRequest request;
        request.threads = std::max(1U, default_thread_count() / 2);
        const FlareScene scene = flare_scene(task.lens, task.scene.light().spectrum,
                                             FlareScene::usual_samples, request.threads);
        std::atomic<int> reported_percent{-1};
        const auto progress = [&](double share) {
            const int percent = static_cast<int>(share * 100.0);
            if (reported_percent.exchange(percent) != percent) {
                say([this, share] { Q_EMIT progressed(share); });
            }
        };
        for (bool is_last = false; !is_last; request.most_cells *= more_cells) {
            auto proof =
                certify(scene, task.scene.light().direction, task.plan, request, stop, progress);
            if (!proof) {
                return;
            }
            is_last = proof->certified == proof->ghosts.size() || request.most_cells >= most_cells;
            const auto shared = std::make_shared<const PlanProof>(std::move(*proof));
            say([this, shared, is_last] {
                is_busy_ = !is_last;
                Q_EMIT certified(shared);
            });
        }
    } catch (const std::exception&) {
        // A lens that drew can be compiled; should it not, nothing is claimed.
        say([this] { withdraw(); });
    }
}

}  // namespace ghostlight
