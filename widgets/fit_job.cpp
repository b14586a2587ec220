#include "widgets/fit_job.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <utility>

#include "core/error.h"
#include "core/fit/light_place.h"
#include "core/io/coating_words.h"
#include "core/io/fit_photos.h"
#include "core/io/photo_file.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "widgets/fit_pictures.h"
#include "widgets/number_text.h"

namespace ghostlight {

namespace {

/// The eye follows no more pictures than this.
constexpr std::chrono::milliseconds between_glances{50};

QString about(const Photo& photo) {
    QStringList parts{QStringLiteral("%1 × %2 px").arg(photo.width_px).arg(photo.height_px)};
    if (!photo.camera.empty()) {
        parts << QString::fromStdString(photo.camera);
    }
    if (photo.f_number) {
        parts << QStringLiteral("f/%1").arg(significant(*photo.f_number, 3));
    }
    if (photo.exposure_s) {
        parts << QStringLiteral("%1 s").arg(significant(*photo.exposure_s, 3));
    }
    return parts.join(QStringLiteral(" · "));
}

/// Where the light's image is in the upright picture.
std::optional<QPointF> light_in(const FitPhoto& photo, const OpticalSystem& system) {
    const auto at = image_of_light(system, photo.light);
    if (!at) {
        return std::nullopt;
    }
    const PhotoPixel pixel = pixel_at(photo, at->x_mm, at->y_mm);
    return QPointF(photo.photo.width_px - pixel.column, pixel.row);
}

/// Upright pictures are mirrored left to right against the sensor's frame.
QTransform to_sensor(const FitPhoto& photo, const Sensor& sensor) {
    const double pitch_mm = photo.place.pitch_mm(photo.photo);
    const double cosine = std::cos(photo.place.rotation_rad),
                 sine = std::sin(photo.place.rotation_rad);
    const double width_mm = pitch_mm * photo.photo.width_px,
                 height_mm = pitch_mm * photo.photo.height_px;
    // Of the upper left corner of the upright picture, from the axis, before the rotation.
    const double x_mm = width_mm - pitch_mm * photo.place.axis_column,
                 y_mm = -pitch_mm * photo.place.axis_row;
    return {cosine * width_mm / sensor.width_mm,
            -sine * width_mm / sensor.height_mm,
            sine * height_mm / sensor.width_mm,
            cosine * height_mm / sensor.height_mm,
            0.5 - (cosine * x_mm - sine * y_mm) / sensor.width_mm,
            0.5 + (sine * x_mm + cosine * y_mm) / sensor.height_mm};
}

/// "4.1 % masked: light 2 %, painted 2.1 %, 3 hot pixels".
QString masked_text(const Photo& photo) {
    const MaskCounts counts = count_masked(photo);
    if (counts.all() == 0) {
        return {};
    }
    const auto share = [&](std::size_t pixels) {
        return significant(
                   100.0 * static_cast<double>(pixels) / static_cast<double>(photo.pixels()), 2) +
               QStringLiteral(" %");
    };
    QStringList parts;
    const auto add = [&](const QString& what, std::size_t pixels) {
        if (pixels > 0) {
            parts << what + ' ' + share(pixels);
        }
    };
    add(QObject::tr("light"), counts.light);
    add(QObject::tr("clipped"), counts.saturated);
    add(QObject::tr("painted"), counts.painted);
    add(QObject::tr("outside of the crop"), counts.cropped);
    add(QObject::tr("no numbers"), counts.not_a_number);
    if (counts.hot > 0) {
        parts << (counts.hot == 1 ? QObject::tr("1 hot pixel")
                                  : QObject::tr("%1 hot pixels").arg(counts.hot));
    }
    return QObject::tr("%1 masked: %2").arg(share(counts.all()), parts.join(", "));
}

}  // namespace

FitJob::FitJob(QObject* parent) : QObject(parent) {
    load_job_ = std::make_unique<NewestJob<Task>>(
        [this](const Task& task, std::stop_token stop) { work_on_load(task, stop); });
    fit_job_ = std::make_unique<NewestJob<Task>>(
        [this](const Task& task, std::stop_token stop) { work_on_fit(task, stop); });
}

FitJob::~FitJob() {
    load_job_->cancel();
    fit_job_->cancel();
}

void FitJob::load(const Prescription& lens, const FitSetup& setup) {
    loading_ = true;
    load_job_->submit({lens, setup, ++load_serial_});
}

void FitJob::start(const Prescription& lens, const FitSetup& setup) {
    running_ = true;
    {
        const std::lock_guard lock(mutex_);
        paused_ = false;
        best_.reset();
        best_of_ = ++fit_serial_;
    }
    fit_job_->submit({lens, setup, fit_serial_});
}

void FitJob::set_paused(bool paused) {
    const std::lock_guard lock(mutex_);
    paused_ = paused;
    resumed_.notify_all();
}

void FitJob::cancel() {
    fit_job_->cancel();  // wakes a fit that waits
    ++fit_serial_;
    running_ = false;
    set_paused(false);
}

std::shared_ptr<const FitLook> FitJob::best() const {
    const std::lock_guard lock(mutex_);
    return best_;
}

FitJob::ReadPhoto FitJob::read(const std::string& file) {
    std::error_code unreadable;
    const auto written = std::filesystem::last_write_time(file, unreadable);
    {
        const std::lock_guard lock(mutex_);
        const auto at = kept_.find(file);
        if (!unreadable && at != kept_.end() && at->second.written == written) {
            return at->second.photo;
        }
    }
    auto photo = std::make_shared<const Photo>(read_photo(file));
    const std::lock_guard lock(mutex_);
    kept_[file] = {written, photo};
    return photo;
}

void FitJob::work_on_load(const Task& task, const std::stop_token& stop) {
    auto photos = std::make_shared<std::vector<LoadedPhoto>>();
    for (const FitPhotoSetup& each : task.setup.photos) {
        if (stop.stop_requested()) {
            return;
        }
        LoadedPhoto& shown = photos->emplace_back();
        shown.file = each.file;
        try {
            const ReadPhoto photo = read(each.file);
            shown.preview = photo_picture(*photo);
            shown.mask = mask_picture(*photo);
            shown.size_px = QSize(photo->width_px, photo->height_px);
            shown.about = about(*photo);
            shown.noise = photo->noise;
            shown.saturation = photo->saturation;
            Notes notes;
            const FitPhoto placed =
                read_fit_photo(each, task.lens, notes, [&](const auto&) { return *photo; });
            shown.mask = mask_picture(placed.photo);
            shown.masked = masked_text(placed.photo);
            shown.noise = placed.photo.noise;
            shown.saturation = placed.photo.saturation;
            shown.to_sensor = to_sensor(placed, task.lens.sensor);
            shown.light = light_in(placed, compile(task.lens, d_line_nm));
            shown.field_deg = placed.light.field_deg;
            for (const Note& note : notes) {
                shown.notes << QString::fromStdString(note.text);
            }
        } catch (const std::exception& error) {
            shown.reason = QString::fromUtf8(error.what());
        }
    }
    {
        const std::lock_guard lock(mutex_);
        std::erase_if(kept_, [&](const auto& kept) {
            return std::ranges::find(task.setup.photos, kept.first, &FitPhotoSetup::file) ==
                   task.setup.photos.end();
        });
    }
    QMetaObject::invokeMethod(
        this,
        [this, photos, serial = task.serial] {
            if (serial == load_serial_) {
                loading_ = false;
                Q_EMIT photos_loaded(photos);
            }
        },
        Qt::QueuedConnection);
}

template <class What>
void FitJob::say(std::uint64_t serial, What what) {
    QMetaObject::invokeMethod(
        this,
        [this, serial, what] {
            if (serial == fit_serial_) {
                what();
            }
        },
        Qt::QueuedConnection);
}

void FitJob::wait_while_paused(std::unique_lock<std::mutex>& lock, const std::stop_token& stop,
                               std::uint64_t serial) {
    if (paused_) {
        say(serial, [this] { Q_EMIT paused(); });
        resumed_.wait(lock, stop, [this] { return !paused_; });
    }
}

void FitJob::look_at(const FitLook& look, const Task& task, const std::stop_token& stop) {
    costs_.push_back(look.cost);
    std::unique_lock lock(mutex_);
    const bool is_best = best_of_ == task.serial && (!best_ || look.cost < best_->cost);
    if (is_best) {
        best_ = std::make_shared<const FitLook>(look);
    }
    const auto now = std::chrono::steady_clock::now();
    if (now - glanced_at_ >= between_glances || paused_) {
        glanced_at_ = now;
        const auto glance = std::make_shared<const FitGlance>(FitGlance{look, costs_});
        say(task.serial, [this, glance] { Q_EMIT glanced(glance); });
    }
    wait_while_paused(lock, stop, task.serial);
}

void FitJob::work_on_fit(const Task& task, const std::stop_token& stop) {
    in_work_ = true;
    costs_.clear();
    const std::uint64_t serial = task.serial;
    const auto wait = [&] {
        std::unique_lock lock(mutex_);
        wait_while_paused(lock, stop, serial);
    };
    const auto began = [&](const QString& what) {
        say(serial, [this, what] { Q_EMIT stage_began(what); });
        wait();
    };
    try {
        FitRequest request = fit_request(task.setup, task.lens);
        request.kinds = parse_kinds(task.setup.kinds);
        request.kind_rows = parse_kind_rows(task.setup.kind_rows, task.lens.surfaces.size());
        began(tr("reading the photographs"));
        Notes notes;
        const std::vector<FitPhoto> photos = read_fit_photos(
            task.setup, task.lens, notes, [this](const auto& file) { return *read(file.string()); },
            stop);
        request.look = [&](const FitLook& look) { look_at(look, task, stop); };
        request.stage = [&](const std::string& what) { began(QString::fromStdString(what)); };
        const auto tell = [&](double share, double) {
            say(serial, [this, share] { Q_EMIT progressed(share); });
            wait();
        };
        const auto report = stop.stop_requested()
                                ? std::nullopt
                                : fit_flare(task.lens, photos, request, stop, tell);
        if (report) {
            const auto shared = std::make_shared<const FitReport>(*report);
            say(serial, [this, shared] {
                running_ = false;
                Q_EMIT finished(shared);
            });
        }
    } catch (const std::exception& error) {
        say(serial, [this, reason = QString::fromUtf8(error.what())] {
            running_ = false;
            Q_EMIT failed(reason);
        });
    }
    in_work_ = false;
    QMetaObject::invokeMethod(
        this, [this] { Q_EMIT ended(); }, Qt::QueuedConnection);
}

}  // namespace ghostlight
