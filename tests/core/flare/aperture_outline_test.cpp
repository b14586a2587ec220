#include "core/flare/aperture_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/ghosts/row_details.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(x) / x; }

std::vector<glm::dvec2> rectangle(double half_width, double half_height) {
    return {{-half_width, -half_height},
            {half_width, -half_height},
            {half_width, half_height},
            {-half_width, half_height}};
}

TEST(PolygonTransform, RectangleIsAProductOfSincs) {
    const auto corners = rectangle(0.7, 0.4);
    Random random(1);
    for (int n = 0; n < 200; ++n) {
        const double kx = random.between(-300.0, 300.0), ky = random.between(-300.0, 300.0);
        const auto value = polygon_transform(corners, {kx, ky});
        const double expected = 4.0 * 0.7 * 0.4 * sinc(0.7 * kx) * sinc(0.4 * ky);
        EXPECT_NEAR(value.real(), expected, 1e-13) << kx << ", " << ky;
        EXPECT_NEAR(value.imag(), 0.0, 1e-13);
    }
}

TEST(PolygonTransform, LimitsAreGuarded) {
    // Towards k = 0 and towards k across an edge, through the places where the form changes.
    const auto corners = rectangle(0.7, 0.4);
    const double area = 4.0 * 0.7 * 0.4;
    for (const double k : {0.0, 1e-300, 1e-12, 9.9e-4, 1.01e-3, 1e-2}) {
        EXPECT_NEAR(polygon_transform(corners, {k, 0.5 * k}).real(),
                    area * sinc(0.7 * k) * sinc(0.2 * k), 1e-12)
            << k;
        EXPECT_NEAR(polygon_transform(corners, {30.0, k}).real(), area * sinc(21.0) * sinc(0.4 * k),
                    1e-13)
            << k;
    }
}

TEST(PolygonTransform, ShiftIsAPhase) {
    const StopMask mask{1.0, 5, 0.3, 0.0};
    auto corners = outline_of(mask).corners;
    const glm::dvec2 k(13.0, -7.0), shift(0.31, 0.12);
    const auto before = polygon_transform(corners, k);
    for (glm::dvec2& corner : corners) corner += shift;
    const double phase = k.x * shift.x + k.y * shift.y;
    const auto expected = before * std::polar(1.0, -phase);
    EXPECT_NEAR(std::abs(polygon_transform(corners, k) - expected), 0.0, 1e-13);
}

TEST(PolygonTransform, TriangleIsThatOfAQuadrature) {
    // Midpoints of n² small triangles' parallelograms: second order, 1e-5 at n = 400 and k = 5.
    const std::vector<glm::dvec2> corners = {{0.2, -0.5}, {0.9, 0.3}, {-0.6, 0.8}};
    const glm::dvec2 k(4.0, -3.0);
    constexpr int n = 400;
    std::complex<double> sum = 0.0;
    const glm::dvec2 a = corners[1] - corners[0], b = corners[2] - corners[0];
    for (int i = 0; i < n; ++i)
        for (int j = 0; j + i < n; ++j)
            for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {
                if (third > 0.5 && i + j + 1 >= n) continue;
                const glm::dvec2 p = corners[0] + ((i + third) / n) * a + ((j + third) / n) * b;
                sum +=
                    std::polar(0.5 * (a.x * b.y - a.y * b.x) / (n * n), -(k.x * p.x + k.y * p.y));
            }
    EXPECT_NEAR(std::abs(polygon_transform(corners, k) - sum), 0.0, 1e-5);
}

TEST(ApertureOutline, AreaIsTheStops) {
    for (const int blades : {0, 3, 5, 6, 9, 12})
        for (const double curvature : {0.0, 0.3, 0.8}) {
            const StopMask mask{1.0, blades, 0.2, curvature};
            // Chords leave 2/3 of their sagitta along the edge: 8e-4 × 2π at most.
            EXPECT_NEAR(outline_of(mask).area(), stop_area_mm2(mask), 5e-3)
                << blades << " blades, curvature " << curvature;
        }
}

TEST(ApertureOutline, IntersectionOfSquaresIsTheirOverlap) {
    ApertureOutline one, other;
    one.corners = rectangle(1.0, 1.0);
    other.corners = rectangle(1.0, 1.0);
    for (glm::dvec2& corner : other.corners) corner += glm::dvec2(0.6, -0.2);
    one.is_smooth = other.is_smooth = {0, 0, 0, 0};
    EXPECT_NEAR(intersection(one, other).area(), 1.4 * 1.8, 1e-12);
    // Of a circle and its own half.
    const ApertureOutline circle = outline_of({1.0, 0, 0.0, 0.0});
    ApertureOutline half;
    half.corners = {{0.0, -2.0}, {2.0, -2.0}, {2.0, 2.0}, {0.0, 2.0}};
    half.is_smooth = {0, 0, 0, 0};
    EXPECT_NEAR(intersection(circle, half).area(), 0.5 * pi, 2e-3);  // its chords
}

}  // namespace
}  // namespace ghostlight
