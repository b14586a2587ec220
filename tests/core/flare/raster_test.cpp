// Exact coverage, against a clipper of its own.
#include "core/flare/raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double rounding = 1e-12;  // some hundreds of additions of numbers of order 1

struct Point {
    double x, y;
};
using Polygon = std::vector<Point>;

/// Part of a polygon where side(p) ≥ 0, by Sutherland and Hodgman.
template <class Side>
Polygon cut(const Polygon& polygon, Side side) {
    Polygon kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point a = polygon[k], b = polygon[(k + 1) % polygon.size()];
        const double va = side(a), vb = side(b);
        if (va >= 0.0) kept.push_back(a);
        if ((va >= 0.0) != (vb >= 0.0)) {
            const double t = va / (va - vb);
            kept.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
    }
    return kept;
}

/// ∫ value over the polygon inside a rectangle, positive when clockwise (y up).
double integral(Polygon polygon, double x0, double y0, double x1, double y1,
                const LinearValue& value) {
    polygon = cut(polygon, [&](Point p) { return p.x - x0; });
    polygon = cut(polygon, [&](Point p) { return x1 - p.x; });
    polygon = cut(polygon, [&](Point p) { return p.y - y0; });
    polygon = cut(polygon, [&](Point p) { return y1 - p.y; });
    double sum = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const Point a = polygon[0], b = polygon[k], c = polygon[k + 1];
        const double area = -0.5 * ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
        sum += area *
               (value.e + value.gx * (a.x + b.x + c.x) / 3.0 + value.gy * (a.y + b.y + c.y) / 3.0);
    }
    return sum;
}

std::vector<RasterEdge> edges_of(const Polygon& polygon, const LinearValue& value) {
    std::vector<RasterEdge> edges;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point a = polygon[k], b = polygon[(k + 1) % polygon.size()];
        edges.push_back({a.x, a.y, b.x, b.y, value});
    }
    return edges;
}

std::vector<double> picture_of(const std::vector<RasterEdge>& edges, int width, int height) {
    BandRaster raster(width, 0, height);
    for (const RasterEdge& edge : edges) raster.add(edge);
    std::vector<double> pixels(static_cast<std::size_t>(width * height));
    raster.resolve(pixels);
    return pixels;
}

/// A convex polygon: points in order of angle on an ellipse.
Polygon random_polygon(Random& random, double centre_x, double centre_y, double size) {
    std::vector<double> angles;
    const int corners = random.integer(3, 7);
    for (int k = 0; k < corners; ++k) angles.push_back(random.between(0.0, 2.0 * std::numbers::pi));
    std::ranges::sort(angles, std::greater{});  // clockwise
    const double a = size * random.between(0.05, 1.0), b = size * random.between(0.05, 1.0);
    Polygon polygon;
    for (const double phi : angles)
        polygon.push_back({centre_x + a * std::cos(phi), centre_y + b * std::sin(phi)});
    return polygon;
}

void expect_exact(const Polygon& polygon, const LinearValue& value, int width, int height) {
    const auto pixels = picture_of(edges_of(polygon, value), width, height);
    double scale = 1.0;
    for (const Point& p : polygon)
        scale = std::max(scale,
                         std::abs(value.e) + std::abs(value.gx * p.x) + std::abs(value.gy * p.y));
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            ASSERT_NEAR(pixels[static_cast<std::size_t>(j * width + i)],
                        integral(polygon, i, j, i + 1, j + 1, value), rounding * scale * width)
                << "pixel " << i << ", " << j;
}

TEST(Raster, RandomPolygonsCoverPixelsExactly) {
    Random random(91);
    for (int n = 0; n < 300; ++n)
        expect_exact(random_polygon(random, random.between(-3, 19), random.between(-3, 15),
                                    random.between(0.05, 12)),
                     {1.0, 0.0, 0.0}, 16, 12);
}

TEST(Raster, LinearValuesAreIntegratedExactly) {
    Random random(92);
    for (int n = 0; n < 200; ++n)
        expect_exact(random_polygon(random, random.between(-3, 19), random.between(-3, 15),
                                    random.between(0.05, 12)),
                     {random.between(-1, 2), random.between(-1, 1), random.between(-1, 1)}, 16, 12);
}

TEST(Raster, CornersOnPixelCornersAndEdges) {
    const LinearValue one{1.0, 0.0, 0.0};
    expect_exact({{2, 2}, {2, 6}, {5, 6}, {5, 2}}, one, 8, 8);
    expect_exact({{0, 0}, {0, 8}, {8, 8}, {8, 0}}, one, 8, 8);
    expect_exact({{-1, -1}, {-1, 9}, {9, 9}, {9, -1}}, one, 8, 8);
    expect_exact({{1, 1}, {4, 7}, {7, 1}}, one, 8, 8);
    expect_exact({{3, 0}, {3, 5}, {3.5, 5}, {3.5, 0}}, one, 8, 8);
    expect_exact({{8, 2}, {8, 5}, {9, 5}, {9, 2}}, one, 8, 8);
    expect_exact({{-2, 2}, {-2, 5}, {0, 5}, {0, 2}}, one, 8, 8);
    expect_exact({{2, 3}, {2, 4}, {6, 3}}, one, 8, 8);
}

