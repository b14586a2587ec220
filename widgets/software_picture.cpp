#include "widgets/software_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/flare/tone_map.h"
#include "render/flare_renderer.h"

namespace ghostlight {

QImage software_picture(const FlareImage& image, const PictureFrame& frame, QSize size_px,
                        double exposure_ev, const QColor& surround, const QColor& highlight) {
    QImage picture(size_px, QImage::Format_RGB32);
    picture.fill(surround);
    const std::array<float, 3> tint{highlight.redF(), highlight.greenF(), highlight.blueF()};
    const HighlightScale scale = highlight_scale(image.highlight);
    for (int y = 0; y < size_px.height(); ++y) {
        auto* line = reinterpret_cast<QRgb*>(picture.scanLine(y));
        for (int x = 0; x < size_px.width(); ++x) {
            const glm::dvec2 center(x + 0.5, y + 0.5);
            if (!frame.contains(center)) {
                continue;
            }
            const glm::dvec2 point = frame.sensor_from_view(center);
            const int column = std::clamp(
                static_cast<int>((point.x / frame.sensor_width_mm + 0.5) * image.width_px), 0,
                image.width_px - 1);
            const int row = std::clamp(
                static_cast<int>((point.y / frame.sensor_height_mm + 0.5) * image.height_px), 0,
                image.height_px - 1);
            const auto at =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width_px) +
                static_cast<std::size_t>(column);
            const std::array<float, 3> rgb{image.rgb[3 * at], image.rgb[3 * at + 1],
                                           image.rgb[3 * at + 2]};
            std::array<float, 3> shown = tone_mapped(rgb, exposure_ev);
            if (!image.highlight.empty()) {
                const float cover = highlight_tint(image.highlight[at], scale);
                for (std::size_t c = 0; c < 3; ++c) {
                    shown[c] = std::lerp(shown[c], tint[c], cover);
                }
            }
            const auto byte = [](float value) {
                return static_cast<int>(std::lround(255.0F * value));
            };
            line[x] = qRgb(byte(shown[0]), byte(shown[1]), byte(shown[2]));
        }
    }
    return picture;
}

}  // namespace ghostlight
