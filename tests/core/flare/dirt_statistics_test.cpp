#include "core/flare/dirt_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace ghostlight {
namespace {

TEST(DirtStatistics, SpecksOfOneSizeAreCountedByTheirArea) {
    StopDirt dirt;
    dirt.dust_coverage = 0.02;
    dirt.dust_smallest_mm = dirt.dust_largest_mm = 0.1;
    constexpr double a_mm = 10.0;
    // n specks of area s at random on the circle S leave (1 − s/S)^n of it free on average.
    const double share = 0.1 * 0.1 / (4.0 * a_mm * a_mm);
    const double count = std::log(1.0 - 0.02) / std::log(1.0 - share);
    EXPECT_NEAR(expected_specks(dirt, a_mm), count, 1e-4 * count);  // share is 2.5e-5
    dirt.dust_coverage = 0.0;
    EXPECT_EQ(expected_specks(dirt, a_mm), 0.0);
}

TEST(DirtStatistics, SpecksOfManySizesHaveTheMeanAreaOfTheirSpread) {
    StopDirt dirt;
    dirt.dust_coverage = 0.05;
    dirt.dust_smallest_mm = 0.02;
    dirt.dust_largest_mm = 0.4;
    constexpr double a_mm = 8.0;
    // The mean of d² over log-uniform d, by the midpoint rule.
    constexpr int steps = 20'000;
    double mean_square = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double t = (k + 0.5) / steps;
        mean_square += std::pow(0.02 * std::pow(20.0, t), 2) / steps;
    }
    const double count = -std::log(0.95) * 4.0 * a_mm * a_mm / mean_square;
    EXPECT_NEAR(expected_specks(dirt, a_mm), count, 1e-6 * count);
}

TEST(DirtStatistics, EachKindTakesItsShareAndTogetherTheyTakeLessThanTheSum) {
    StopMask mask;
    mask.semi_diameter_mm = 10.0;
    StopDirt dirt;
    dirt.dust_coverage = 0.05;
    dirt.scratches = 40;
    dirt.fingerprint = 0.3;
    const DirtStatistics found = dirt_statistics(mask, dirt);
    EXPECT_NEAR(found.dust_share, 0.05, 0.01);  // one draw of some hundreds of specks
    EXPECT_GT(found.scratch_share, 0.0);
    EXPECT_GT(found.print_share, 0.0);
    const double sum = found.dust_share + found.scratch_share + found.print_share;
    const double taken = 1.0 - found.clear_share;
    EXPECT_LT(taken, sum);  // where they overlap light is taken once
    EXPECT_GT(taken, std::max({found.dust_share, found.scratch_share, found.print_share}));
    const DirtStatistics clean = dirt_statistics(mask, {});
    EXPECT_EQ(clean.clear_share, 1.0);
    EXPECT_EQ(clean.dust_share + clean.scratch_share + clean.print_share, 0.0);
}

TEST(DirtStatistics, ArmsFollowTheEdges) {
    // An edge sends light to both sides, and edges that are parallel share their arms.
    Stop stop;
    EXPECT_EQ(starburst_arms(stop), 0);
    for (int blades = 3; blades <= 20; ++blades) {
        stop.blades = blades;
        std::set<long> directions;  // in thousandths of a turn
        for (int edge = 0; edge < blades; ++edge) {
            for (const double side : {0.0, 0.5}) {
                const double turn = std::fmod(static_cast<double>(edge) / blades + side, 1.0);
                directions.insert(std::lround(turn * 1e6) % 1'000'000);
            }
        }
        EXPECT_EQ(starburst_arms(stop), static_cast<int>(directions.size())) << blades;
    }
    stop.blade_curvature = 1.0;
    EXPECT_EQ(starburst_arms(stop), 0);
}

}  // namespace
}  // namespace ghostlight
