#include "widgets/lens_thumbnails.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QPainter>
#include <QStandardPaths>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/flare/flare_scene.h"
#include "core/flare/planned_flare.h"
#include "core/flare/scene.h"
#include "core/flare/tone_map.h"
#include "core/io/lens_file.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "render/auto_exposure.h"
#include "widgets/actor_painter.h"
#include "widgets/layout_actors.h"
#include "widgets/layout_scene.h"
#include "widgets/palette.h"
#include "widgets/plane_view.h"
#include "widgets/ray_fan.h"

namespace ghostlight {

namespace {

constexpr double field_share = 0.4;
constexpr int direct_rays = 5;
constexpr double loose_tolerance = 0.05;  // of so small a picture no one sees more
constexpr const char* look = "1";         // another one makes all thumbnails anew

Prescription first_position(const Prescription& lens) {
    return configured(lens, default_scene(lens).configuration);
}

/// Off the axis in the drawing's plane, so that ghosts part.
LightDirection thumbnail_light(const Prescription& configured_lens) {
    const double efl_mm = std::abs(first_order(compile(configured_lens, d_line_nm)).efl_mm);
    const double half_mm = configured_lens.sensor.height_mm / 2.0;
    const double edge = std::isfinite(efl_mm) && efl_mm > 0.0 ? std::atan2(half_mm, efl_mm) : 0.2;
    return {deg_from_rad(edge) * field_share * 2.0, 35.0};
}

QString cache_file(const QString& folder, const std::filesystem::path& path, double pixel_ratio) {
    QFile file(QString::fromStdString(path.string()));
    QCryptographicHash hash(QCryptographicHash::Sha1);
    if (folder.isEmpty() || !file.open(QIODevice::ReadOnly) || !hash.addData(&file)) {
        return {};
    }
    hash.addData(QByteArray(look));
    return QDir(folder).filePath(QString::fromLatin1(hash.result().toHex()) +
                                 QStringLiteral("@%1.png").arg(pixel_ratio));
}

}  // namespace

QImage layout_thumbnail(const Prescription& lens, double pixel_ratio) {
    const Palette& colors = current_palette();
    QImage picture(QSize(thumbnail_width_px, thumbnail_height_px) * pixel_ratio,
                   QImage::Format_RGB32);
    picture.setDevicePixelRatio(pixel_ratio);
    picture.fill(colors.panel);
    const Prescription at = first_position(lens);
    const OpticalSystem system = compile(at, d_line_nm);
    const LightDirection light = thumbnail_light(at);
    const LensDrawing drawing = lens_drawing(at, &system, light);
    const RayFan fan =
        ray_fan(system, GhostPath{}, light.field_deg, direct_rays, drawing.lead_in_mm);

    PlaneView plane;
    const QSizeF size(thumbnail_width_px, thumbnail_height_px);
    plane.set_size(size);
    plane.fit(drawing.box, QMarginsF(10, 10, 10, 10));
    vtkNew<vtkRenderer> renderer;
    LayoutActors actors;
    actors.add_to(renderer);
    actors.show_lens(drawing, colors);
    actors.show_rays({fan}, colors);
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetFocalPoint(plane.center().x, plane.center().y, 0.0);
    camera->SetPosition(plane.center().x, plane.center().y, 50.0);
    camera->SetParallelScale(size.height() / 2.0 * plane.mm_per_px());
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    paint_actors(painter, *renderer, size);
    return picture;
}

QImage flare_thumbnail(const Prescription& lens, double pixel_ratio, std::stop_token stop) {
    const Prescription at = first_position(lens);
    const FlareScene scene = flare_scene(at, default_scene(lens).light().spectrum);
    FlareRequest request;
    request.light = thumbnail_light(at);
    request.tolerance = loose_tolerance;
    request.width_px = static_cast<int>(std::lround(thumbnail_width_px * pixel_ratio));
    request.threads = 1;  // the window's own pictures come first
    const std::optional<FlareImage> image = render_planned(scene, request, std::move(stop));
    if (!image) {
        return {};
    }
    const double exposure_ev = auto_exposure_ev(*image);
    QImage picture(image->width_px, image->height_px, QImage::Format_RGB32);
    const std::vector<float> rgb =
        upright_picture(image->rgb, image->width_px, image->height_px, 3);
    for (int y = 0; y < image->height_px; ++y) {
        auto* line = reinterpret_cast<QRgb*>(picture.scanLine(y));
        for (int x = 0; x < image->width_px; ++x) {
            const auto k =
                3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image->width_px) +
                     static_cast<std::size_t>(x));
            const auto shown = tone_mapped(std::array{rgb[k], rgb[k + 1], rgb[k + 2]}, exposure_ev);
            const auto byte = [](float value) {
                return static_cast<int>(std::lround(255.0F * value));
            };
            line[x] = qRgb(byte(shown[0]), byte(shown[1]), byte(shown[2]));
        }
    }
    picture.setDevicePixelRatio(pixel_ratio);
    return picture;
}

QString LensThumbnails::default_cache() {
    return QStandardPaths::writableLocation(QStandardPaths::CacheLocation) + "/thumbnails";
}

LensThumbnails::LensThumbnails(std::vector<std::filesystem::path> files, const QString& cache,
                               double pixel_ratio, QObject* parent)
    : QObject(parent), files_(std::move(files)), cache_(cache), pixel_ratio_(pixel_ratio) {
    if (!cache_.isEmpty()) {
        QDir().mkpath(cache_);
    }
    thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

LensThumbnails::~LensThumbnails() {
    thread_.request_stop();
    thread_.join();
}

void LensThumbnails::work(const std::stop_token& stop) {
    for (std::size_t k = 0; k < files_.size() && !stop.stop_requested(); ++k) {
        const int index = static_cast<int>(k);
        const QString kept = cache_file(cache_, files_[k], pixel_ratio_);
        QImage flare = kept.isEmpty() ? QImage() : QImage(kept);
        if (!flare.isNull()) {
            flare.setDevicePixelRatio(pixel_ratio_);
            Q_EMIT flare_made(index, flare);
            continue;
        }
        try {
            flare = flare_thumbnail(read_lens(files_[k]).lens, pixel_ratio_, stop);
        } catch (const Error& error) {
            Q_EMIT failed(index, QString::fromUtf8(error.what()));
            continue;
        }
        if (!flare.isNull()) {
            if (!kept.isEmpty()) {
                flare.save(kept);
            }
            Q_EMIT flare_made(index, flare);
        }
    }
    if (!stop.stop_requested()) {
        Q_EMIT finished();
    }
}

}  // namespace ghostlight
