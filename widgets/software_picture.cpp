#include "widgets/software_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ghostlight {

QImage software_picture(const FlareImage& image, const PictureFrame& frame, QSize size_px,
                        const PictureLook& look) {
    const bool is_part = look.from_share > 0.0;
    QImage picture(size_px, is_part ? QImage::Format_ARGB32_Premultiplied : QImage::Format_RGB32);
    const auto byte = [](float value) { return static_cast<int>(std::lround(255.0F * value)); };
    const auto rgb_of = [&](const std::array<float, 3>& color) {
        return qRgb(byte(color[0]), byte(color[1]), byte(color[2]));
    };
    const QRgb surround = rgb_of(look.surround), clipping = rgb_of(look.clipping);
    const auto scale_of_exposure = static_cast<float>(std::exp2(look.exposure_ev));
    const int left = static_cast<int>(std::lround(look.from_share * size_px.width()));
    picture.fill(Qt::transparent);
    const HighlightScale scale = highlight_scale(image.highlight);
    for (int y = 0; y < size_px.height(); ++y) {
        auto* line = reinterpret_cast<QRgb*>(picture.scanLine(y));
        for (int x = left; x < size_px.width(); ++x) {
            const glm::dvec2 center(x + 0.5, y + 0.5);
            line[x] = surround;
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
            const float largest = scale_of_exposure * *std::ranges::max_element(rgb);
            if (look.mark_clipping && !look.false_color && largest > 1.0F && (x + y) % 8 < 4) {
                line[x] = clipping;
                continue;
            }
            std::array<float, 3> shown = shown_color(look, rgb, image.irradiance[at]);
            if (!image.highlight.empty()) {
                const float cover = highlight_tint(image.highlight[at], scale);
                for (std::size_t c = 0; c < 3; ++c) {
                    shown[c] = std::lerp(shown[c], look.highlight[c], cover);
                }
            }
            line[x] = rgb_of(shown);
        }
    }
    return picture;
}

}  // namespace ghostlight
