#pragma once

#include <QImage>
#include <QObject>
#include <QSize>
#include <QString>

#include <filesystem>
#include <stop_token>
#include <thread>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// Of each half of a thumbnail: the layout above, the flare below.
inline constexpr int thumbnail_width_px = 264, thumbnail_height_px = 132;

/// The lens in section with its direct rays at the field of its flare, drawn by QPainter.
QImage layout_thumbnail(const Prescription& lens, double pixel_ratio);

/// The flare of a light at some 40 % of the field that the sensor sees, auto-exposed.
QImage flare_thumbnail(const Prescription& lens, double pixel_ratio, std::stop_token stop);

/// Makes the flares of lens files one after another, off the GUI thread, and keeps them in a cache
/// folder under a digest of the file, so that they are made once.
class LensThumbnails : public QObject {
    Q_OBJECT
   public:
    /// `cache` empty: nothing is kept.
    LensThumbnails(std::vector<std::filesystem::path> files, const QString& cache,
                   double pixel_ratio, QObject* parent = nullptr);
    ~LensThumbnails() override;

    static QString default_cache();

   Q_SIGNALS:
    void flare_made(int index, const QImage& flare);
    void failed(int index, const QString& reason);
    void finished();

   private:
    void work(const std::stop_token& stop);

    std::vector<std::filesystem::path> files_;
    QString cache_;
    double pixel_ratio_;
    std::jthread thread_;
};

}  // namespace ghostlight
