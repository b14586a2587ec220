#include "core/flare/fresnel.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "core/flare/fourier_2d.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double series_below = 1.8;
constexpr int grid_across = 1024;

/// How the grid is shared between the stop and what lies around it: the smaller the Fresnel number,
/// the further light spreads, and the broader are its fringes.
struct Padding {
    int times;        ///< the grid over the stop
    double reach;     ///< of what is kept, semi-diameters
    double unspoilt;  ///< of that, where nothing that has run round the grid may land
};
Padding padding_for(double fresnel_number) {
    if (fresnel_number < 4.0) return {8, 4.0, 4.0};
    if (fresnel_number < 20.0) return {4, 2.0, 2.0};
    return {2, 2.0, 1.0};
}

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

FresnelIntegrals by_series(double x) {
    // C + iS = ∫ exp(iπt²/2) dt = Σ (iπ/2)ⁿ x²ⁿ⁺¹ / (n! (2n + 1))
    const std::complex<double> step(0.0, 0.5 * pi * x * x);
    std::complex<double> power = x, sum = x;
    for (int n = 1; n < 100; ++n) {
        power *= step / static_cast<double>(n);
        const auto term = power / (2.0 * n + 1.0);
        sum += term;
        if (std::abs(term) < 1e-17 * std::abs(sum)) break;
    }
    return {sum.real(), sum.imag()};
}

FresnelIntegrals by_fraction(double x) {
    // C + iS = (1 + i)/2 · [1 − erfc(z)], z = √π/2 (1 − i) x, and erfc by its continued fraction.
    using Complex = std::complex<double>;
    const Complex z = 0.5 * std::sqrt(pi) * Complex(1.0, -1.0) * x;
    // √π exp(z²) erfc(z) = 1/(z + ½/(z + 1/(z + 3/2/(z + …)))), from the end.
    Complex tail = z;
    for (int n = 120; n >= 1; --n) tail = z + 0.5 * n / tail;
    const Complex erfc = std::exp(-z * z) / (std::sqrt(pi) * tail);
    const Complex value = Complex(0.5, 0.5) * (1.0 - erfc);
    return {value.real(), value.imag()};
}

}  // namespace

FresnelIntegrals fresnel_integrals(double x) {
    const double size = std::abs(x);
    FresnelIntegrals value = size < series_below ? by_series(size) : by_fraction(size);
    if (x < 0.0) value = {-value.c, -value.s};
    return value;
}

double straight_edge(double w) {
    const auto [c, s] = fresnel_integrals(w);
    return 0.5 * ((0.5 + c) * (0.5 + c) + (0.5 + s) * (0.5 + s));
}

int propagation_raster(double fresnel_number) {
    return grid_across / padding_for(fresnel_number).times;
}

std::optional<MaskSpectrum> mask_spectrum(const MaskRaster& raster, double fresnel_number,
                                          unsigned threads, const std::stop_token& stop) {
    const Padding padding = padding_for(fresnel_number);
    MaskSpectrum mask;
    mask.across = grid_across;
    mask.width = mask.across * raster.pitch();
    mask.reach = std::min(0.5 * mask.width, padding.reach);
    mask.furthest = mask.width - 1.0 - padding.unspoilt;
    mask.field.resize(idx(mask.across) * idx(mask.across));
    const int first = (mask.across - raster.across) / 2;
    for (int j = 0; j < raster.across; ++j)
        for (int i = 0; i < raster.across; ++i)
            mask.field[idx(first + j) * idx(mask.across) + idx(first + i)] =
                raster.open[idx(j * raster.across + i)];
    if (!transform_2d(mask.field, mask.across, false, threads, stop)) return std::nullopt;
    return mask;
}

std::optional<PropagatedMask> propagated(const MaskRaster& raster, double fresnel_number,
                                         unsigned threads, const std::stop_token& stop) {
    const auto mask = mask_spectrum(raster, fresnel_number, threads, stop);
    return mask ? propagated(*mask, fresnel_number, threads, stop) : std::nullopt;
}

std::optional<PropagatedMask> propagated(const MaskSpectrum& mask, double fresnel_number,
                                         unsigned threads, const std::stop_token& stop) {
    const int across = mask.across;
    std::vector<std::complex<float>> field = mask.field;
    // Light of frequency f lands f/N away. What would run round the padded grid and back into the
    // part that is kept is left out (Matsushima and Shimobaba 2009), softly.
    constexpr double soft = 0.1;
    const double none_f = mask.furthest * fresnel_number, all_f = (1.0 - soft) * none_f;
    auto kept_share = [&](double f2) {
        if (f2 <= all_f * all_f) return 1.0;
        const double t = std::clamp((none_f - std::sqrt(f2)) / (soft * none_f), 0.0, 1.0);
        return t * t * (3.0 - 2.0 * t);
    };
    // The phase of a frequency is the product of its two axes'.
    std::vector<double> squares(idx(across));
    std::vector<std::complex<double>> turns(idx(across));
    for (int i = 0; i < across; ++i) {
        const double f = (i < across / 2 ? i : i - across) / mask.width;
        squares[idx(i)] = f * f;
        turns[idx(i)] = std::polar(1.0, std::remainder(-pi * f * f / fresnel_number, 2.0 * pi));
    }
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < across; ++i) {
            const double kept = kept_share(squares[idx(i)] + squares[idx(j)]);
            const std::complex<double>&a = turns[idx(i)], &b = turns[idx(j)];
            field[idx(j) * idx(across) + idx(i)] *= std::complex<float>(
                static_cast<float>(kept * (a.real() * b.real() - a.imag() * b.imag())),
                static_cast<float>(kept * (a.real() * b.imag() + a.imag() * b.real())));
        }
    if (!transform_2d(field, across, true, threads, stop)) return std::nullopt;
    PropagatedMask result;
    result.reach = mask.reach;
    const int kept = static_cast<int>(std::lround(across * 2.0 * result.reach / mask.width));
    result.across = kept;
    result.irradiance.resize(idx(kept) * idx(kept));
    const float scale = 1.0F / (static_cast<float>(across) * static_cast<float>(across));
    const int from = (across - kept) / 2;
    for (int j = 0; j < kept; ++j)
        for (int i = 0; i < kept; ++i)
            result.irradiance[idx(j) * idx(kept) + idx(i)] =
                std::norm(field[idx(from + j) * idx(across) + idx(from + i)] * scale);
    return result;
}

double PropagatedMask::at(double x, double y) const {
    const double column = (x / reach + 1.0) * 0.5 * across - 0.5;
    const double row = (y / reach + 1.0) * 0.5 * across - 0.5;
    if (!(column >= 0.0 && row >= 0.0 && column < across - 1.0 && row < across - 1.0)) return 0.0;
    const int i = static_cast<int>(column), j = static_cast<int>(row);
    const double fx = column - i, fy = row - j;
    auto pixel = [&](int a, int b) {
        return static_cast<double>(irradiance[idx(b) * idx(across) + idx(a)]);
    };
    return std::lerp(std::lerp(pixel(i, j), pixel(i + 1, j), fx),
                     std::lerp(pixel(i, j + 1), pixel(i + 1, j + 1), fx), fy);
}

}  // namespace ghostlight
