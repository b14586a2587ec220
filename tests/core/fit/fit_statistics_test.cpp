// Non-negative least squares, by the conditions of Karush, Kuhn and Tucker.

#include "core/fit/fit_statistics.h"

#include <gtest/gtest.h>

#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(FitStatistics, NonNegativeLeastSquaresMeetsItsConditions) {
    Random random(7);
    for (int turn = 0; turn < 20; ++turn) {
        const int rows = 30, columns = 8;
        Eigen::MatrixXd a(rows, columns);
        Eigen::VectorXd b(rows);
        for (int i = 0; i < rows; ++i) {
            b(i) = random.between(-1.0, 1.0);
            for (int k = 0; k < columns; ++k) a(i, k) = random.between(-1.0, 1.0);
        }
        const Eigen::MatrixXd normal = a.transpose() * a;
        const Eigen::VectorXd right = a.transpose() * b;
        const Eigen::VectorXd g = non_negative_least_squares(normal, right);
        const Eigen::VectorXd slope = normal * g - right;
        for (int k = 0; k < columns; ++k) {
            EXPECT_GE(g(k), 0.0);
            EXPECT_GE(slope(k), -1e-9);               // no descent inwards
            EXPECT_NEAR(g(k) * slope(k), 0.0, 1e-9);  // free ones are at rest
        }
    }
}

TEST(FitStatistics, DirectionsAreTheLeastKnownFirst) {
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(3, 3);
    covariance.diagonal() << 0.01, 1.0, 0.25;
    const Directions found = directions(covariance, 3);
    EXPECT_NEAR(found.narrowed(0), 1.0, 1e-12);
    EXPECT_NEAR(found.narrowed(1), 0.5, 1e-12);
    EXPECT_NEAR(std::abs(found.vectors(1, 0)), 1.0, 1e-12);
}

}  // namespace
}  // namespace ghostlight
