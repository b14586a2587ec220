#pragma once

#include <QImage>
#include <QObject>
#include <QPointF>
#include <QString>
#include <QTransform>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/fit/fit_setup.h"
#include "widgets/newest_job.h"

namespace ghostlight {

/// A photograph of a fit as the window shows it.
struct LoadedPhoto {
    std::string file;
    QImage preview;                ///< upright; null where it cannot be read
    QImage mask;                   ///< over it: what does not count
    QTransform to_sensor;          ///< from shares of the upright file to shares of the sensor
    QSize size_px;                 ///< of the file
    std::optional<QPointF> light;  ///< its image, pixels of the upright file
    double field_deg = 0.0;
    QString about;   ///< camera, exposure
    QString masked;  ///< how much does not count, and why
    PhotoNoise noise;
    double saturation = 1.0;  ///< infinite where nothing is clipped
    QString reason;           ///< why it cannot be used; empty where it can
    QStringList notes;
};
using LoadedPhotos = std::shared_ptr<const std::vector<LoadedPhoto>>;

/// What a running fit has come to.
struct FitGlance {
    FitLook look;
    std::vector<double> costs;  ///< of every iteration so far
};

/// Reads photographs and fits lenses to them, each on a thread of its own.
class FitJob : public QObject {
    Q_OBJECT
   public:
    explicit FitJob(QObject* parent = nullptr);
    ~FitJob() override;

    /// Answered by photos_loaded(). `lens` is configured.
    void load(const Prescription& lens, const FitSetup& setup);
    /// Answered by glanced() and progressed(), and at last by finished() or failed().
    void start(const Prescription& lens, const FitSetup& setup);
    void set_paused(bool paused);
    /// At once: the answer, if one was on its way, is dropped. The best iteration so far is kept.
    void cancel();

    bool is_loading() const { return loading_; }
    bool is_running() const { return running_; }
    bool is_paused() const { return paused_; }
    /// A fit that was cancelled has not yet come to its end; another one waits for that.
    bool is_stopping() const { return in_work_ && !running_; }
    /// The iteration of the lowest cost of the fit that runs or ran last; null before the first.
    std::shared_ptr<const FitLook> best() const;

   Q_SIGNALS:
    void photos_loaded(ghostlight::LoadedPhotos photos);
    void progressed(double share);
    /// Which part of the work begins, in words.
    void stage_began(const QString& what);
    /// The fit waits, having been asked to.
    void paused();
    /// A fit has come to its end, also one that was cancelled.
    void ended();
    void glanced(std::shared_ptr<const ghostlight::FitGlance> glance);
    void finished(std::shared_ptr<const ghostlight::FitReport> report);
    void failed(const QString& reason);

   private:
    struct Task {
        Prescription lens;
        FitSetup setup;
        std::uint64_t serial = 0;
    };
    using ReadPhoto = std::shared_ptr<const Photo>;
    ReadPhoto read(const std::string& file);
    void work_on_load(const Task& task, const std::stop_token& stop);
    void work_on_fit(const Task& task, const std::stop_token& stop);
    void look_at(const FitLook& look, const Task& task, const std::stop_token& stop);
    void wait_while_paused(std::unique_lock<std::mutex>& lock, const std::stop_token& stop,
                           std::uint64_t serial);
    /// On this object's thread, unless the fit of that number is no longer wanted.
    template <class What>
    void say(std::uint64_t serial, What what);

    std::uint64_t load_serial_ = 0, fit_serial_ = 0;
    bool loading_ = false, running_ = false;
    std::atomic<bool> in_work_ = false;
    mutable std::mutex mutex_;  ///< of all that follows
    std::condition_variable_any resumed_;
    bool paused_ = false;
    std::shared_ptr<const FitLook> best_;
    std::uint64_t best_of_ = 0;  ///< the fit whose best it is
    struct Kept {
        std::filesystem::file_time_type written;
        ReadPhoto photo;
    };
    std::map<std::string, Kept> kept_;
    // The fit's thread alone has these.
    std::vector<double> costs_;
    std::chrono::steady_clock::time_point glanced_at_{};
    std::unique_ptr<NewestJob<Task>> load_job_, fit_job_;
};

}  // namespace ghostlight
