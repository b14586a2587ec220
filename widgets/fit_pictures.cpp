#include "widgets/fit_pictures.h"

#include <algorithm>
#include <cmath>

#include "core/flare/flare_image.h"
#include "core/flare/tone_map.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr double shown_sigmas = 5.0;
/// Where the brightest share of a picture comes to lie, display-linear.
constexpr double bright_level = 0.8;

double exposure_ev(std::vector<float> levels, double bright_share) {
    if (levels.empty()) {
        return 0.0;
    }
    const auto at =
        levels.begin() +
        static_cast<std::ptrdiff_t>((1.0 - bright_share) * static_cast<double>(levels.size() - 1));
    std::ranges::nth_element(levels, at);
    return *at > 0.0F ? std::log2(bright_level / static_cast<double>(*at)) : 0.0;
}

int byte_of(float value) { return static_cast<int>(std::lround(255.0F * value)); }

QImage upright_image(const std::vector<float>& rgb, int width, int height, double ev) {
    const std::vector<float> upright = upright_picture(rgb, width, height, 3);
    QImage image(width, height, QImage::Format_RGB32);
    for (int y = 0; y < height; ++y) {
        auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
        for (int x = 0; x < width; ++x) {
            const auto at = 3 * static_cast<std::size_t>(y * width + x);
            const auto shown = tone_mapped({upright[at], upright[at + 1], upright[at + 2]}, ev);
            line[x] = qRgb(byte_of(shown[0]), byte_of(shown[1]), byte_of(shown[2]));
        }
    }
    return image;
}

int pixels_per_preview(const Photo& photo) {
    return std::max(1, (photo.width_px + preview_width_px - 1) / preview_width_px);
}

/// Over any picture, in either theme.
QRgb color_of(char reason) {
    const Palette colors = dark_palette();
    const auto tinted = [](QColor color) {
        constexpr int alpha = 110;
        color.setAlpha(alpha);
        return qPremultiply(color.rgba());
    };
    switch (reason) {
        case mask_reason::painted:
            return tinted(colors.amber);
        case mask_reason::light:
            return tinted(colors.teal);
        case mask_reason::cropped:
            return qRgba(0, 0, 0, 170);
        default:
            return tinted(colors.red_orange);
    }
}

}  // namespace

QImage mask_picture(const Photo& photo) {
    const int by = pixels_per_preview(photo);
    const int width = photo.width_px / by, height = photo.height_px / by;
    if (width == 0 || height == 0 || photo.masked.size() != photo.pixels()) {
        return {};
    }
    QImage image(width, height, QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::transparent);
    for (int y = 0; y < height * by; ++y) {
        auto* line = reinterpret_cast<QRgb*>(image.scanLine(y / by));
        for (int x = 0; x < width * by; ++x) {
            // Upright pictures are mirrored left to right against the sensor's frame.
            const char reason =
                photo
                    .masked[static_cast<std::size_t>(y) * static_cast<std::size_t>(photo.width_px) +
                            static_cast<std::size_t>(photo.width_px - 1 - x)];
            if (reason != 0) {
                line[x / by] = color_of(reason);
            }
        }
    }
    return image;
}

QImage photo_picture(const Photo& photo) {
    const int by = pixels_per_preview(photo);
    const int width = photo.width_px / by, height = photo.height_px / by;
    if (width == 0 || height == 0) {
        return {};
    }
    std::vector<float> rgb(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::vector<float> levels;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float sum[3] = {0, 0, 0};
            bool is_masked = false;
            for (int v = 0; v < by; ++v) {
                for (int u = 0; u < by; ++u) {
                    const int column = x * by + u, row = y * by + v;
                    const float* at = photo.at(column, row);
                    for (int c = 0; c < 3; ++c) {
                        sum[c] += std::isfinite(at[c]) ? at[c] : 0.0F;
                    }
                    is_masked =
                        is_masked || photo.masked[static_cast<std::size_t>(row) *
                                                      static_cast<std::size_t>(photo.width_px) +
                                                  static_cast<std::size_t>(column)] != 0;
                }
            }
            float* to = &rgb[3 * static_cast<std::size_t>(y * width + x)];
            float most = 0.0F;
            for (int c = 0; c < 3; ++c) {
                to[c] = sum[c] / static_cast<float>(by * by);
                most = std::max(most, to[c]);
            }
            if (!is_masked) {
                levels.push_back(most);
            }
        }
    }
    return upright_image(rgb, width, height, exposure_ev(std::move(levels), 0.005));
}

double fit_exposure_ev(const FittedPhoto& photo) {
    std::vector<float> levels;
    for (std::size_t s = 0; s < photo.used.size(); ++s) {
        if (photo.used[s] != 0) {
            levels.push_back(static_cast<float>(std::max(
                {photo.measured[3 * s], photo.measured[3 * s + 1], photo.measured[3 * s + 2]})));
        }
    }
    return exposure_ev(std::move(levels), 0.01);
}

QImage fit_picture(const FittedPhoto& photo, const std::vector<double>& values, double ev) {
    if (values.size() != 3 * photo.used.size() || values.empty()) {
        return {};
    }
    std::vector<float> rgb(values.size(), 0.0F);
    for (std::size_t s = 0; s < photo.used.size(); ++s) {
        for (std::size_t c = 0; c < 3 && photo.used[s] != 0; ++c) {
            rgb[3 * s + c] = static_cast<float>(values[3 * s + c]);
        }
    }
    return upright_image(rgb, photo.frame.width_px, photo.frame.height_px, ev);
}

QImage residual_picture(const FittedPhoto& photo) {
    if (photo.residuals.size() != 3 * photo.used.size() || photo.used.empty()) {
        return {};
    }
    std::vector<float> mean(photo.used.size(), 0.0F);
    for (std::size_t s = 0; s < photo.used.size(); ++s) {
        if (photo.used[s] != 0) {
            mean[s] = static_cast<float>(
                (photo.residuals[3 * s] + photo.residuals[3 * s + 1] + photo.residuals[3 * s + 2]) /
                3.0 / shown_sigmas);
        }
    }
    const int width = photo.frame.width_px, height = photo.frame.height_px;
    const std::vector<float> upright = upright_picture(mean, width, height, 1);
    QImage image(width, height, QImage::Format_RGB32);
    for (int y = 0; y < height; ++y) {
        auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
        for (int x = 0; x < width; ++x) {
            const float v =
                std::clamp(upright[static_cast<std::size_t>(y * width + x)], -1.0F, 1.0F);
            line[x] = v > 0.0F ? qRgb(byte_of(v), byte_of(0.25F * v), byte_of(0.15F * v))
                               : qRgb(byte_of(-0.15F * v), byte_of(-0.45F * v), byte_of(-v));
        }
    }
    return image;
}

}  // namespace ghostlight
