// What is made of measured points, by hand.

#include "core/flare/accuracy.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ghostlight {
namespace {

AccuracyPoint point(const char* method, double median_ms, double relative_l1) {
    AccuracyPoint made;
    made.method = method;
    made.median_ms = median_ms;
    made.errors.relative_l1 = relative_l1;
    return made;
}

TEST(Accuracy, TimeForAnErrorFollowsAPowerLaw) {
    // 2 ms / error^(1/2), and another method in between.
    const std::vector<AccuracyPoint> points = {point("a", 20.0, 0.01), point("b", 1.0, 0.02),
                                               point("a", 200.0, 1e-4), point("a", 2.0, 1.0)};
    constexpr double rounding = 1e-12;
    EXPECT_NEAR(time_for_error_ms(points, "a", 1e-3), 2.0 / std::sqrt(1e-3), 200.0 * rounding);
    EXPECT_NEAR(time_for_error_ms(points, "a", 0.25), 4.0, 4.0 * rounding);
    EXPECT_NEAR(time_for_error_ms(points, "a", 1e-4), 200.0, 200.0 * rounding);
    EXPECT_TRUE(std::isnan(time_for_error_ms(points, "a", 2.0))) << "nobody measured that";
    EXPECT_TRUE(std::isnan(time_for_error_ms(points, "b", 0.02))) << "one setting has no curve";
}

TEST(Accuracy, TheFrontIsWhatNothingBeatsInBoth) {
    std::vector<AccuracyPoint> points = {point("a", 1.0, 0.1), point("b", 2.0, 0.2),
                                         point("c", 3.0, 0.01), point("d", 0.5, 0.001),
                                         point("e", 0.4, 0.3)};
    points[3].is_ablation = true;
    mark_front(points);
    EXPECT_TRUE(points[0].on_front);
    EXPECT_FALSE(points[1].on_front) << "a is faster and closer";
    EXPECT_TRUE(points[2].on_front) << "d is no method to choose";
    EXPECT_FALSE(points[3].on_front);
    EXPECT_TRUE(points[4].on_front);
}

}  // namespace
}  // namespace ghostlight
