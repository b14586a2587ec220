#pragma once

#include <cmath>
#include <limits>

#include "core/interval.h"

// Affine forms: over a small rectangle a smooth function of two variables is its tangent plane
// plus an error that falls fourfold when the rectangle is halved. Plain intervals, which forget
// that quantities move together, blow up within a few surfaces; these do not.
// (L. H. de Figueiredo and J. Stolfi, Affine arithmetic: concepts and applications, 2004; one
// error term is kept for all that is not linear in the two variables.)

namespace ghostlight {

/// Where the two variables of affine forms lie: part of [−1, 1]².
struct AffineDomain {
    Interval u{-1.0, 1.0}, v{-1.0, 1.0};
    bool empty() const { return u.empty() || v.empty(); }
    /// Share of [−1, 1]².
    double share() const { return empty() ? 0.0 : 0.25 * u.width() * v.width(); }
};

/// center + du U + dv V ± error, for U and V in [−1, 1].
struct Affine {
    double center = 0.0, du = 0.0, dv = 0.0, error = 0.0;

    /// Largest distance from the centre.
    double radius() const { return std::abs(du) + std::abs(dv) + error; }
    double magnitude() const { return std::abs(center) + radius(); }
};

/// Bounds the rounding of a form whose parts took a handful of operations on numbers of this size.
inline constexpr double affine_rounding = 16.0 * std::numeric_limits<double>::epsilon();

inline Affine constant(double value) { return {value, 0.0, 0.0, 0.0}; }
/// Anything in the interval, whatever U and V are.
inline Affine anything_in(const Interval& range) {
    const double middle = range.middle();
    const double radius = std::max(range.high - middle, middle - range.low);
    return {middle, 0.0, 0.0, radius + affine_rounding * (std::abs(middle) + radius)};
}

inline Interval range(const Affine& x, const AffineDomain& domain) {
    const double error = x.error;
    return Interval{x.center - error, x.center + error} + x.du * domain.u + x.dv * domain.v;
}

inline Affine operator+(const Affine& x, const Affine& y) {
    Affine sum{x.center + y.center, x.du + y.du, x.dv + y.dv, 0.0};
    sum.error = x.error + y.error + affine_rounding * (x.magnitude() + y.magnitude());
    return sum;
}
inline Affine operator-(const Affine& x) { return {-x.center, -x.du, -x.dv, x.error}; }
inline Affine operator-(const Affine& x, const Affine& y) { return x + -y; }
inline Affine operator+(const Affine& x, double y) { return x + constant(y); }
inline Affine operator+(double x, const Affine& y) { return y + constant(x); }
inline Affine operator-(double x, const Affine& y) { return -y + constant(x); }
inline Affine operator-(const Affine& x, double y) { return x + constant(-y); }
inline Affine operator*(double factor, const Affine& x) {
    const double size = std::abs(factor);
    return {factor * x.center, factor * x.du, factor * x.dv,
            size * (x.error + affine_rounding * x.magnitude())};
}

inline Affine operator*(const Affine& x, const Affine& y) {
    // U² lies in [0, 1]: half of its factor goes to the centre.
    const double uu = x.du * y.du, vv = x.dv * y.dv;
    const double slope_x = std::abs(x.du) + std::abs(x.dv);
    const double slope_y = std::abs(y.du) + std::abs(y.dv);
    Affine product{x.center * y.center + 0.5 * (uu + vv), x.center * y.du + y.center * x.du,
                   x.center * y.dv + y.center * x.dv, 0.0};
    product.error = 0.5 * (std::abs(uu) + std::abs(vv)) + std::abs(x.du * y.dv + x.dv * y.du) +
                    x.error * (std::abs(y.center) + slope_y + y.error) +
                    y.error * (std::abs(x.center) + slope_x) +
                    affine_rounding * x.magnitude() * y.magnitude();
    return product;
}
inline Affine square(const Affine& x) {
    Affine product = x * x;
    // The error's own square is not negative, and its product with the rest counts once, doubled;
    // x·x counts it the same way, less this half.
    const double half = 0.5 * x.error * x.error;
    product.center += half;
    product.error -= half * (1.0 - affine_rounding);
    return product;
}

namespace affine_detail {
/// slope·x + offset ± spread.
inline Affine linear(const Affine& x, double slope, double offset, double spread) {
    const double size = std::abs(slope);
    Affine y{slope * x.center + offset, slope * x.du, slope * x.dv, 0.0};
    y.error = size * x.error + spread * (1.0 + affine_rounding) +
              affine_rounding * (size * x.magnitude() + std::abs(offset));
    return y;
}
}  // namespace affine_detail

/// √x for those x that lie in `within`, low ≥ 0: the chord's slope errs least.
inline Affine sqrt(const Affine& x, const Interval& within) {
    const double low = std::sqrt(within.low), high = std::sqrt(within.high);
    const double sum = low + high;
    if (!(sum > 0.0)) return {0.0, 0.0, 0.0, just_above(high)};
    const double least = low * high / sum, most = 0.25 * sum;
    return affine_detail::linear(x, 1.0 / sum, 0.5 * (least + most), 0.5 * (most - least));
}

/// 1/x for those x that lie in `within`, which does not hold 0.
inline Affine reciprocal(const Affine& x, const Interval& within) {
    if (within.high < 0.0) return -reciprocal(-x, -within);
    const double product = within.low * within.high;
    const double most = 1.0 / within.low + 1.0 / within.high, least = 2.0 / std::sqrt(product);
    return affine_detail::linear(x, -1.0 / product, 0.5 * (least + most), 0.5 * (most - least));
}

/// sin x and cos x by their tangents: what is left is at most half the square of the radius.
inline Affine sine_of(const Affine& x) {
    const double r = x.radius(), c = std::cos(x.center), s = std::sin(x.center);
    const double slope = r < 2.0 ? c : 0.0;
    return affine_detail::linear(x, slope, s - slope * x.center, r < 2.0 ? 0.5 * r * r : 2.0);
}
inline Affine cosine_of(const Affine& x) {
    const double r = x.radius(), c = std::cos(x.center), s = std::sin(x.center);
    const double slope = r < 2.0 ? -s : 0.0;
    return affine_detail::linear(x, slope, c - slope * x.center, r < 2.0 ? 0.5 * r * r : 2.0);
}

/// Narrows the domain to where `x` may lie within `allowed`; false when nothing is left.
inline bool narrow(AffineDomain& domain, const Affine& x, const Interval& allowed) {
    const Interval around{x.center - x.error, x.center + x.error};
    const Interval free = allowed - around;
    const Interval of_u = x.du * domain.u, of_v = x.dv * domain.v;
    if (intersection(of_u + of_v, free).empty()) return false;
    if (x.du != 0.0) domain.u = intersection(domain.u, (free - of_v) / Interval{x.du, x.du});
    if (x.dv != 0.0) domain.v = intersection(domain.v, (free - of_u) / Interval{x.dv, x.dv});
    return !domain.empty();
}

}  // namespace ghostlight