TEST(Raster, PolygonsAcrossAllBordersKeepWhatIsInside) {
    const Polygon diamond{{-20, 4}, {5, 30}, {29, 4}, {5, -25}};
    expect_exact(diamond, {0.7, 0.02, -0.03}, 10, 8);
    const auto pixels = picture_of(edges_of(diamond, {1.0, 0.0, 0.0}), 10, 8);
    for (const double p : pixels) EXPECT_NEAR(p, 1.0, 1e-12);
}

TEST(Raster, SumOfPixelsIsAreaTimesValue) {
    Random random(93);
    for (int n = 0; n < 300; ++n) {
        const double size = std::pow(10.0, random.between(-4.0, 0.8));
        const Polygon polygon =
            random_polygon(random, random.between(8, 24), random.between(8, 24), size);
        const double value = random.between(0.5, 2.0);
        const auto pixels = picture_of(edges_of(polygon, {value, 0.0, 0.0}), 32, 32);
        double sum = 0.0;
        for (const double p : pixels) sum += p;
        EXPECT_NEAR(sum, integral(polygon, 0, 0, 32, 32, {value, 0.0, 0.0}), 32 * rounding);
    }
}

TEST(Raster, BandsAgreeWithOneRaster) {
    Random random(94);
    std::vector<RasterEdge> edges;
    for (int n = 0; n < 40; ++n) {
        const auto more =
            edges_of(random_polygon(random, random.between(-5, 37), random.between(-5, 29), 15.0),
                     {random.between(0, 1), random.between(-0.1, 0.1), 0.05});
        edges.insert(edges.end(), more.begin(), more.end());
    }
    constexpr int width = 32, height = 24;
    const auto whole = picture_of(edges, width, height);
    for (const int rows : {1, 5, 16}) {
        for (int first = 0; first < height; first += rows) {
            const int count = std::min(rows, height - first);
            BandRaster band(width, first, count);
            for (const RasterEdge& edge : edges) band.add(edge);
            std::vector<double> pixels(static_cast<std::size_t>(width * count));
            band.resolve(pixels);
            for (std::size_t i = 0; i < pixels.size(); ++i)
                EXPECT_NEAR(pixels[i], whole[static_cast<std::size_t>(first * width) + i],
                            40 * rounding);
        }
    }
}

TEST(Raster, OppositeSensesCancelAndEqualOnesAdd) {
    Polygon polygon{{1.3, 1.1}, {2.2, 6.8}, {6.4, 3.9}};
    const LinearValue value{1.5, 0.1, 0.2};
    auto edges = edges_of(polygon, value);
    const auto once = picture_of(edges, 8, 8);
    const auto again = edges_of(polygon, value);
    edges.insert(edges.end(), again.begin(), again.end());
    const auto twice = picture_of(edges, 8, 8);
    for (std::size_t i = 0; i < once.size(); ++i) EXPECT_NEAR(twice[i], 2.0 * once[i], rounding);
    std::ranges::reverse(polygon);
    for (int k = 0; k < 2; ++k) {
        const auto back = edges_of(polygon, value);
        edges.insert(edges.end(), back.begin(), back.end());
    }
    for (const double p : picture_of(edges, 8, 8)) EXPECT_NEAR(p, 0.0, 10 * rounding);
}

TEST(Raster, SharedEdgesAreSeamless) {
    // A square of two values, its diagonal drawn once with their difference.
    const LinearValue a{1.0, 0.0, 0.0}, b{3.0, 0.1, 0.0};
    const Polygon lower{{1.2, 1.4}, {6.1, 6.3}, {6.1, 1.4}},
        upper{{1.2, 1.4}, {1.2, 6.3}, {6.1, 6.3}};
    auto apart = edges_of(lower, a);
    for (const RasterEdge& e : edges_of(upper, b)) apart.push_back(e);
    std::vector<RasterEdge> joined{{1.2, 1.4, 6.1, 6.3, a - b},
                                   {6.1, 6.3, 6.1, 1.4, a},
                                   {6.1, 1.4, 1.2, 1.4, a},
                                   {1.2, 1.4, 1.2, 6.3, b},
                                   {1.2, 6.3, 6.1, 6.3, b}};
    const auto p = picture_of(apart, 8, 8), q = picture_of(joined, 8, 8);
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(p[i], q[i], 10 * rounding);
}

TEST(Raster, PointsFallIntoTheirPixel) {
    BandRaster raster(4, 2, 2);
    raster.add_point(1.0, 2.0, 5.0);
    raster.add_point(3.999, 3.999, 7.0);
    for (const auto& [x, y] : {std::pair{-0.1, 2.5}, {4.0, 2.5}, {1.0, 1.99}, {1.0, 4.0}})
        raster.add_point(x, y, 100.0);
    std::vector<double> pixels(8);
    raster.resolve(pixels);
    EXPECT_EQ(pixels, (std::vector<double>{0, 5, 0, 0, 0, 0, 0, 7}));
    raster.resolve(pixels);
    EXPECT_EQ(pixels, std::vector<double>(8, 0.0)) << "resolve clears";
}

}  // namespace
}  // namespace ghostlight
