#include "core/fit/fit_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ghostlight {
namespace {

constexpr double least_pixels_per_sample = 2.0;
/// A sample may have so much of its weight in masked pixels (hot ones); the rest stands for all.
constexpr double most_masked = 0.03;

}  // namespace

double spline(double t) {
    const double a = std::abs(t);
    if (a <= 0.5) return 0.75 - a * a;
    if (a >= 1.5) return 0.0;
    return 0.5 * (1.5 - a) * (1.5 - a);
}

double spline_slope(double t) {
    const double a = std::abs(t);
    if (a <= 0.5) return -2.0 * t;
    if (a >= 1.5) return 0.0;
    return t > 0.0 ? a - 1.5 : 1.5 - a;
}

double spline_correlation(int lag) {
    switch (std::abs(lag)) {
        case 0:
            return 1.0;
        case 1:
            return 26.0 / 66.0;
        case 2:
            return 1.0 / 66.0;
        default:
            return 0.0;
    }
}

double shared_noise() {
    const double along = 1.0 + 2.0 * (spline_correlation(1) + spline_correlation(2));
    return along * along;
}

FitData fit_data(const Photo& photo, const PhotoPlace& place, double sensor_width_mm,
                 double sensor_height_mm, int across) {
    const double pitch_mm = place.pitch_mm(photo);
    const int most = static_cast<int>(sensor_width_mm / (least_pixels_per_sample * pitch_mm));
    if (most < 16)
        throw Error({.problem = "the photograph is too small for a fit",
                     .file = photo.file,
                     .where = {},
                     .found = fmt::format("{} x {} pixels", photo.width_px, photo.height_px),
                     .expected = "at least 32 pixels across the sensor's width"});
    FitData data;
    data.frame = pixel_frame(sensor_width_mm, sensor_height_mm, std::min(across, most));
    data.noise = photo.noise;
    const auto samples = static_cast<std::size_t>(data.frame.width_px) *
                         static_cast<std::size_t>(data.frame.height_px);
    data.value.assign(3 * samples, 0.0);
    std::vector<double> weight(samples, 0.0), squares(samples, 0.0), whole(samples, 0.0);
    const double cosine = std::cos(place.rotation_rad), sine = std::sin(place.rotation_rad);
    for (int row = 0; row < photo.height_px; ++row)
        for (int column = 0; column < photo.width_px; ++column) {
            const double px = (column + 0.5 - place.axis_column) * pitch_mm,
                         py = (row + 0.5 - place.axis_row) * pitch_mm;
            const double x = data.frame.column(cosine * px - sine * py),
                         y = data.frame.row(sine * px + cosine * py);
            const std::size_t pixel =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(photo.width_px) +
                static_cast<std::size_t>(column);
            const bool masked = !photo.masked.empty() && photo.masked[pixel];
            const float* rgb = &photo.rgb[3 * pixel];
            for (int j = static_cast<int>(std::ceil(y - 2.0)); j <= static_cast<int>(y + 1.0);
                 ++j) {
                if (j < 0 || j >= data.frame.height_px) continue;
                const double wy = spline(y - (j + 0.5));
                if (wy == 0.0) continue;
                for (int i = static_cast<int>(std::ceil(x - 2.0)); i <= static_cast<int>(x + 1.0);
                     ++i) {
                    if (i < 0 || i >= data.frame.width_px) continue;
                    const double w = wy * spline(x - (i + 0.5));
                    if (w == 0.0) continue;
                    const std::size_t s = static_cast<std::size_t>(j) *
                                              static_cast<std::size_t>(data.frame.width_px) +
                                          static_cast<std::size_t>(i);
                    whole[s] += w;
                    if (masked) continue;
                    weight[s] += w;
                    squares[s] += w * w;
                    for (std::size_t c = 0; c < 3; ++c)
                        data.value[3 * s + c] += w * static_cast<double>(rgb[c]);
                }
            }
        }
    data.used.assign(samples, 0);
    data.inverse_count.assign(samples, 1.0);
    // Σ w over pixels of a sample that lies wholly inside the picture.
    const double full = std::pow(data.frame.pitch_mm / pitch_mm, 2);
    for (std::size_t s = 0; s < samples; ++s) {
        if (weight[s] > 0.0) {
            for (std::size_t c = 0; c < 3; ++c) data.value[3 * s + c] /= weight[s];
            data.inverse_count[s] = squares[s] / (weight[s] * weight[s]);
        }
        // Sampling the spline at the pixels' middles makes up to a percent of its sum.
        const bool inside = whole[s] > 0.98 * full;
        if (inside && weight[s] >= (1.0 - most_masked) * whole[s]) {
            data.used[s] = 1;
            ++data.count;
        }
    }
    if (data.count < 50)
        throw Error({.problem = "too little of the photograph can be used",
                     .file = photo.file,
                     .where = {},
                     .found = fmt::format("{} of {} samples are neither masked, saturated nor "
                                          "outside of the sensor",
                                          data.count, samples),
                     .expected = "a shorter exposure, or a smaller mask"});
    return data;
}

StableScale stable_scale(const FitData& data, std::size_t sample, double model_error, double dim) {
    const double shot = data.inverse_count[sample] * data.noise.shot, of_model = model_error * dim;
    return {.shot = shot,
            .read = std::max({data.inverse_count[sample] * data.noise.read, shot * shot,
                              of_model * of_model, 1e-18}),
            .error = std::max(model_error, 1e-6)};
}

double StableScale::sigma(double value) const {
    if (value <= 0.0) return std::sqrt(read);
    return std::sqrt(read + shot * value + error * error * value * value);
}

double StableScale::at(double value) const {
    auto primitive = [&](double y) {
        return std::log(2.0 * error * sigma(y) + 2.0 * error * error * y + shot) / error;
    };
    if (value <= 0.0) return value / std::sqrt(read);
    return primitive(value) - primitive(0.0);
}

}  // namespace ghostlight
