#include "core/flare/veiling_glare.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/flare/veil_kernel.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// A Gaussian is 4e-5 of its peak at so many standard deviations, and so is its transform.
constexpr double reach_sigmas = 4.5;
/// A Gaussian's coefficient is left out below exp(−25) of its first.
constexpr double most_square = 50.0;

constexpr std::size_t rows_together = 8;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// 2 J₁(q)/q. Asked for at every order of every ghost: linear in a table, to 1e-5.
double jinc(double q) {
    constexpr int per_unit = 64, count = 64 * per_unit;
    auto exact = [](double x) {
        return x < 1e-4 ? 1.0 - x * x / 8.0 : 2.0 * std::cyl_bessel_j(1.0, x) / x;
    };
    static const std::vector<double> table = [&] {
        std::vector<double> values;
        for (int k = 0; k <= count; ++k) values.push_back(exact(static_cast<double>(k) / per_unit));
        return values;
    }();
    const double place = q * per_unit;
    if (!(place < count)) return exact(q);
    const auto k = static_cast<std::size_t>(place);
    return table[k] + (place - static_cast<double>(k)) * (table[k + 1] - table[k]);
}

/// Cosine and sine of 0, 1, 2 … times a phase.
struct Waves {
    std::vector<double> cosine, sine;
    Waves(double phase, int orders) : cosine(idx(orders) + 1), sine(cosine.size()) {
        const double c = std::cos(phase), s = std::sin(phase);
        cosine[0] = 1.0;
        for (std::size_t n = 1; n < cosine.size(); ++n) {
            cosine[n] = c * cosine[n - 1] - s * sine[n - 1];
            sine[n] = s * cosine[n - 1] + c * sine[n - 1];
        }
    }
};

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
    const bool gaussian = kernel == VeilKernel::gaussian;
    const auto share = [&](double square) {
        square = std::max(0.0, square);
        return gaussian ? std::exp(-0.5 * square) : jinc(2.0 * std::sqrt(square));
    };
    const Waves in_x(omega * ghost.x_mm, orders_), in_y(omega * ghost.y_mm, orders_);
    std::size_t k = 0;
    for (int n = 0; n <= orders_; ++n) {
        const double kx = n * omega, cx = in_x.cosine[idx(n)], sx = in_x.sine[idx(n)];
        for (int m = 0; m <= orders_; ++m, k += 16) {
            const double ky = m * omega;
            const double square = kx * kx * ghost.xx_mm2 + ky * ky * ghost.yy_mm2;
            const double mixed = 2.0 * kx * ky * ghost.xy_mm2;
            if (gaussian && square - std::abs(mixed) > most_square) continue;
            const double same = share(square + mixed), opposite = share(square - mixed);
            double scale = (n > 0 ? 2.0 : 1.0) * (m > 0 ? 2.0 : 1.0) / (period_mm_ * period_mm_);
            if (!gaussian) scale *= lanczos(n, orders_) * lanczos(m, orders_);
            const double p = 0.5 * scale * (same + opposite), q = 0.5 * scale * (same - opposite);
            const double cy = in_y.cosine[idx(m)], sy = in_y.sine[idx(m)];
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

std::vector<float> VeilSeries::grid(std::span<const double> x_mm, std::span<const double> y_mm,
                                    unsigned threads) const {
    const double omega = 2.0 * std::numbers::pi / period_mm_;
    const std::size_t orders = idx(orders_ + 1);
    const std::size_t columns = (x_mm.size() + veil_padding - 1) / veil_padding * veil_padding;
    // Waves of every column, order by order.
    std::vector<float> cosines(orders * columns, 0.0F), sines(orders * columns, 0.0F);
    for (std::size_t i = 0; i < x_mm.size(); ++i) {
        const Waves own(omega * x_mm[i], orders_);
        for (std::size_t n = 0; n < orders; ++n) {
            cosines[n * columns + i] = static_cast<float>(own.cosine[n]);
            sines[n * columns + i] = static_cast<float>(own.sine[n]);
        }
    }
    std::vector<float> coefficients(coefficients_.size());
    for (std::size_t k = 0; k < coefficients.size(); k += 16)
        for (std::size_t c = 0; c < 4; ++c) {
            coefficients[k + c] = static_cast<float>(coefficients_[k + c]);
            coefficients[k + 4 + c] = static_cast<float>(coefficients_[k + 8 + c]);
            coefficients[k + 8 + c] = static_cast<float>(coefficients_[k + 4 + c]);
            coefficients[k + 12 + c] = static_cast<float>(coefficients_[k + 12 + c]);
        }
    std::vector<float> values(x_mm.size() * y_mm.size() * 4);
    const std::size_t blocks = (y_mm.size() + rows_together - 1) / rows_together;
    parallel_for(blocks, threads, {}, [&](std::size_t block) {
        std::vector<float> cosine(orders), sine(orders), sums(orders * 8), row(columns * 4);
        for (std::size_t j = block * rows_together;
             j < std::min(y_mm.size(), (block + 1) * rows_together); ++j) {
            // First over the orders in y, once a row; then over those in x.
            const Waves own(omega * y_mm[j], orders_);
            std::ranges::transform(own.cosine, cosine.begin(),
                                   [](double value) { return static_cast<float>(value); });
            std::ranges::transform(own.sine, sine.begin(),
                                   [](double value) { return static_cast<float>(value); });
            const VeilOrdersView in_y{coefficients.data(), cosine.data(), sine.data(), orders,
                                      sums.data()};
            GHOSTLIGHT_DISPATCH(veil_orders, in_y);
            const VeilRowView in_x{sums.data(), cosines.data(), sines.data(),
                                   orders,      columns,        row.data()};
            GHOSTLIGHT_DISPATCH(veil_row, in_x);
            std::copy_n(row.begin(), 4 * x_mm.size(), &values[j * x_mm.size() * 4]);
        }
    });
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

}  // namespace ghostlight
