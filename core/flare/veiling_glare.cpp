#include "core/flare/veiling_glare.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/flare/picture_levels.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// A Gaussian is 4e-5 of its peak at so many standard deviations, and so is its transform.
constexpr double reach_sigmas = 4.5;
/// Points of the coarse grid within a standard deviation of the narrowest ghost: interpolating
/// linearly between them is off by 1/(8 · 6²) = 0.35 % of its peak.
constexpr double points_in_sigma = 6.0;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// 2 J₁(q)/q.
double jinc(double q) { return q < 1e-4 ? 1.0 - q * q / 8.0 : 2.0 * std::cyl_bessel_j(1.0, q) / q; }

double lanczos(int n, int orders) {
    const double x = std::numbers::pi * n / (orders + 1);
    return n == 0 ? 1.0 : std::sin(x) / x;
}

}  // namespace

VeilSeries::VeilSeries(double period_mm, int orders)
    : period_mm_(period_mm),
      orders_(orders),
      coefficients_(idx((orders + 1) * (orders + 1) * 16), 0.0) {}

void VeilSeries::add(const GhostSpot& ghost, VeilKernel kernel) {
    const double omega = 2.0 * std::numbers::pi / period_mm_;
    const auto share = [&](double square) {
        square = std::max(0.0, square);
        return kernel == VeilKernel::gaussian ? std::exp(-0.5 * square)
                                              : jinc(2.0 * std::sqrt(square));
    };
    std::size_t k = 0;
    for (int n = 0; n <= orders_; ++n) {
        const double kx = n * omega;
        const double cx = std::cos(kx * ghost.x_mm), sx = std::sin(kx * ghost.x_mm);
        for (int m = 0; m <= orders_; ++m, k += 16) {
            const double ky = m * omega;
            const double square = kx * kx * ghost.xx_mm2 + ky * ky * ghost.yy_mm2;
            const double mixed = 2.0 * kx * ky * ghost.xy_mm2;
            const double same = share(square + mixed), opposite = share(square - mixed);
            double scale = (n > 0 ? 2.0 : 1.0) * (m > 0 ? 2.0 : 1.0) / (period_mm_ * period_mm_);
            if (kernel == VeilKernel::ellipse) scale *= lanczos(n, orders_) * lanczos(m, orders_);
            const double p = 0.5 * scale * (same + opposite), q = 0.5 * scale * (same - opposite);
            const double cy = std::cos(ky * ghost.y_mm), sy = std::sin(ky * ghost.y_mm);
            const double terms[4] = {p * cx * cy - q * sx * sy, p * cx * sy + q * sx * cy,
                                     p * sx * cy + q * cx * sy, p * sx * sy - q * cx * cy};
            for (std::size_t which = 0; which < 4; ++which)
                for (std::size_t c = 0; c < 4; ++c)
                    coefficients_[k + 4 * which + c] += terms[which] * ghost.flux_mm2[c];
        }
    }
}

std::array<double, 4> VeilSeries::at(double x_mm, double y_mm) const {
    const double omega = 2.0 * std::numbers::pi / period_mm_;
    std::array<double, 4> sum{};
    std::size_t k = 0;
    for (int n = 0; n <= orders_; ++n) {
        const double cx = std::cos(n * omega * x_mm), sx = std::sin(n * omega * x_mm);
        for (int m = 0; m <= orders_; ++m, k += 16) {
            const double cy = std::cos(m * omega * y_mm), sy = std::sin(m * omega * y_mm);
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += coefficients_[k + c] * cx * cy + coefficients_[k + 4 + c] * cx * sy +
                          coefficients_[k + 8 + c] * sx * cy + coefficients_[k + 12 + c] * sx * sy;
        }
    }
    return sum;
}

std::vector<float> VeilSeries::grid(std::span<const double> x_mm,
                                    std::span<const double> y_mm) const {
    const double omega = 2.0 * std::numbers::pi / period_mm_;
    const std::size_t count = idx(orders_ + 1);
    // Waves of every column: cos and sin of each order.
    std::vector<float> waves(x_mm.size() * count * 2);
    for (std::size_t i = 0; i < x_mm.size(); ++i)
        for (std::size_t n = 0; n < count; ++n) {
            const double phase = static_cast<double>(n) * omega * x_mm[i];
            waves[(i * count + n) * 2] = static_cast<float>(std::cos(phase));
            waves[(i * count + n) * 2 + 1] = static_cast<float>(std::sin(phase));
        }
    std::vector<float> values(x_mm.size() * y_mm.size() * 4);
    std::vector<double> row(count * 8);
    std::vector<float> row_values(count * 8);
    for (std::size_t j = 0; j < y_mm.size(); ++j) {
        // First over the orders in y, once a row; then over those in x.
        std::ranges::fill(row, 0.0);
        for (std::size_t m = 0; m < count; ++m) {
            const double phase = static_cast<double>(m) * omega * y_mm[j];
            const double cy = std::cos(phase), sy = std::sin(phase);
            for (std::size_t n = 0; n < count; ++n) {
                const double* from = &coefficients_[(n * count + m) * 16];
                double* to = &row[n * 8];
                for (std::size_t c = 0; c < 4; ++c) {
                    to[c] += from[c] * cy + from[4 + c] * sy;
                    to[4 + c] += from[8 + c] * cy + from[12 + c] * sy;
                }
            }
        }
        std::ranges::transform(row, row_values.begin(),
                               [](double value) { return static_cast<float>(value); });
        for (std::size_t i = 0; i < x_mm.size(); ++i) {
            float sum[4] = {};
            const float* wave = &waves[i * count * 2];
            for (std::size_t n = 0; n < count; ++n)
                for (std::size_t c = 0; c < 4; ++c)
                    sum[c] += row_values[n * 8 + c] * wave[2 * n] +
                              row_values[n * 8 + 4 + c] * wave[2 * n + 1];
            std::copy(sum, sum + 4, &values[(j * x_mm.size() + i) * 4]);
        }
    }
    return values;
}

