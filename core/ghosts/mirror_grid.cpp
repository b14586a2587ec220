#include "core/ghosts/mirror_grid.h"

#include <cmath>

namespace ghostlight {

void lay_mirrored(MirrorGrid& grid) {
    const int across = grid.half_side(), rows = grid.side();
    Bundle<float>& rays = grid.half;
    rays.u_mm.resize(static_cast<std::size_t>(across * rows));
    rays.v_mm.resize(rays.u_mm.size());
    std::size_t k = 0;
    for (int j = 0; j < rows; ++j) {
        const auto v =
            static_cast<float>(std::lerp(grid.box.v0_mm, grid.box.v1_mm, j / (rows - 1.0)));
        for (int i = 0; i < across; ++i, ++k) {
            rays.u_mm[k] = static_cast<float>(grid.box.u1_mm * i / (across - 1.0));
            rays.v_mm[k] = v;
        }
    }
}

void trace_mirrored(const TracePath<float>& path, const BeamFrame& frame, Weights weights,
                    MirrorGrid& grid) {
    lay_mirrored(grid);
    trace_bundle(path, frame, weights, grid.half);
    grid.is_polarised = weights == Weights::polarised;
}

}  // namespace ghostlight
