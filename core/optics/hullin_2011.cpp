#include "core/optics/hullin_2011.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ghostlight {

double hullin_2011_reflectance(double cos_incidence, double wavelength_nm, double thickness_nm,
                               double n0, double n1, double n2) {
    constexpr double nearly_normal_rad = 1e-4;
    const double theta0 = std::max(nearly_normal_rad, std::acos(std::min(1.0, cos_incidence)));
    const double sin0 = std::sin(theta0);
    if (sin0 * n0 >= n1 || sin0 * n0 >= n2) return 1.0;
    const double theta1 = std::asin(sin0 * n0 / n1), theta2 = std::asin(sin0 * n0 / n2);
    const double rs01 = -std::sin(theta0 - theta1) / std::sin(theta0 + theta1);
    const double rp01 = std::tan(theta0 - theta1) / std::tan(theta0 + theta1);
    const double ts01 = 2.0 * std::sin(theta1) * std::cos(theta0) / std::sin(theta0 + theta1);
    const double tp01 = ts01 * std::cos(theta0 - theta1);
    const double rs12 = -std::sin(theta1 - theta2) / std::sin(theta1 + theta2);
    const double rp12 = std::tan(theta1 - theta2) / std::tan(theta1 + theta2);
    const double inner_s = ts01 * ts01 * rs12, inner_p = tp01 * tp01 * rp12;
    const double dy = thickness_nm * n1, dx = std::tan(theta1) * dy;
    const double phase = 4.0 * std::numbers::pi / wavelength_nm * (std::hypot(dx, dy) - dx * sin0);
    auto sum = [&](double outer, double inner) {
        return outer * outer + inner * inner + 2.0 * outer * inner * std::cos(phase);
    };
    return 0.5 * (sum(rs01, inner_s) + sum(rp01, inner_p));
}

}  // namespace ghostlight
