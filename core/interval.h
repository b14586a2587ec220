#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

// Intervals that surely hold the exact result: each operation widens outward by more than its own
// rounding. No rounding modes are switched, so any compiler and processor gives the same proof.

namespace ghostlight {

/// At least one unit in the last place below or above, at least the smallest normal number.
inline double just_below(double x) {
    return x - (std::abs(x) * std::numeric_limits<double>::epsilon() +
                std::numeric_limits<double>::min());
}
inline double just_above(double x) { return -just_below(-x); }

/// All numbers from `low` to `high`; none when low > high.
struct Interval {
    double low = 0.0, high = 0.0;

    bool empty() const { return !(low <= high); }
    double width() const { return high - low; }
    double middle() const { return 0.5 * (low + high); }
    bool contains(double x) const { return low <= x && x <= high; }
    /// Least distance of the numbers from zero.
    double distance() const { return std::max({0.0, low, -high}); }
    double magnitude() const { return std::max(std::abs(low), std::abs(high)); }
    bool operator==(const Interval&) const = default;
};

inline Interval operator+(const Interval& a, const Interval& b) {
    return {just_below(a.low + b.low), just_above(a.high + b.high)};
}
inline Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
inline Interval operator-(const Interval& a, const Interval& b) { return a + -b; }
inline Interval operator*(const Interval& a, const Interval& b) {
    const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
    return {just_below(std::min({p, q, r, s})), just_above(std::max({p, q, r, s}))};
}
inline Interval operator*(double a, const Interval& b) { return Interval{a, a} * b; }
/// Everything when the divisor holds zero.
inline Interval operator/(const Interval& a, const Interval& b) {
    constexpr double all = std::numeric_limits<double>::infinity();
    if (b.contains(0.0)) return {-all, all};
    const double p = a.low / b.low, q = a.low / b.high, r = a.high / b.low, s = a.high / b.high;
    return {just_below(std::min({p, q, r, s})), just_above(std::max({p, q, r, s}))};
}
inline Interval square(const Interval& a) {
    const double low = a.distance(), high = a.magnitude();
    return {std::max(0.0, just_below(low * low)), just_above(high * high)};
}
/// Of the numbers that are not negative.
inline Interval sqrt(const Interval& a) {
    return {std::max(0.0, just_below(std::sqrt(std::max(0.0, a.low)))),
            just_above(std::sqrt(std::max(0.0, a.high)))};
}
inline Interval intersection(const Interval& a, const Interval& b) {
    return {std::max(a.low, b.low), std::min(a.high, b.high)};
}
inline Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

}  // namespace ghostlight
