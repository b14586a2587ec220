#include "core/ghosts/ghost_path.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

OpticalSystem triplet() {
    // Seven rows: the stop (5) never reflects; 3 is cemented with equal media.
    return compile(
        lens_of({row(20.0, 2.0, 1.6), row(-50.0, 2.0, 1.5), row(0.0, 2.0, 1.5), row(0.0, 2.0, 1.0),
                 row(0.0, 2.0, 1.0), row(30.0, 2.0, 1.6), row(-30.0, 20.0, 1.0)},
                4),
        d_line_nm);
}

TEST(GhostPath, PairsOfTheSurfacesThatReflect) {
    const OpticalSystem system = triplet();
    const auto ghosts = two_reflection_ghosts(system);
    EXPECT_EQ(ghosts.size(), 10U);  // 5 surfaces: n(n−1)/2
    for (const GhostPath& ghost : ghosts) {
        ASSERT_EQ(ghost.reflections.size(), 2U);
        EXPECT_GT(ghost.reflections[0], ghost.reflections[1]);
        for (const std::size_t s : ghost.reflections) EXPECT_TRUE(system.surfaces[s].reflects);
    }
}

TEST(GhostPath, NamesCountFromOneAndReadBack) {
    const OpticalSystem system = triplet();
    EXPECT_EQ(name(GhostPath{}), "direct");
    EXPECT_EQ(name(GhostPath{{3, 0}}), "4-1");
    EXPECT_EQ(parse_ghost("direct", system), GhostPath{});
    for (const GhostPath& ghost : two_reflection_ghosts(system))
        EXPECT_EQ(parse_ghost(name(ghost), system), ghost);
    EXPECT_EQ(parse_ghost("6-2-7-1", system), (GhostPath{{5, 1, 6, 0}}));
}

TEST(GhostPath, NamesThatLightCannotFollowAreRefused) {
    const OpticalSystem system = triplet();
    for (const char* text : {"", "1", "1-4", "4-4", "4-1-2", "8-1", "0-1", "5-1", "4-3", "4-", "-4",
                             "4-1-", "a-b", "4-1-1-1", "4.0-1", "99999999999999999999-1"})
        EXPECT_NE(error_of([&] { parse_ghost(text, system); }).found.find(text), std::string::npos)
            << text;
}

TEST(GhostPath, EventsGoFromSurfaceToNeighbour) {
    const OpticalSystem system = triplet();
    std::vector<GhostPath> paths = two_reflection_ghosts(system);
    paths.push_back({});
    paths.push_back({{5, 1, 6, 0}});
    for (const GhostPath& path : paths) {
        const auto all = events(path, 7);
        EXPECT_EQ(all.front().surface, 0U);
        EXPECT_TRUE(all.front().forward);
        EXPECT_EQ(all.back().surface, 6U);
        std::vector<std::size_t> turned;
        bool forward = true;
        for (std::size_t k = 0; k < all.size(); ++k) {
            EXPECT_EQ(all[k].forward, forward) << name(path) << " event " << k;
            if (all[k].reflects) {
                turned.push_back(all[k].surface);
                forward = !forward;
            }
            if (k + 1 < all.size()) {
                EXPECT_EQ(all[k + 1].surface, forward ? all[k].surface + 1 : all[k].surface - 1);
            }
        }
        EXPECT_TRUE(forward) << "towards the sensor in the end";
        EXPECT_EQ(turned, path.reflections);
    }
    EXPECT_EQ(events(GhostPath{{3, 1}}, 7).size(), 7U + 2U * 2U);
}

}  // namespace
}  // namespace ghostlight
