#include "core/flare/ghost_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/flare/grid_light.h"
#include "core/optics/coating.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(GhostWeights, SmoothInterpolationIsExactForCubics) {
    // Even in u, as all of a round lens is.
    const auto f = [](double u, double v) {
        return 1.0 + 0.5 * u * u + 0.3 * v - 0.2 * v * v + 0.1 * v * v * v + 0.4 * u * u * v;
    };
    MirrorGrid grid;
    grid.cells = 6;
    std::vector<float> values;
    for (int j = 0; j <= 6; ++j)
        for (int i = 0; i <= 3; ++i)
            values.push_back(static_cast<float>(f(i / 3.0, j / 3.0 - 1.0)));
    constexpr double rounding = 2e-6;
    for (const int cells : {6, 12, 20}) {
        const std::vector<float> fine = interpolate_smooth(grid.cells, values, 1, cells);
        ASSERT_EQ(fine.size(), static_cast<std::size_t>((cells + 1) * (cells / 2 + 1)));
        std::size_t k = 0;
        for (int j = 0; j <= cells; ++j)
            for (int i = 0; i <= cells / 2; ++i, ++k)
                EXPECT_NEAR(static_cast<double>(fine[k]), f(2.0 * i / cells, 2.0 * j / cells - 1.0),
                            rounding);
    }
}

TEST(GhostWeights, AreThoseOfPolarisedRays) {
    const Prescription lens = bundled("double_gauss_tronnier_100_f2");
    const FlareScene scene = flare_scene(lens, Monochromatic{});
    const BeamFrame beam = beam_frame({6.0, 90.0});
    // Tables are good to 1e-3 of R, the interpolated effect of polarisation to the same.
    constexpr double most_off = 0.01;
    int compared = 0;
    for (const GhostPath& path : scene.ghosts) {
        const auto trace = trace_path<float>(scene.system(), path);
        MirrorGrid grid;
        grid.box = {-4.0, 4.0, -4.0, 4.0};
        grid.cells = 12;
        grid.half.keep_cosines = true;
        trace_mirrored(trace, beam, Weights::polarised, grid);
        const std::vector<float> exact = grid.half.weight;
        trace_mirrored(trace, beam, Weights::none, grid);
        // Well before the onset of total reflection, where R turns within one node of a table.
        const auto all_above = [](const std::vector<float>& values, float least) {
            return std::ranges::all_of(values, [=](float value) { return value >= least; });
        };
        bool is_plain = all_above(grid.half.margin, 0.05F);
        for (const auto& onset : grid.half.onset) is_plain = is_plain && all_above(onset, 0.3F);
        if (!is_plain) continue;
        const std::vector<float> weights =
            ghost_weights(scene, trace, grid, {polarised_share(scene, trace, beam, grid.box), {}});
        const float most = *std::ranges::max_element(exact);
        for (std::size_t k = 0; k < exact.size(); ++k)
            EXPECT_NEAR(static_cast<double>(weights[k * scene.films.stride()] / most),
                        static_cast<double>(exact[k] / most), most_off)
                << name(path, lens.surfaces.size());
        ++compared;
    }
    EXPECT_GT(compared, 20);
}

TEST(GhostWeights, TheMostReflectedIsAboveEveryAngleUpToIt) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    const FlareScene scene = flare_scene(lens, Monochromatic{});
    // Between the tables' nodes R is bent, by 1e-3 of itself.
    constexpr double of_itself = 1e-3;
    for (std::size_t s = 0; s < scene.system().surfaces.size(); ++s) {
        const Film& own = scene.system().surfaces[s].film;
        if (is_invisible(own)) continue;
        for (const bool forward : {true, false}) {
            const Film film = forward ? own : reversed(own);
            const double bound = scene.films.most_reflected(s, forward, 0.8);
            const auto largest_from = [&](double least_cosine) {
                double most = 0.0;
                for (double cosine = least_cosine; cosine <= 1.0; cosine += 0.001) {
                    const Reflectances at = reflectances(film, cosine);
                    most = std::max({most, at.r_s, at.r_p});
                }
                return most;
            };
            EXPECT_GE(bound, (1.0 - of_itself) * largest_from(0.8)) << "surface " << s + 1;
            constexpr double node = 1.0 / 256.0;
            EXPECT_LE(bound, (1.0 + of_itself) * largest_from(0.8 - node)) << "surface " << s + 1;
        }
    }
}

}  // namespace
}  // namespace ghostlight
