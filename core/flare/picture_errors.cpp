#include "core/flare/picture_errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ghostlight {
namespace {

constexpr double floor_share = 0.01;  ///< of the truth's mean irradiance

}  // namespace

PictureErrors picture_errors(const std::vector<float>& picture, const std::vector<float>& truth) {
    double light = 0.0, difference = 0.0, total = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const auto a = static_cast<double>(picture[i]), b = static_cast<double>(truth[i]);
        light += b;
        total += a;
        difference += std::abs(a - b);
    }
    PictureErrors errors;
    if (!(light > 0.0)) return errors;
    errors.relative_l1 = difference / light;
    errors.energy = total / light - 1.0;
    const double floor = floor_share * light / static_cast<double>(truth.size());
    std::size_t lit = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const auto a = static_cast<double>(picture[i]), b = static_cast<double>(truth[i]);
        errors.smape += std::abs(a - b) / (a + b + floor);
        if (b < floor) continue;
        errors.log_stops += std::abs(std::log2((a + floor) / (b + floor)));
        ++lit;
    }
    errors.smape /= static_cast<double>(truth.size());
    if (lit > 0) errors.log_stops /= static_cast<double>(lit);
    return errors;
}

PictureMoments picture_moments(const std::vector<float>& irradiance, int width_px,
                               double pitch_mm) {
    PictureMoments moments;
    const auto width = static_cast<std::size_t>(width_px);
    const double height = static_cast<double>(irradiance.size() / width);
    double sum = 0.0, x = 0.0, y = 0.0, r2 = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const auto value = static_cast<double>(irradiance[i]);
        const double at_x = (static_cast<double>(i % width) + 0.5 - 0.5 * width_px) * pitch_mm;
        const double at_y = (static_cast<double>(i / width) + 0.5 - 0.5 * height) * pitch_mm;
        sum += value;
        x += value * at_x;
        y += value * at_y;
        r2 += value * (at_x * at_x + at_y * at_y);
    }
    if (!(sum > 0.0)) return moments;
    moments.flux_mm2 = sum * pitch_mm * pitch_mm;
    moments.x_mm = x / sum;
    moments.y_mm = y / sum;
    moments.rms_radius_mm = std::sqrt(
        std::max(0.0, r2 / sum - moments.x_mm * moments.x_mm - moments.y_mm * moments.y_mm));
    return moments;
}

}  // namespace ghostlight
