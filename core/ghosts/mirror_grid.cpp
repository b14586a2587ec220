#include "core/ghosts/mirror_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>

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

void lay_other_half(MirrorGrid& grid) {
    grid.other.keep_cosines = grid.half.keep_cosines;
    grid.other.v_mm = grid.half.v_mm;
    grid.other.u_mm.resize(grid.half.size());
    std::ranges::transform(grid.half.u_mm, grid.other.u_mm.begin(), std::negate{});
}

void take_mean_of_halves(MirrorGrid& grid) {
    Bundle<float>&half = grid.half, &other = grid.other;
    for (std::size_t k = 0; k < half.size(); ++k) {
        half.x_mm[k] = 0.5F * (half.x_mm[k] - other.x_mm[k]);
        half.y_mm[k] = 0.5F * (half.y_mm[k] + other.y_mm[k]);
        half.margin[k] = std::min(half.margin[k], other.margin[k]);
        half.r_rel[k] = std::max(half.r_rel[k], other.r_rel[k]);
    }
    for (std::size_t k = 0; k < half.weight.size(); ++k)
        half.weight[k] = 0.5F * (half.weight[k] + other.weight[k]);
    for (std::size_t k = 0; k < half.weight_average.size(); ++k)
        half.weight_average[k] = 0.5F * (half.weight_average[k] + other.weight_average[k]);
}

void trace_mirrored(const TracePath<float>& path, const BeamFrame& frame, Weights weights,
                    MirrorGrid& grid) {
    lay_mirrored(grid);
    trace_bundle(path, frame, weights, grid.half);
    grid.is_polarised = weights == Weights::polarised;
}

}  // namespace ghostlight
