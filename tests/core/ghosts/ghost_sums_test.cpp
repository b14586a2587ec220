#include "core/ghosts/ghost_sums.h"

#include <gtest/gtest.h>

#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

GhostRow ghost(std::vector<std::size_t> turns, double flux_mm2, double on_sensor) {
    GhostRow row;
    row.path.reflections = std::move(turns);
    row.flux_mm2 = flux_mm2;
    row.on_sensor = on_sensor;
    return row;
}

/// Air | 1 glass | 2 glass (cemented) | air | stop | 3 glass | air.
Prescription triplet() {
    return lens_of({row(50, 3, 1.5), row(-50, 2, 1.6), row(0, 2, 1), row(0, 2, 1), row(40, 3, 1.5),
                    row(-40, 40, 1)},
                   3);
}

TEST(GhostSums, ElementsAreNumberedFromTheFront) {
    EXPECT_EQ(elements_of(triplet()),
              (std::vector<std::string>{"1", "1+2", "2", "", "3", "3", "sensor"}));
}

TEST(GhostSums, EachGhostCountsAtEachOfItsSurfaces) {
    GhostTable table;
    table.ghosts = {ghost({5, 2}, 4.0, 0.5), ghost({2, 0}, 2.0, 1.0),
                    ghost({5, 2, 5, 0}, 1.0, 0.0)};
    const GhostSum all = sum_of(table);
    EXPECT_EQ(all.flux_mm2, 7.0);
    EXPECT_EQ(all.on_sensor_mm2, 4.0);
    EXPECT_EQ(all.ghosts, 3U);
    const auto sums = sums_by_surface(table);
    ASSERT_EQ(sums.size(), 3U);
    EXPECT_EQ(sums[0].surface, 2U);
    EXPECT_EQ(sums[0].sum.flux_mm2, 7.0);
    EXPECT_EQ(sums[1].surface, 5U);
    EXPECT_EQ(sums[1].sum.flux_mm2, 5.0);  // the third ghost turns there twice and counts once
    EXPECT_EQ(sums[1].sum.ghosts, 2U);
    EXPECT_EQ(sums[2].sum.flux_mm2, 3.0);
}

TEST(GhostSums, PairsOfElementsAddUpToTheTwoReflectionGhosts) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    const auto table = ghost_table(lens, {.light = {8.0, 90.0}, .tolerance = 0.05, .peaks = false});
    double flux = 0.0;
    std::size_t ghosts = 0;
    for (const ElementSum& each : sums_by_element(*table, lens)) {
        flux += each.sum.flux_mm2;
        ghosts += each.sum.ghosts;
    }
    EXPECT_NEAR(flux, sum_of(*table).flux_mm2, 1e-12);
    EXPECT_EQ(ghosts, table->ghosts.size());
    double twice = 0.0;
    for (const SurfaceSum& each : sums_by_surface(*table)) twice += each.sum.flux_mm2;
    EXPECT_NEAR(twice, 2.0 * flux, 1e-12);
}

}  // namespace
}  // namespace ghostlight
