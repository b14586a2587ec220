#include "core/flare/aperture_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ghostlight {
namespace {

/// A polygon of more blades differs from its circle by less than the chords of a curved blade do.
constexpr int most_blades = 120;
constexpr int circle_corners = 72;
/// Below this |k|, in units of the opening, the edge sum loses more digits than the moments leave.
constexpr double least_k = 1e-3;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
double dot(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.x + a.y * b.y; }

double sinc(double x) {
    if (std::abs(x) < 1e-3) return 1.0 - x * x / 6.0;  // what is left is below 1e-14
    return std::sin(x) / x;
}

glm::dvec2 on_circle(double angle_rad, double radius = 1.0) {
    return {radius * std::cos(angle_rad), radius * std::sin(angle_rad)};
}

ApertureOutline circle() {
    ApertureOutline outline;
    outline.is_unit_circle = true;
    // Chords of a slightly larger circle, so that the area is the circle's.
    const double step = 2.0 * std::numbers::pi / circle_corners;
    const double radius = std::sqrt(step / std::sin(step));
    for (int k = 0; k < circle_corners; ++k) outline.corners.push_back(on_circle(k * step, radius));
    outline.is_smooth.assign(circle_corners, 1);
    return outline;
}

/// Area, first and second moments by the edges (Steger 1996).
struct Moments {
    double area = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
};
Moments moments(std::span<const glm::dvec2> corners) {
    Moments m;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        const double c = cross(a, b);
        m.area += c / 2.0;
        m.x += c * (a.x + b.x) / 6.0;
        m.y += c * (a.y + b.y) / 6.0;
        m.xx += c * (a.x * a.x + a.x * b.x + b.x * b.x) / 12.0;
        m.yy += c * (a.y * a.y + a.y * b.y + b.y * b.y) / 12.0;
        m.xy += c * (2.0 * a.x * a.y + a.x * b.y + b.x * a.y + 2.0 * b.x * b.y) / 24.0;
    }
    return m;
}

}  // namespace

double ApertureOutline::area() const {
    return is_unit_circle ? std::numbers::pi : moments(corners).area;
}

double ApertureOutline::perimeter() const {
    if (is_unit_circle) return 2.0 * std::numbers::pi;
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 d = corners[(i + 1) % corners.size()] - corners[i];
        sum += std::hypot(d.x, d.y);
    }
    return sum;
}

ApertureOutline outline_of(const StopMask& mask, double sagitta) {
    if (mask.blades < 3 || mask.blades > most_blades || mask.blade_curvature >= 1.0)
        return circle();
    ApertureOutline outline;
    const double half = std::numbers::pi / mask.blades;
    const double curvature = std::max(0.0, mask.blade_curvature);
    // The blade's arc over its chord, as stop_margin() has it: centre `back` behind the middle.
    const double turn = std::asin(std::min(1.0, curvature * std::sin(half)));
    const double height = curvature > 0.0 ? (1.0 - std::cos(turn)) / curvature : 0.0;
    const int chords = std::max(1, static_cast<int>(std::ceil(std::sqrt(height / sagitta))));
    for (int blade = 0; blade < mask.blades; ++blade) {
        const double middle = mask.rotation_rad + half * (2 * blade + 1);
        outline.corners.push_back(on_circle(middle - half));
        outline.is_smooth.push_back(0);
        for (int c = 1; c < chords; ++c) {
            const double angle = turn * (2.0 * c / chords - 1.0);
            const double radius = 1.0 / curvature;
            const double back = radius * std::cos(turn) - std::cos(half);
            const glm::dvec2 arc = on_circle(middle + angle, radius);
            outline.corners.push_back(arc - on_circle(middle, back));
            outline.is_smooth.push_back(1);
        }
    }
    return outline;
}

ApertureOutline intersection(const ApertureOutline& of, const ApertureOutline& with) {
    // Sutherland and Hodgman 1974: cut by every edge of `with` in turn.
    ApertureOutline left = of;
    left.is_unit_circle = false;
    for (std::size_t e = 0; e < with.corners.size() && !left.corners.empty(); ++e) {
        const glm::dvec2 from = with.corners[e];
        const glm::dvec2 along = with.corners[(e + 1) % with.corners.size()] - from;
        ApertureOutline next;
        auto put = [&next](const glm::dvec2& corner, char smooth) {
            next.corners.push_back(corner);
            next.is_smooth.push_back(smooth);
        };
        // Where two edges of a smooth `with` follow one another, so does what they cut.
        const char here = with.is_smooth[e], there = with.is_smooth[(e + 1) % with.corners.size()];
        for (std::size_t i = 0; i < left.corners.size(); ++i) {
            const glm::dvec2 a = left.corners[i];
            const glm::dvec2 b = left.corners[(i + 1) % left.corners.size()];
            const double sa = cross(along, a - from), sb = cross(along, b - from);
            if (sa >= 0.0) put(a, left.is_smooth[i]);
            if ((sa >= 0.0) != (sb >= 0.0)) {
                const glm::dvec2 cut = a + (sa / (sa - sb)) * (b - a);
                const double at = dot(cut - from, along) / dot(along, along);
                constexpr double corner = 1e-9;
                const char smooth = std::abs(at) < corner         ? here
                                    : std::abs(at - 1.0) < corner ? there
                                                                  : char{0};
                put(cut, smooth);
            }
        }
        left = std::move(next);
    }
    // Joints of `with` are kept as such: a corner of the result that is one of its smooth corners.
    for (std::size_t i = 0; i < left.corners.size(); ++i)
        for (std::size_t e = 0; e < with.corners.size(); ++e) {
            const glm::dvec2 d = left.corners[i] - with.corners[e];
            if (std::abs(d.x) + std::abs(d.y) < 1e-9) left.is_smooth[i] = with.is_smooth[e];
        }
    return left;
}

std::complex<double> polygon_transform(std::span<const glm::dvec2> corners, glm::dvec2 k) {
    using Complex = std::complex<double>;
    const double k2 = dot(k, k);
    if (k2 < least_k * least_k) {
        const Moments m = moments(corners);
        return Complex(
            m.area - 0.5 * (k.x * k.x * m.xx + 2.0 * k.x * k.y * m.xy + k.y * k.y * m.yy),
            -(k.x * m.x + k.y * m.y));
    }
    Complex sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        const glm::dvec2 d = b - a;
        const double phase = 0.5 * dot(k, a + b);
        sum += cross(k, d) * sinc(0.5 * dot(k, d)) * Complex(std::cos(phase), -std::sin(phase));
    }
    return Complex(0.0, 1.0 / k2) * sum;
}

}  // namespace ghostlight
