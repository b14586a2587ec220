// Half grids mirrored, against whole ones traced.
#include "core/ghosts/mirror_grid.h"

#include <gtest/gtest.h>

#include "core/ghosts/ghost_path.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(MirrorGrid, TheOtherHalfIsTheMirrorImage) {
    // The beam's azimuth of 90° is rounded, and so is the trace in single precision.
    constexpr float tolerance_mm = 2e-4F;
    const OpticalSystem system = compile(bundled("double_gauss_tronnier_100_f2"), 550.0);
    const BeamFrame frame = beam_frame({9.0, 90.0});
    for (const GhostPath& ghost : two_reflection_ghosts(system)) {
        const auto path = trace_path<float>(system, ghost);
        MirrorGrid grid{{-4.0, 4.0, -5.0, 3.0}, 8, {}};
        trace_mirrored(path, frame, Weights::polarised, grid);
        Bundle<float> whole;
        lay_grid(grid.box, grid.cells, whole);
        trace_bundle(path, frame, Weights::polarised, whole);
        for (int j = 0; j < grid.side(); ++j)
            for (int i = 0; i < grid.side(); ++i) {
                const std::size_t full = static_cast<std::size_t>(j * grid.side() + i);
                const std::size_t half = grid.of_node(i, j);
                if (whole.margin[full] < 0.05F) continue;
                const float sign = grid.is_mirrored(i) ? -1.0F : 1.0F;
                ASSERT_NEAR(sign * grid.half.x_mm[half], whole.x_mm[full], tolerance_mm)
                    << name(ghost) << " " << i << " " << j;
                ASSERT_NEAR(grid.half.y_mm[half], whole.y_mm[full], tolerance_mm);
                ASSERT_NEAR(grid.half.weight[half], whole.weight[full],
                            1e-4F * (whole.weight[full] + 1e-6F));
            }
    }
}

}  // namespace
}  // namespace ghostlight
