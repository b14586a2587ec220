// The table of stiff cases that users see: extreme_test.cpp works such cases out for itself.
#include "core/ghosts/extreme_cases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ghostlight {
namespace {

TEST(ExtremeCases, RoundingIsAllThatIsLost) {
    const auto cases = extreme_cases();
    ASSERT_GE(cases.size(), 15U);
    for (const ExtremeCase& each : cases) {
        EXPECT_TRUE(each.holds()) << each.name << ": " << each.double_error << " above "
                                  << each.double_bound;
        EXPECT_GT(each.double_bound, 0.0) << each.name;
        // What rounding may come to says something: it is small beside the answer.
        EXPECT_LT(each.double_bound, 1e-6 * std::abs(each.expected)) << each.name;
        // 2^29 roundings of double are one of float.
        if (std::isfinite(each.float_error)) {
            EXPECT_LE(each.float_error, 0x1p29 * each.double_bound) << each.name;
        }
    }
}

}  // namespace
}  // namespace ghostlight
