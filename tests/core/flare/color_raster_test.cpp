// The raster of several channels and sizes, against the raster of one.
#include "core/flare/color_raster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "core/flare/picture_levels.h"
#include "core/flare/raster.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr int width = 64, height = 32;
// Values go out as floats: half a unit in the last place of numbers of order 10.
constexpr double float_rounding = 2e-6;

struct Point {
    double x, y;
};

/// Random triangles, on, across and off the frame; clockwise ones add.
std::vector<std::vector<Point>> triangles(Random& random, int count) {
    std::vector<std::vector<Point>> made;
    for (int k = 0; k < count; ++k) {
        std::vector<Point> t;
        for (int c = 0; c < 3; ++c)
            t.push_back(
                {random.between(-20.0, width + 20.0), random.between(-20.0, height + 20.0)});
        made.push_back(t);
    }
    return made;
}

template <int C>
std::vector<ColorEdge<C>> edges_of(const std::vector<Point>& polygon, const double (&e)[C],
                                   double gx, double gy) {
    std::vector<ColorEdge<C>> edges;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        ColorEdge<C> edge{a.x, a.y, b.x, b.y, {}, {}, {}};
        for (int c = 0; c < C; ++c) {
            edge.e[c] = e[c];
            edge.gx[c] = (c + 1) * gx;
            edge.gy[c] = (c + 1) * gy;
        }
        edges.push_back(edge);
    }
    return edges;
}

std::vector<std::uint32_t> all_of(std::size_t count) {
    std::vector<std::uint32_t> chosen(count);
    std::iota(chosen.begin(), chosen.end(), 0U);
    return chosen;
}

TEST(ColorRaster, EveryChannelIsWhatTheSingleRasterDraws) {
    Random random(3);
    const double e[4] = {1.0, -0.5, 2.0, 0.25};
    const double gx = 0.01, gy = -0.02;
    ColorBand<4> band({width, height, 1.0, 0}, 0, height);
    std::vector<BandRaster> single;
    for (int c = 0; c < 4; ++c) single.emplace_back(width, 0, height);
    for (const auto& t : triangles(random, 40)) {
        const auto edges = edges_of<4>(t, e, gx, gy);
        band.add(edges, all_of(edges.size()));
        for (int c = 0; c < 4; ++c)
            for (const auto& edge : edges)
                single[static_cast<std::size_t>(c)].add(
                    {edge.x0, edge.y0, edge.x1, edge.y1, {edge.e[c], edge.gx[c], edge.gy[c]}});
    }
    std::vector<float> pixels(width * height * 4, 0.0F);
    band.resolve(pixels);
    for (int c = 0; c < 4; ++c) {
        std::vector<double> values(width * height);
        single[static_cast<std::size_t>(c)].resolve(values);
        for (std::size_t i = 0; i < values.size(); ++i)
            ASSERT_NEAR(pixels[4 * i + static_cast<std::size_t>(c)], values[i],
                        float_rounding * (1.0 + std::abs(values[i])))
                << "pixel " << i << " channel " << c;
    }
}

TEST(ColorRaster, OneChannelIsTheSame) {
    Random random(4);
    ColorBand<1> band({width, height, 1.0, 0}, 0, height);
    BandRaster single(width, 0, height);
    for (const auto& t : triangles(random, 40)) {
        const auto edges = edges_of<1>(t, {1.5}, 0.01, 0.02);
        band.add(edges, all_of(edges.size()));
        for (const auto& edge : edges)
            single.add({edge.x0, edge.y0, edge.x1, edge.y1, {edge.e[0], edge.gx[0], edge.gy[0]}});
    }
    std::vector<float> pixels(width * height, 0.0F);
    std::vector<double> values(width * height);
    band.resolve(pixels);
    single.resolve(values);
    for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_NEAR(pixels[i], values[i], float_rounding * (1.0 + std::abs(values[i])));
}

TEST(ColorRaster, AddsToWhatIsThereAndStartsCleanAgain) {
    const std::vector<Point> square = {{10, 10}, {10, 12}, {12, 12}, {12, 10}};
    const auto edges = edges_of<1>(square, {1.0}, 0.0, 0.0);
    for (int round = 0; round < 2; ++round) {
        ColorBand<1> band({width, height, 1.0, 0}, 0, height);
        band.add(edges, all_of(edges.size()));
        std::vector<float> pixels(width * height, -7.0F);
        band.resolve(pixels);
        EXPECT_FLOAT_EQ(pixels[11 * width + 11], -6.0F);
        EXPECT_FLOAT_EQ(pixels[11 * width + 40], -7.0F) << "not touched";
        EXPECT_FLOAT_EQ(pixels[20 * width + 11], -7.0F) << "in the touched columns";
    }
}

TEST(ColorRaster, SmallerPicturesHoldTheSameLight) {
    // Well inside the frame, so that no light is in the margins.
    const std::vector<Point> quad = {{12.3, 9.1}, {13.7, 24.2}, {41.8, 26.9}, {50.1, 8.4}};
    const auto edges = edges_of<1>(quad, {2.0}, 0.03, -0.01);
    const PixelFrame frame{width, height, 1.0, 0.0, 0.0};
    double full = 0.0;
    for (int level = 0; level < picture_levels; ++level) {
        const RasterSize size = level_size(frame, level);
        ColorBand<1> band(size, 0, size.height_px);
        band.add(edges, all_of(edges.size()));
        const ColorPoint<1> point{30.5, 16.5, {3.0}};
        band.add(point);
        std::vector<float> pixels(
            static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px),
            0.0F);
        band.resolve(pixels);
        double sum = 0.0;
        for (const float value : pixels) sum += static_cast<double>(value);
        sum *= std::pow(4.0, level);
        if (level == 0)
            full = sum;
        else
            EXPECT_NEAR(sum, full, 1e-5 * full) << "level " << level;
    }
}

TEST(PictureLevels, BringingUpConservesLightAndKeepsConstants) {
    const PixelFrame frame{48, 32, 1.0, 0.0, 0.0};
    const RasterSize fine = level_size(frame, 1), coarse = level_size(frame, 2);
    std::vector<float> from(
        static_cast<std::size_t>(coarse.width_px) * static_cast<std::size_t>(coarse.height_px),
        0.0F);
    std::vector<float> to(
        static_cast<std::size_t>(fine.width_px) * static_cast<std::size_t>(fine.height_px), 0.0F);
    from[static_cast<std::size_t>(4 * coarse.width_px + 5)] = 1.0F;
    add_coarser_rows<1>(from, coarse, fine, 0, fine.height_px, to);
    double sum = 0.0;
    for (const float value : to) sum += static_cast<double>(value);
    EXPECT_NEAR(sum, 4.0, 1e-6);  // one coarse pixel is four fine ones

    std::fill(from.begin(), from.end(), 3.0F);
    std::fill(to.begin(), to.end(), 0.0F);
    add_coarser_rows<1>(from, coarse, fine, 0, fine.height_px, to);
    for (const float value : to) ASSERT_FLOAT_EQ(value, 3.0F);
}

}  // namespace
}  // namespace ghostlight
