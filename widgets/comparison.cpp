#include "widgets/comparison.h"

#include <exception>

#include "core/error.h"

namespace ghostlight {

namespace {

/// While a light is dragged A waits: B's pictures come first.
constexpr int delay_ms = 150;

}  // namespace

Comparison::Comparison(Document& document, QObject* parent) : QObject(parent), document_(document) {
    delay_.setSingleShot(true);
    delay_.setInterval(delay_ms);
    connect(&delay_, &QTimer::timeout, this, &Comparison::submit);
    connect(&document_, &Document::changed, this, [this] { follow_document(); });
    connect(&document_, &Document::opened, this, &Comparison::unpin);
    job_ = std::make_unique<NewestJob<Wanted>>(
        [this](const Wanted& wanted, std::stop_token stop) { work(wanted, stop); });
}

Comparison::~Comparison() { job_.reset(); }

void Comparison::pin() {
    if (document_.is_empty()) {
        return;
    }
    pinned_ = document_.state();
    scene_.reset();
    Q_EMIT pinned_changed();
    submit();
}

void Comparison::unpin() {
    if (!pinned_) {
        return;
    }
    pinned_.reset();
    scene_.reset();
    ++serial_;
    open_ = false;
    delay_.stop();
    job_->cancel();
    Q_EMIT pinned_changed();
    Q_EMIT picture_ready(nullptr);
    Q_EMIT table_ready(nullptr);
}

void Comparison::follow_document() {
    if (!pinned_) {
        return;
    }
    const Scene& scene = document_.scene();
    if (!scene_ || scene_->lights != scene.lights || scene_->active_light != scene.active_light ||
        scene_->configuration != scene.configuration || scene_->tolerance != scene.tolerance ||
        scene_->flare_tolerance != scene.flare_tolerance) {
        delay_.start();
    }
}

void Comparison::submit() {
    if (!pinned_) {
        return;
    }
    try {
        Wanted wanted;
        wanted.scene = document_.scene();
        wanted.lens = configured(pinned_->lens, wanted.scene.configuration);
        wanted.serial = ++serial_;
        scene_ = wanted.scene;
        open_ = true;
        job_->submit(std::move(wanted));
    } catch (const Error& error) {  // a configuration that A does not have
        Q_EMIT failed(QString::fromUtf8(error.what()));
        Q_EMIT picture_ready(nullptr);
    }
}

void Comparison::work(const Wanted& wanted, const std::stop_token& stop) {
    const auto tell = [&](auto what) {
        QMetaObject::invokeMethod(
            this,
            [this, what, serial = wanted.serial] {
                if (serial == serial_) {
                    what();
                }
            },
            Qt::QueuedConnection);
    };
    try {
        FlareRequest picture;
        picture.light = wanted.scene.light().direction;
        picture.spectrum = wanted.scene.light().spectrum;
        picture.tolerance = wanted.scene.flare_tolerance;
        auto image = render_flare(wanted.lens, picture, stop);
        if (!image) {
            return;
        }
        tell([this, shared = std::make_shared<const FlareImage>(std::move(*image))] {
            Q_EMIT picture_ready(shared);
        });
        GhostTableRequest request;
        request.light = picture.light;
        request.spectrum = picture.spectrum;
        request.tolerance = wanted.scene.tolerance;
        request.peaks = false;  // fluxes are what is compared
        auto table = ghost_table(wanted.lens, request, stop);
        if (!table) {
            return;
        }
        tell([this, shared = std::make_shared<const GhostTable>(std::move(*table))] {
            open_ = false;
            Q_EMIT table_ready(shared);
        });
    } catch (const std::exception& error) {
        tell([this, reason = QString::fromUtf8(error.what())] {
            open_ = false;
            Q_EMIT failed(reason);
        });
    }
}

}  // namespace ghostlight
