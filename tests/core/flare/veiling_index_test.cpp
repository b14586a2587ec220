#include "core/flare/veiling_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/ghosts/ghost_table.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(VeilingIndex, IsTheGhostTablesFluxOverTheSurround) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    VeilingIndexRequest request;
    request.last_deg = 40.0;
    request.fields = 10;
    const VeilingIndex index = *veiling_index(lens, request);
    // The same rings and azimuths by another quadrature.
    double glare = 0.0;
    for (const VeilingRing& ring : index.rings)
        for (int a = 0; a < request.azimuths; ++a) {
            const GhostTable table =
                *ghost_table(lens, {.light = {ring.field_deg, 90.0 * (a + 0.5) / request.azimuths},
                                    .tolerance = 0.02,
                                    .peaks = false});
            double flux = 0.0;
            for (const GhostRow& row : table.ghosts) flux += row.flux_mm2 * row.on_sensor;
            glare += ring.solid_angle_sr * flux / request.azimuths / (36.0 * 24.0);
        }
    // Pictures within 10 % each, which average out, and 0.02 of the tables.
    EXPECT_NEAR(index.glare_sr / glare, 1.0, 0.05);
    EXPECT_GT(index.index(), 0.0);
    EXPECT_LT(index.index(), 0.5);
}

TEST(VeilingIndex, DirectLightOnTheAxisIsThatOfItsFNumber) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    VeilingIndexRequest request;
    request.last_deg = 30.0;
    request.fields = 6;
    request.azimuths = 1;
    const VeilingIndex index = *veiling_index(lens, request);
    const OpticalSystem system = compile(lens, 587.5618);
    const double n = first_order(system).f_number;
    const GhostTable table = *ghost_table(lens, {.light = {0.0, 90.0}, .peaks = false});
    const double pupil = std::numbers::pi * std::pow(first_order(system).efl_mm / n / 2.0, 2);
    // E = π L τ / (4 N²), τ the share of the pupil's light that arrives.
    const double tau = table.direct.flux_mm2 / pupil;
    EXPECT_NEAR(index.center_direct_sr / (std::numbers::pi * tau / (4.0 * n * n)), 1.0, 0.02);
}

TEST(VeilingIndex, CoatingsLowerItAndScatterRaisesIt) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    VeilingIndexRequest request;
    request.last_deg = 30.0;
    request.fields = 6;
    request.azimuths = 2;
    const double bare = veiling_index(with_air_coating(lens, Uncoated{}), request)->index();
    const double coated =
        veiling_index(with_air_coating(lens, QuarterWave{.center_nm = 550.0}), request)->index();
    EXPECT_LT(coated, 0.5 * bare);
    request.spread.share = 0.01;
    const double scattered = veiling_index(with_air_coating(lens, Uncoated{}), request)->index();
    // (g + s)/(1 + g + s) of the direct light.
    const double g = bare / (1.0 - bare);
    EXPECT_NEAR(scattered, (g + 0.01) / (1.0 + g + 0.01), 1e-9);
}

}  // namespace
}  // namespace ghostlight
