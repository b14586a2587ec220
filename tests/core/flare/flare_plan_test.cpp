#include "core/flare/flare_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(FlarePlan, SharesOutAllThatIsAllowedAndNoMoreThanAGhostHolds) {
    constexpr double most_share = 0.5;
    Random random(5);
    std::vector<ErrorShare> ghosts;
    double total = 0.0;
    for (int k = 0; k < 200; ++k) {
        const double flux = std::pow(10.0, random.between(-8.0, 0.0));
        ghosts.push_back({flux, flux * random.between(0.0, 2.0)});
        total += flux;
    }
    for (const double tolerance : {0.001, 0.01, 0.1}) {
        const auto shares = share_out(ghosts, tolerance * total, most_share);
        EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), tolerance * total,
                    1e-6 * tolerance * total);
        for (std::size_t g = 0; g < ghosts.size(); ++g) {
            EXPECT_GE(shares[g], 0.0);
            EXPECT_LE(shares[g], most_share * ghosts[g].flux_mm2 * (1.0 + 1e-12));
        }
    }
}

TEST(FlarePlan, GivesAllGhostsTheirMostWhereMoreIsAllowed) {
    const auto shares = share_out({{1.0, 0.0}, {4.0, 1.0}, {0.0, 0.0}}, 100.0, 0.5);
    EXPECT_NEAR(shares[0], 0.5, 1e-9);
    EXPECT_NEAR(shares[1], 2.0, 1e-9);
    EXPECT_EQ(shares[2], 0.0);
}

TEST(FlarePlan, NothingToShare) {
    EXPECT_EQ(share_out({{0.0, 0.0}}, 1.0, 0.5).front(), 0.0);
    EXPECT_EQ(share_out({{1.0, 0.0}}, 0.0, 0.5).front(), 0.0);
    EXPECT_TRUE(share_out({}, 1.0, 0.5).empty());
}

}  // namespace
}  // namespace ghostlight