bool reaches_sensor(const GhostSpot& ghost, double sensor_width_mm, double sensor_height_mm) {
    return ghost.flux() > 0.0 &&
           std::abs(ghost.x_mm) < 0.5 * sensor_width_mm + reach_sigmas * std::sqrt(ghost.xx_mm2) &&
           std::abs(ghost.y_mm) < 0.5 * sensor_height_mm + reach_sigmas * std::sqrt(ghost.yy_mm2);
}

VeilSize veil_size(std::span<const GhostSpot> ghosts, double sensor_width_mm,
                   double sensor_height_mm) {
    VeilSize size{std::max(sensor_width_mm, sensor_height_mm), 0};
    double narrowest_mm = size.period_mm;
    for (const GhostSpot& ghost : ghosts) {
        size.period_mm = std::max(
            {size.period_mm,
             0.5 * sensor_width_mm + std::abs(ghost.x_mm) + reach_sigmas * std::sqrt(ghost.xx_mm2),
             0.5 * sensor_height_mm + std::abs(ghost.y_mm) +
                 reach_sigmas * std::sqrt(ghost.yy_mm2)});
        narrowest_mm = std::min(narrowest_mm, ghost.sigmas_mm()[0]);
    }
    const double orders =
        reach_sigmas * size.period_mm / (2.0 * std::numbers::pi * std::max(narrowest_mm, 1e-9));
    size.orders = static_cast<int>(std::ceil(std::min(orders, double{most_veil_orders})));
    return size;
}

int veil_level(double narrowest_mm, const PixelFrame& frame) {
    const double step_px = narrowest_mm / (points_in_sigma * frame.pitch_mm);
    return std::clamp(static_cast<int>(std::floor(std::log2(std::max(step_px, 1.0)))), 0,
                      picture_levels - 1);
}

std::vector<float> veil_picture(const VeilSeries& series, double narrowest_mm,
                                const PixelFrame& frame, unsigned threads) {
    const int level = veil_level(narrowest_mm, frame);
    const RasterSize coarse = level_size(frame, level);
    const double pitch_mm = frame.pitch_mm / coarse.scale;
    std::vector<double> x_mm, y_mm;
    for (int i = 0; i < coarse.width_px; ++i)
        x_mm.push_back(frame.left_mm + (i - coarse.margin_px + 0.5) * pitch_mm);
    for (int j = 0; j < coarse.height_px; ++j)
        y_mm.push_back(frame.bottom_mm + (j - coarse.margin_px + 0.5) * pitch_mm);
    const std::vector<float> values = series.grid(x_mm, y_mm);
    if (level == 0) return values;
    const std::size_t width = idx(frame.width_px);
    std::vector<float> picture(width * idx(frame.height_px) * 4);
    struct Between {
        std::size_t low;
        float share;
    };
    const auto between = [&](int fine) {
        const double at = (fine + 0.5) * coarse.scale + coarse.margin_px - 0.5;
        const double low = std::floor(at);
        return Between{static_cast<std::size_t>(low), static_cast<float>(at - low)};
    };
    std::vector<Between> columns;
    for (int i = 0; i < frame.width_px; ++i) columns.push_back(between(i));
    const std::size_t stride = idx(coarse.width_px) * 4;
    parallel_for(idx(frame.height_px), threads, {}, [&](std::size_t j) {
        const Between rows = between(static_cast<int>(j));
        std::vector<float> mixed(stride);
        const float* below = values.data() + rows.low * stride;
        for (std::size_t i = 0; i < stride; ++i)
            mixed[i] = below[i] + rows.share * (below[stride + i] - below[i]);
        float* to = picture.data() + j * width * 4;
        for (const Between& column : columns) {
            const float* from = mixed.data() + column.low * 4;
            for (int c = 0; c < 4; ++c) to[c] = from[c] + column.share * (from[4 + c] - from[c]);
            to += 4;
        }
    });
    return picture;
}

}  // namespace ghostlight
