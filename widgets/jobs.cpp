#include "widgets/jobs.h"

#include <algorithm>
#include <array>
#include <exception>
#include <utility>

#include "core/error.h"
#include "core/flare/first_look.h"

namespace ghostlight {

namespace {

constexpr int table_delay_ms = 200;

/// Coarse pictures, finest first. The one in use follows the time that the last one took.
struct Coarse {
    double tolerance;
    int width_px;
};
constexpr std::array<Coarse, 5> coarse_pictures = {
    {{0.04, 1280}, {0.08, 1280}, {0.12, 960}, {0.2, 640}, {0.3, 480}}};

constexpr double too_slow_ms = 33.0;
constexpr double quick_ms = 12.0;

}  // namespace

Jobs::Jobs(Document& document, Selection& selection, MakeGlEngine make_gl, QObject* parent)
    : QObject(parent),
      document_(document),
      selection_(selection),
      engines_(std::move(make_gl)),
      reported_(engines_.state()) {
    qRegisterMetaType<EngineState>();
    flare_job_ = std::make_unique<NewestJob<Snapshot>>(
        [this](const Snapshot& job, std::stop_token stop) { work_on_flare(job, stop); },
        [this] { engines_.close(); });  // OpenGL's context belongs to that thread
    table_job_ = std::make_unique<NewestJob<Snapshot>>(
        [this](const Snapshot& job, std::stop_token stop) { work_on_table(job, stop); });
    table_delay_.setSingleShot(true);
    table_delay_.setInterval(table_delay_ms);
    connect(&table_delay_, &QTimer::timeout, this, &Jobs::request_table);
    connect(&document_, &Document::opened, this, [this] { awaits_first_look_ = true; });
    connect(&document_, &Document::changed, this, &Jobs::follow_document);
    // Another highlight of the same picture: a coarse one between would only flicker.
    connect(&selection_, &Selection::ghosts_changed, this, [this] { request_flare(false); });
    if (!document_.is_empty()) {
        follow_document();
    }
}

Jobs::~Jobs() {
    flare_job_->cancel();  // both stop at once, not one after the other
    table_job_->cancel();
}

Jobs::Snapshot Jobs::snapshot(std::uint64_t serial) const {
    return {document_.configured_lens(),
            document_.scene(),
            selection_.ghosts(),
            document_.revision(),
            serial,
            document_.changed_at(),
            false,
            awaits_first_look_,
            engine_};
}

void Jobs::set_engine(FlareEngine wish) {
    if (wish != engine_) {
        engine_ = wish;
        request_flare(false);
    }
}

Jobs::TableSubject Jobs::table_subject() const {
    const Scene& scene = document_.scene();
    return {document_.lens(), scene.configuration, scene.light().direction, scene.light().spectrum,
            scene.tolerance};
}

void Jobs::follow_document() {
    request_flare(true);
    TableSubject subject = table_subject();
    const bool is_another_lens = document_.revision() == document_.first_revision();
    if (!is_another_lens && table_subject_ == subject) {
        return;  // layers, gains, other lights
    }
    table_subject_ = std::move(subject);
    table_job_->cancel();
    table_open_ = true;
    table_delay_.start();
}

void Jobs::request_flare(bool coarse_first) {
    if (document_.is_empty()) {
        return;
    }
    flare_open_ = true;
    try {
        Snapshot job = snapshot(++flare_serial_);
        job.coarse_first = coarse_first;
        flare_job_->submit(std::move(job));
    } catch (const Error& error) {  // the configuration is not one of the lens's
        fail(error.what(), flare_serial_, flare_open_, flare_serial_);
    }
}

void Jobs::request_table() {
    try {
        table_job_->submit(snapshot(++table_serial_));
    } catch (const Error& error) {
        fail(error.what(), table_serial_, table_open_, table_serial_);
    }
}

void Jobs::cancel_table() {
    table_delay_.stop();
    table_job_->cancel();
    table_subject_.reset();
    if (table_open_) {
        ++table_serial_;
        Q_EMIT table_cancelled();
        close(table_open_);
    }
}

void Jobs::show(LayeredPicture::Result made, const Snapshot& job, bool is_final,
                bool is_first_look) {
    FlarePicture picture{std::move(made.sum), job.revision,          job.changed_at, is_final,
                         is_first_look,       std::move(made.layers)};
    QMetaObject::invokeMethod(
        this, [this, picture, serial = job.serial] { take_flare(picture, serial); },
        Qt::QueuedConnection);
}

void Jobs::report_engine() {
    if (reported_ == engines_.state()) {
        return;
    }
    reported_ = engines_.state();
    QMetaObject::invokeMethod(
        this, [this, state = reported_] { Q_EMIT engine_changed(state); }, Qt::QueuedConnection);
}

void Jobs::draw_flare(const Snapshot& job, const std::stop_token& stop) {
    const Light& light = job.scene.light();
    FlareRequest request;
    request.light = light.direction;
    request.spectrum = light.spectrum;
    request.highlighted = job.highlighted;
    request.tolerance = job.scene.flare_tolerance;
    request.ringing = job.scene.ringing;
    // Plans of the last picture help the next one of the same light.
    const bool has_one_light = job.scene.lights.size() == 1;
    const DrawGhosts draw_ghosts = [&](const FlareScene& scene, const FlareRequest& wanted,
                                       std::stop_token token) {
        return engines_.draw(scene, wanted, std::move(token));
    };
    const auto draw = [&](const FlareRequest& wanted, const std::stop_token& token, bool is_final) {
        auto made = layered_.make({job.lens, job.scene, wanted, is_final}, draw_ghosts, token);
        if (!made) {
            return 0.0;
        }
        const double took_ms = made->drawing_ms;
        last_plan_ = has_one_light ? std::make_shared<const FlarePlan>(made->sum->plan) : nullptr;
        show(std::move(*made), job, is_final, false);
        return took_ms;
    };
    if (drawn_with_ != job.engine) {
        drawn_with_ = job.engine;
        layered_.forget(LayerKind::ghosts);
    }
    if (job.first_look) {
        last_plan_ = nullptr;
        if (job.scene.layers.shows(LayerKind::ghosts)) {
            const FlareScene& scene = layered_.compiled(job.lens, light.spectrum);
            FlareRequest look = request;
            look.width_px = first_look_width_px;
            if (auto image = render_first_look(scene, look)) {
                show({std::make_shared<const FlareImage>(std::move(*image)), {}, 0.0}, job, false,
                     true);
            }
        }
    }
    engines_.wish(job.engine);
    if (job.coarse_first && !layered_.is_at_rest({job.lens, job.scene, request, true})) {
        FlareRequest rough = request;
        const Coarse& coarse = coarse_pictures[static_cast<std::size_t>(coarseness_)];
        rough.tolerance = coarse.tolerance;
        rough.ringing = false;
        rough.width_px = coarse.width_px;
        rough.search = ProbeSearch::quick;
        rough.nearby = last_plan_;
        rough.turn = ++turn_;
        // Not interrupted: else a light that moves faster than pictures come would show none.
        const double took_ms = draw(rough, {}, false);
        if (took_ms > too_slow_ms) {
            coarseness_ = std::min(coarseness_ + 1, static_cast<int>(coarse_pictures.size()) - 1);
        } else if (took_ms < quick_ms) {
            coarseness_ = std::max(coarseness_ - 1, 0);
        }
    }
    if (!stop.stop_requested()) {
        draw(request, stop, true);
    }
    // Nobody waits now. What OpenGL takes over, it draws at once: so it is seen to work.
    if (job.scene.layers.shows(LayerKind::ghosts) && !stop.stop_requested()) {
        const FlareScene& scene = layered_.compiled(job.lens, light.spectrum);
        if (can_be_planned(scene.system(), request.light) &&
            engines_.settle(scene, request, stop)) {
            layered_.forget(LayerKind::ghosts);
            draw(request, stop, true);
        }
    }
    report_engine();
}

void Jobs::work_on_flare(const Snapshot& job, const std::stop_token& stop) {
    try {
        draw_flare(job, stop);
    } catch (const std::exception& error) {
        QMetaObject::invokeMethod(
            this,
            [this, reason = QString::fromUtf8(error.what()), serial = job.serial] {
                fail(reason, serial, flare_open_, flare_serial_);
            },
            Qt::QueuedConnection);
    }
}

void Jobs::work_on_table(const Snapshot& job, const std::stop_token& stop) {
    GhostTableRequest request;
    request.light = job.scene.light().direction;
    request.spectrum = job.scene.light().spectrum;
    request.tolerance = job.scene.tolerance;
    std::atomic<int> reported_percent{-1};
    const Progress progress = [&](double share) {
        const int percent = static_cast<int>(share * 100.0);
        if (reported_percent.exchange(percent) != percent) {
            QMetaObject::invokeMethod(
                this,
                [this, share, serial = job.serial] {
                    if (serial == table_serial_ && table_open_) {
                        Q_EMIT table_progress(share);
                    }
                },
                Qt::QueuedConnection);
        }
    };
    try {
        std::optional<GhostTable> table = ghost_table(job.lens, request, stop, progress);
        if (!table) {
            return;
        }
        auto shared = std::make_shared<const GhostTable>(std::move(*table));
        QMetaObject::invokeMethod(
            this, [this, shared, serial = job.serial] { take_table(shared, serial); },
            Qt::QueuedConnection);
    } catch (const std::exception& error) {
        QMetaObject::invokeMethod(
            this,
            [this, reason = QString::fromUtf8(error.what()), serial = job.serial] {
                fail(reason, serial, table_open_, table_serial_);
            },
            Qt::QueuedConnection);
    }
}

void Jobs::take_flare(const FlarePicture& picture, std::uint64_t serial) {
    const bool is_newest = serial == flare_serial_;
    if (picture.revision < document_.first_revision() || (picture.is_final && !is_newest)) {
        return;
    }
    awaits_first_look_ = false;
    Q_EMIT flare_ready(picture);
    if (picture.is_final && is_newest && flare_open_) {
        close(flare_open_);
    }
}

void Jobs::take_table(std::shared_ptr<const GhostTable> table, std::uint64_t serial) {
    if (serial == table_serial_ && !table_delay_.isActive()) {
        Q_EMIT table_ready(std::move(table));
        close(table_open_);
    }
}

void Jobs::fail(const QString& reason, std::uint64_t serial, bool& open, std::uint64_t newest) {
    if (serial == newest) {
        table_subject_.reset();  // whatever comes next may try again
        Q_EMIT failed(reason);
        close(open);
    }
}

void Jobs::close(bool& open) {
    open = false;
    if (!is_busy()) {
        Q_EMIT settled();
    }
}

}  // namespace ghostlight
