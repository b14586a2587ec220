#include "core/ghosts/surface_ghosts.h"

#include <gtest/gtest.h>

#include "core/io/lens_file.h"
#include "core/units.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

/// Every ghost turns twice: what the surfaces list, together, is each ghost twice over.
TEST(SurfaceGhostsTest, EveryTurnIsListedOnce) {
    const Prescription lens = read_lens(lens_folder() / "cooke_triplet_50_f5.json").lens;
    GhostTableRequest request;
    request.light.field_deg = 8.0;
    request.tolerance = 0.5;
    request.peaks = false;
    const auto table = ghost_table(lens, request);
    ASSERT_TRUE(table);
    double listed_mm2 = 0.0, all_mm2 = 0.0;
    std::size_t turns = 0;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        double last_mm2 = std::numeric_limits<double>::infinity();
        for (const SurfaceGhost& ghost : ghosts_of_surface(*table, row)) {
            EXPECT_LE(ghost.flux_mm2, last_mm2);
            last_mm2 = ghost.flux_mm2;
            listed_mm2 += ghost.flux_mm2;
            ++turns;
            // A pair i > j meets i on its way to the sensor, and j on its way back.
            EXPECT_EQ(ghost.from_front, ghost.path.reflections[0] == row);
            EXPECT_GE(ghost.turn.largest_incidence_deg, ghost.turn.incidence_deg);
        }
    }
    for (const GhostRow& ghost : table->ghosts) all_mm2 += ghost.flux_mm2;
    EXPECT_EQ(turns, 2 * table->ghosts.size());
    EXPECT_NEAR(listed_mm2 / all_mm2, 2.0, 1e-12);
}

}  // namespace
}  // namespace ghostlight
