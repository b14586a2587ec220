#include "core/flare/polar_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double far_k = 3e4;

PolarPattern pattern_of_stop(int blades, double rotation_rad = 0.0, double curvature = 0.0) {
    return pattern_of(outline_of({1.0, blades, rotation_rad, curvature}), far_k, 2);
}

double ring_share(const PolarPattern& pattern, int ring) {
    double sum = 0.0;
    for (int s = 0; s < PolarPattern::sectors; ++s)
        sum += static_cast<double>(
            pattern.share[static_cast<std::size_t>(ring * PolarPattern::sectors + s)]);
    return sum;
}

TEST(PolarPattern, RoundStopIsAiry) {
    const PolarPattern pattern = pattern_of_stop(0);
    // Born and Wolf, 8.5.2: 83.8 %, 91.0 % and 93.8 % within the first three dark rings.
    EXPECT_NEAR(pattern.encircled(3.8317), 0.838, 5e-4);
    EXPECT_NEAR(pattern.encircled(7.0156), 0.910, 5e-4);
    EXPECT_NEAR(pattern.encircled(10.1735), 0.938, 5e-4);
    // The first dark ring is where its least ring is, to a ring: 1.22 λN is k = 1.22 π.
    int darkest = 0;
    double least = 1.0;
    for (int ring = 0; ring < static_cast<int>(PolarPattern::ring_of(5.5)); ++ring) {
        const double k = PolarPattern::edge_k(ring + 0.5);
        const double per_area = ring_share(pattern, ring) / (k * k);
        if (k > 1.0 && per_area < least) {
            least = per_area;
            darkest = ring;
        }
    }
    EXPECT_NEAR(PolarPattern::edge_k(darkest + 0.5) / pi, 1.22,
                1.22 * (std::exp2(1.0 / PolarPattern::rings_per_octave) - 1.0));
}

TEST(PolarPattern, SumsOverAChordedCircleGoOverIntoAiry) {
    // The same circle given as a polygon without being told: exact sums within, edges beyond.
    ApertureOutline outline = outline_of({1.0, 0, 0.0, 0.0});
    outline.is_unit_circle = false;
    const PolarPattern polygon = pattern_of(outline, far_k, 2), airy = pattern_of_stop(0);
    // Steps of 0.75 in k on fringes of π, linear between: 1e-3 of the light.
    for (const double k : {1.0, 3.8317, 7.0, 20.0, 80.0, 96.0, 200.0, 2000.0})
        EXPECT_NEAR(polygon.encircled(k), airy.encircled(k), 1e-3) << k;
    // Beyond the sums the edges must bring what is left, to their first order: 1 % of it.
    EXPECT_NEAR((1.0 - polygon.encircled(1000.0)) / (1.0 - airy.encircled(1000.0)), 1.0, 0.03);
}

TEST(PolarPattern, FluxIsWhole) {
    for (const int blades : {0, 3, 4, 5, 6, 7, 9, 12})
        for (const double curvature : {0.0, 0.4}) {
            EXPECT_NEAR(pattern_of_stop(blades, 0.1, curvature).total(), 1.0, 1e-5)
                << blades << " blades, curvature " << curvature;
        }
}

/// Before it is made to fit: the sums below some k and the edges' first order beyond it.
TEST(PolarPattern, EdgesBringWhatTheSumsLeave) {
    for (const int blades : {4, 5, 6, 9}) {
        const ApertureOutline outline = outline_of({1.0, blades, 0.1, 0.0});
        const double k = 90.0;
        const double left = 1.0 - pattern_of(outline, far_k, 2).encircled(k);
        // ∫ beyond k of 2·perimeter·2π/k³ · k dk / (4π² area); the next order is 1/k of it.
        EXPECT_NEAR(outline.perimeter() / (pi * outline.area() * k) / left, 1.0, 0.02) << blades;
    }
}

TEST(PolarPattern, SquareIsSincSquared) {
    // The share within a slit |kx| < q of a square of half side h is that of one sinc²: to the
    // sectors' breadth. Compared ring by ring along the axes instead: I(k, 0) / I(0).
    const PolarPattern pattern = pattern_of_stop(4, pi / 4.0);
    const double h = std::sqrt(0.5);
    const double area = 4.0 * h * h;
    for (int ring = static_cast<int>(PolarPattern::ring_of(0.5));
         ring < PolarPattern::ring_of(12.0); ++ring) {
        const double k0 = PolarPattern::edge_k(ring), k1 = PolarPattern::edge_k(ring + 1.0);
        const double k = std::sqrt(0.5 * (k0 * k0 + k1 * k1));
        const double sector = pi / PolarPattern::sectors;
        const double per_area =
            static_cast<double>(
                pattern.share[static_cast<std::size_t>(ring * PolarPattern::sectors)]) /
            ((k1 * k1 - k0 * k0) * sector);
        const double s = std::sin(h * k) / (h * k);
        // Linear between samples 0.1 rad apart at most: a hundredth of the middle's.
        EXPECT_NEAR(per_area / (area / (4.0 * pi * pi)), s * s, 0.01) << k;
    }
}

/// Directions, over the whole turn, where a ring is brighter than both neighbours and than a
/// quarter of the brightest.
int spikes(const PolarPattern& pattern, double k) {
    const auto ring = static_cast<std::size_t>(PolarPattern::ring_of(k));
    const float* share = &pattern.share[ring * PolarPattern::sectors];
    const float brightest = *std::max_element(share, share + PolarPattern::sectors);
    int count = 0;
    for (int s = 0; s < PolarPattern::sectors; ++s) {
        const float before = share[(s + PolarPattern::sectors - 1) % PolarPattern::sectors];
        const float after = share[(s + 1) % PolarPattern::sectors];
        if (share[s] > before && share[s] >= after && share[s] > 0.25F * brightest) ++count;
    }
    return 2 * count;  // half a turn
}

TEST(PolarPattern, EvenStopsHaveAsManySpikesAsBladesOddOnesTwice) {
    for (const int blades : {4, 6, 8, 10})
        EXPECT_EQ(spikes(pattern_of_stop(blades, 0.1), 800.0), blades);
    for (const int blades : {3, 5, 7, 9})
        EXPECT_EQ(spikes(pattern_of_stop(blades, 0.1), 800.0), 2 * blades);
}

TEST(PolarPattern, IsTheSameForAnyNumberOfThreads) {
    const ApertureOutline outline = outline_of({1.0, 7, 0.1, 0.3});
    EXPECT_EQ(pattern_of(outline, 500.0, 1).share, pattern_of(outline, 500.0, 3).share);
}

}  // namespace
}  // namespace ghostlight
