// Tabulated films against the films themselves.
#include "core/flare/film_tables.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/ghosts/ghost_path.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(FilmTables, WeightsAreTheProductsOfTheFilms) {
    // Linear between 257 cosines: some 1e-3 of the little R of a coated surface seen from the
    // glass, and a ghost has two of them.
    constexpr double tolerance = 0.01;
    // Well before the onset of total reflection, where R turns within one node: pictures trace
    // such cells with the films themselves.
    constexpr double least_cosine = 0.88;
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    std::vector<OpticalSystem> systems;
    for (const double nm : {420.0, 500.0, 587.5618, 650.0}) systems.push_back(compile(lens, nm));
    // More than one vector of wavelengths, so that both parts are looked up.
    for (int k = 0; k < 14; ++k) systems.push_back(compile(lens, 430.0 + 15.0 * k));
    const FilmTables tables(systems, 1);
    const FilmTables single({systems[1]}, 1);
    EXPECT_EQ(single.stride(), 1U);
    Random random(7);
    for (const GhostPath& ghost : two_reflection_ghosts(systems.front())) {
        const auto path = trace_path<float>(systems.front(), ghost);
        Bundle<float> rays;
        constexpr std::size_t count = 21;  // odd: rays go in pairs
        rays.u_mm.assign(count, 0.0F);
        rays.v_mm.assign(count, 0.0F);
        rays.cosine_stride = count;
        for (std::size_t k = 0; k < path.steps.size() * count; ++k)
            rays.cosines.push_back(static_cast<float>(random.between(least_cosine, 1.0)));
        std::vector<float> weights, of_one;
        tables.weights(path, rays, weights);
        single.weights(path, rays, of_one);
        // The same sums, of which some may be fused.
        for (std::size_t ray = 0; ray < count; ++ray)
            ASSERT_NEAR(of_one[ray] / weights[ray * tables.stride() + 1], 1.0, 1e-5);
        for (std::size_t ray = 0; ray < count; ++ray)
            for (std::size_t w = 0; w < systems.size(); ++w) {
                double product = 1.0;
                for (std::size_t s = 0; s < path.steps.size(); ++s) {
                    const auto& step = path.steps[s];
                    const Film& own =
                        systems[w].surfaces[static_cast<std::size_t>(step.surface)].film;
                    const Reflectances at =
                        reflectances(step.sense > 0.0F ? own : reversed(own),
                                     static_cast<double>(rays.cosines[s * count + ray]));
                    product *= step.reflects ? at.r() : at.t();
                }
                ASSERT_NEAR(weights[ray * tables.stride() + w], product, tolerance * product)
                    << name(ghost) << " at " << systems[w].wavelength_nm << " nm";
            }
    }
}

}  // namespace
}  // namespace ghostlight
