#include "core/optics/spectral_table.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {
namespace {

/// The entry that ends the interval around the wavelength; the table is longer than one and the
/// wavelength lies within.
std::size_t upper_end(const SpectralTable& table, double wavelength_nm) {
    const auto after =
        std::ranges::upper_bound(table, wavelength_nm, {}, &SpectralValue::wavelength_nm);
    const auto index = static_cast<std::size_t>(after - table.begin());
    return std::min(index, table.size() - 1);
}

bool beyond(const SpectralTable& table, double wavelength_nm, double& value) {
    if (wavelength_nm <= table.front().wavelength_nm) {
        value = table.front().value;
        return true;
    }
    if (wavelength_nm >= table.back().wavelength_nm) {
        value = table.back().value;
        return true;
    }
    return false;
}

struct CurveInInverseSquare {
    const SpectralTable& table;

    double x(std::size_t i) const {
        return 1.0 / (table[i].wavelength_nm * table[i].wavelength_nm);
    }
    double width(std::size_t i) const { return x(i + 1) - x(i); }
    double secant(std::size_t i) const { return (table[i + 1].value - table[i].value) / width(i); }
    /// At an end: the parabola through three entries, held within what keeps the curve monotone.
    double end_slope(double near_width, double far_width, double near_secant,
                     double far_secant) const {
        const double slope =
            ((2.0 * near_width + far_width) * near_secant - near_width * far_secant) /
            (near_width + far_width);
        if (slope * near_secant <= 0.0) return 0.0;
        if (near_secant * far_secant < 0.0 && std::abs(slope) > 3.0 * std::abs(near_secant))
            return 3.0 * near_secant;
        return slope;
    }
    double slope(std::size_t i) const {
        const std::size_t last = table.size() - 1;
        if (last == 1) return secant(0);
        if (i == 0) return end_slope(width(0), width(1), secant(0), secant(1));
        if (i == last)
            return end_slope(width(last - 1), width(last - 2), secant(last - 1), secant(last - 2));
        const double before = secant(i - 1), after = secant(i);
        if (before * after <= 0.0) return 0.0;
        const double a = 2.0 * width(i) + width(i - 1), b = width(i) + 2.0 * width(i - 1);
        return (a + b) / (a / before + b / after);
    }
};

}  // namespace

double linear_at(const SpectralTable& table, double wavelength_nm) {
    double value = 0.0;
    if (beyond(table, wavelength_nm, value)) return value;
    const std::size_t end = upper_end(table, wavelength_nm);
    const SpectralValue &a = table[end - 1], &b = table[end];
    const double share = (wavelength_nm - a.wavelength_nm) / (b.wavelength_nm - a.wavelength_nm);
    return a.value + share * (b.value - a.value);
}

double smooth_at(const SpectralTable& table, double wavelength_nm) {
    double value = 0.0;
    if (beyond(table, wavelength_nm, value)) return value;
    const std::size_t i = upper_end(table, wavelength_nm) - 1;
    if (table[i].wavelength_nm == wavelength_nm) return table[i].value;
    const CurveInInverseSquare curve{table};
    const double h = curve.width(i);
    const double t = (1.0 / (wavelength_nm * wavelength_nm) - curve.x(i)) / h;
    const double s = 1.0 - t;
    // Cubic Hermite, in a form that leaves equal entries equal.
    const double rise = table[i + 1].value - table[i].value;
    return table[i].value + rise * t * t * (3.0 - 2.0 * t) +
           h * t * s * (curve.slope(i) * s - curve.slope(i + 1) * t);
}

bool has_rising_wavelengths(const SpectralTable& table) {
    double before = 0.0;
    for (const SpectralValue& entry : table) {
        if (!(entry.wavelength_nm > before) || !std::isfinite(entry.wavelength_nm)) return false;
        before = entry.wavelength_nm;
    }
    return !table.empty();
}

}  // namespace ghostlight
