#include "core/ghosts/four_reflections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "core/ghosts/ghost_table.h"
#include "core/ghosts/incoherent_stack.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(FourReflections, AreCountedWithoutBeingFormed) {
    const std::vector<double> all(33, 0.01);
    const RankedPaths ranked = strongest_four_reflections({all, all}, 100.0, 5, 0.0);
    EXPECT_EQ(ranked.count, 232'408U);
    EXPECT_NEAR(ranked.flux_bound_mm2, 232'408 * 100.0 * 1e-8, 1e-12);
    EXPECT_EQ(ranked.strongest.size(), 5U);
}

TEST(FourReflections, ComeOutByTheirBoundEachOnce) {
    Random random(3);
    LargestReflectances bounds;
    for (int row = 0; row < 8; ++row) {
        bounds.forward.push_back(row == 2 ? 0.0 : random.between(0.001, 0.9));
        bounds.backward.push_back(row == 2 ? 0.0 : random.between(0.001, 0.9));
    }
    std::vector<std::pair<double, GhostPath>> expected;
    double sum = 0.0;
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < i; ++j)
            for (std::size_t k = j + 1; k < 8; ++k)
                for (std::size_t l = 0; l < k; ++l) {
                    const double bound = bounds.forward[i] * bounds.backward[j] *
                                         bounds.forward[k] * bounds.backward[l];
                    if (bound > 0.0) expected.push_back({bound, GhostPath{{i, j, k, l}}});
                    sum += bound;
                }
    std::ranges::sort(expected, [](const auto& a, const auto& b) { return a.first > b.first; });
    const RankedPaths ranked = strongest_four_reflections(bounds, 1.0, 100'000, 0.0);
    ASSERT_EQ(ranked.count, expected.size());
    ASSERT_GE(ranked.strongest.size() + 1, expected.size());  // the last may be within rounding
    EXPECT_NEAR(ranked.flux_bound_mm2, sum, 1e-12 * sum);
    // Paths that differ in the order of their factors have one bound: compared as a set.
    std::set<GhostPath> paths;
    for (std::size_t k = 0; k < ranked.strongest.size(); ++k) {
        EXPECT_NEAR(ranked.strongest[k].flux_bound_mm2, expected[k].first, 1e-15);
        EXPECT_TRUE(paths.insert(ranked.strongest[k].path).second) << k;
    }
    for (std::size_t k = 0; k + 1 < expected.size(); ++k)
        if (!paths.contains(expected[k].second)) {
            EXPECT_NEAR(expected[k].first, expected.back().first, 1e-12 * sum) << k;
        }
    // Until the rest is small enough.
    const RankedPaths some = strongest_four_reflections(bounds, 1.0, 100'000, 0.3 * sum);
    double taken = 0.0;
    for (const BoundedPath& each : some.strongest) taken += each.flux_bound_mm2;
    EXPECT_LE(sum - taken, 0.3 * sum * (1.0 + 1e-12));
    EXPECT_GT(sum - taken + some.strongest.back().flux_bound_mm2, 0.3 * sum);
}

GhostTable four_of(const Prescription& lens, double field_deg, std::size_t most) {
    GhostTableRequest request{.light = {field_deg, 90.0}, .tolerance = 0.05, .peaks = false};
    request.four_reflections = most;
    return ghost_table(lens, request).value();
}

TEST(FourReflections, AreRankedWithTheOthersAndTheRestIsBounded) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    for (const double field : {0.0, 12.0}) {
        // Uncoated, so that both orders matter.
        Prescription bare = lens;
        for (Surface& surface : bare.surfaces) surface.coating = Uncoated{};
        const GhostTable all = four_of(bare, field, 100'000);
        std::size_t four = 0;
        double flux_of_four = 0.0;
        for (const GhostRow& row : all.ghosts)
            if (row.path.reflections.size() == 4) {
                ++four;
                flux_of_four += row.flux_mm2;
            }
        EXPECT_EQ(four + all.not_traced.count, 190U);
        EXPECT_TRUE(std::ranges::is_sorted(all.ghosts, std::greater{}, &GhostRow::flux_mm2));
        const GhostTable few = four_of(bare, field, 3);
        double flux_of_few = 0.0;
        for (const GhostRow& row : few.ghosts)
            if (row.path.reflections.size() == 4) flux_of_few += row.flux_mm2;
        EXPECT_EQ(few.not_traced.count, 187U);
        EXPECT_GE(few.not_traced.flux_bound_mm2, flux_of_four - flux_of_few);
    }
}

/// Plates in a row behind a stop of 5 mm.
Prescription plates(int count) {
    std::vector<Surface> rows = {row(0.0, 2.0, 1.0, 5.0)};
    for (int k = 0; k < count; ++k) {
        rows.push_back(row(0.0, 3.0, 1.5 + 0.1 * k));
        rows.push_back(row(0.0, 3.0, 1.0));
    }
    return lens_of(rows);
}

TEST(FourReflections, OfPlatesAddUpToTheIncoherentStack) {
    const Prescription lens = plates(3);
    const GhostTable table = four_of(lens, 0.0, 100'000);
    double two = 0.0, four = 0.0;
    for (const GhostRow& row : table.ghosts)
        (row.path.reflections.size() == 4 ? four : two) += row.flux_mm2;
    const auto shares = shares_by_reflections(compile(lens, d_line_nm), 4);
    const double disc = std::numbers::pi * 25.0;
    constexpr double tolerance = 0.005;  // relative: grids of a disc
    EXPECT_NEAR(table.direct.flux_mm2, disc * shares[0], tolerance * disc * shares[0]);
    EXPECT_NEAR(two, disc * shares[2], tolerance * disc * shares[2]);
    const double left_out = table.not_traced.flux_bound_mm2;
    EXPECT_LE(four, disc * shares[4] * (1.0 + tolerance));
    EXPECT_GE(four + left_out, disc * shares[4] * (1.0 - tolerance));
    EXPECT_LT(left_out, 0.06 * two);
}

TEST(IncoherentStack, OnePlateIsTheTextbooksSeries) {
    // T² R², R = 0.04: the sum over all orders is (1 − R)²/(1 − R²).
    const auto shares = shares_by_reflections(compile(plates(1), d_line_nm), 60);
    const double r = 0.04, t = 0.96;
    EXPECT_NEAR(shares[0], t * t, 1e-14);
    EXPECT_NEAR(shares[2], t * t * r * r, 1e-14);
    EXPECT_NEAR(shares[4], t * t * r * r * r * r, 1e-14);
    double sum = 0.0;
    for (const double share : shares) sum += share;
    EXPECT_NEAR(sum, (1.0 - r) * (1.0 - r) / (1.0 - r * r), 1e-14);
    EXPECT_NEAR(higher_order_share(compile(plates(1), d_line_nm)), r * r / (1.0 - r * r), 1e-12);
}

}  // namespace
}  // namespace ghostlight
