#include "widgets/panels/stop_pictures.h"

#include <QCoreApplication>

#include <cmath>
#include <exception>
#include <vector>

#include "core/flare/mask_raster.h"
#include "core/flare/starburst.h"
#include "core/flare/tone_map.h"
#include "core/optics/optical_system.h"
#include "core/units.h"
#include "render/auto_exposure.h"
#include "widgets/number_text.h"
#include "widgets/panels/stop_statistics.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct StopPanelPictures {
    Q_DECLARE_TR_FUNCTIONS(StopPanel)
};

/// The starburst is shown on this much of the sensor's width, about the axis.
constexpr double shown_share = 1.0 / 6.0;
constexpr double starburst_exposure_share = 0.004;

QImage opening_picture(const OpticalSystem& system, const StopDirt& dirt) {
    const MaskRaster raster = mask_raster(system.stop_mask, dirt, stop_picture_px);
    QImage picture(stop_picture_px, stop_picture_px, QImage::Format_Grayscale8);
    for (int y = 0; y < stop_picture_px; ++y) {
        uchar* line = picture.scanLine(y);
        for (int x = 0; x < stop_picture_px; ++x) {
            const auto at =
                static_cast<std::size_t>((stop_picture_px - 1 - y) * stop_picture_px + x);
            line[x] = static_cast<uchar>(std::lround(255.0F * srgb_encoded(raster.open[at])));
        }
    }
    return picture;
}

QImage starburst_picture(const FlareImage& image) {
    const double exposure_ev = auto_exposure_ev(image, starburst_exposure_share);
    const std::vector<float> rgb = upright_picture(image.rgb, image.width_px, image.height_px, 3);
    QImage picture(image.width_px, image.height_px, QImage::Format_RGB32);
    for (int y = 0; y < image.height_px; ++y) {
        auto* line = reinterpret_cast<QRgb*>(picture.scanLine(y));
        for (int x = 0; x < image.width_px; ++x) {
            const auto at = 3 * static_cast<std::size_t>(y * image.width_px + x);
            const auto shown = tone_mapped({rgb[at], rgb[at + 1], rgb[at + 2]}, exposure_ev);
            const auto byte = [](float value) {
                return static_cast<int>(std::lround(255 * value));
            };
            line[x] = qRgb(byte(shown[0]), byte(shown[1]), byte(shown[2]));
        }
    }
    return picture;
}

}  // namespace

std::optional<StopPictures> stop_pictures(const Prescription& lens, const Spectrum& spectrum,
                                          const std::stop_token& stop) {
    StopPictures shown;
    try {
        const OpticalSystem system = compile(lens, d_line_nm);
        shown.opening = opening_picture(system, lens.stop.dirt);
        const double share = clear_share(system.stop_mask, lens.stop.dirt);
        shown.state =
            QStringLiteral("⌀ %1 mm").arg(significant(2.0 * system.stop_mask.semi_diameter_mm, 4));
        if (share < 1.0) {
            shown.state +=
                StopPanelPictures::tr(" · %1 % clear").arg(significant(100.0 * share, 4));
        }
        shown.statistics = stop_statistics(lens.stop, system);
        StarburstRequest wanted;
        wanted.light = {0.0, 90.0};
        wanted.spectrum = spectrum;
        wanted.width_px = stop_picture_px;
        Prescription near_axis = lens;
        near_axis.sensor.width_mm *= shown_share;
        near_axis.sensor.height_mm = near_axis.sensor.width_mm;
        const auto image = render_starburst(near_axis, wanted, stop);
        if (!image) {
            return std::nullopt;
        }
        shown.starburst = starburst_picture(*image);
    } catch (const std::exception& error) {
        shown.reason = QString::fromUtf8(error.what());
    }
    return shown;
}

}  // namespace ghostlight
