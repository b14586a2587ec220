#include "widgets/fit_job.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "core/error.h"
#include "core/fit/light_place.h"
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
    const double pitch_mm = photo.place.pitch_mm(photo.photo);
    return QPointF(photo.photo.width_px - (photo.place.axis_column + at->x_mm / pitch_mm),
                   photo.place.axis_row + at->y_mm / pitch_mm);
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
            shown.size_px = QSize(photo->width_px, photo->height_px);
            shown.about = about(*photo);
            Notes notes = photo->notes;
            const FitPhoto placed = fit_photo(*photo, each.light, task.lens, notes);
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
        QMetaObject::invokeMethod(
            this,
            [this, glance, serial = task.serial] {
                if (serial == fit_serial_) {
                    Q_EMIT glanced(glance);
                }
            },
            Qt::QueuedConnection);
    }
    resumed_.wait(lock, stop, [this] { return !paused_; });
}

void FitJob::work_on_fit(const Task& task, const std::stop_token& stop) {
    const auto say = [this, serial = task.serial](auto&& what) {
        QMetaObject::invokeMethod(
            this,
            [this, serial, what] {
                if (serial == fit_serial_) {
                    what();
                }
            },
            Qt::QueuedConnection);
    };
    costs_.clear();
    try {
        FitRequest request = fit_request(task.setup, task.lens);
        std::vector<Photo> pictures;
        for (const FitPhotoSetup& each : task.setup.photos) {
            pictures.push_back(*read(each.file));
            if (stop.stop_requested()) {
                return;
            }
        }
        if (task.setup.merge && pictures.size() > 1) {
            pictures.assign(1, merged(pictures));
        }
        std::vector<FitPhoto> photos;
        Notes notes;
        for (std::size_t i = 0; i < pictures.size(); ++i) {
            photos.push_back(
                fit_photo(std::move(pictures[i]), task.setup.photos[i].light, task.lens, notes));
        }
        request.look = [&](const FitLook& look) { look_at(look, task, stop); };
        const auto tell = [&](double share, double) {
            say([this, share] { Q_EMIT progressed(share); });
            std::unique_lock lock(mutex_);
            resumed_.wait(lock, stop, [this] { return !paused_; });
        };
        const auto report = fit_flare(task.lens, photos, request, stop, tell);
        if (report) {
            const auto shared = std::make_shared<const FitReport>(*report);
            say([this, shared] {
                running_ = false;
                Q_EMIT finished(shared);
            });
        }
    } catch (const std::exception& error) {
        say([this, reason = QString::fromUtf8(error.what())] {
            running_ = false;
            Q_EMIT failed(reason);
        });
    }
}

}  // namespace ghostlight
