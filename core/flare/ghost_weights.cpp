#include "core/flare/ghost_weights.h"

#include <algorithm>
#include <cmath>

#include "core/flare/color_raster.h"
#include "core/flare/ghost_measures.h"
#include "core/flare/grid_light.h"

namespace ghostlight {
namespace {

constexpr int few_cells = 4;  ///< where more error is allowed than least_error
constexpr int polarised_cells = 6;
constexpr int closer_cells = 12;        ///< where few of those rays are valid
constexpr std::size_t few_valid = 4;    ///< one of so many
constexpr double least_error = 1e-3;    ///< of the light: more is looked at more closely
constexpr double steeper_by_rad = 0.1;  ///< than the rays of a grid may be those between them

/// Rays of a half grid that get through all clear radii, and their neighbours, valid or not.
std::vector<char> beside_light(const MirrorGrid& grid) {
    const int across = grid.half_side(), rows = grid.side();
    std::vector<char> lit(grid.half.size(), 0);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < across; ++i) {
            const auto k = static_cast<std::size_t>(j * across + i);
            if (grid.half.margin[k] < 0.0F || grid.half.r_rel[k] > 1.0F) continue;
            for (int n = std::max(0, j - 1); n <= std::min(rows - 1, j + 1); ++n)
                for (int m = std::max(0, i - 1); m <= std::min(across - 1, i + 1); ++m)
                    lit[static_cast<std::size_t>(n * across + m)] = 1;
        }
    return lit;
}

}  // namespace

PolarisedShare polarised_share(const FlareScene& scene, const TracePath<float>& path,
                               const BeamFrame& beam, const PupilBox& box, double allowed_error) {
    PolarisedShare result;
    if (scene.coating_model != CoatingModel::exact) return result;
    const double allowed = std::max(least_error, allowed_error);
    for (const int cells : {few_cells, polarised_cells, closer_cells}) {
        if (cells == few_cells && !(allowed > least_error)) continue;
        result.grid.box = box;
        result.grid.cells = cells;
        trace_mirrored(path, beam, Weights::polarised, result.grid);
        const Bundle<float>& rays = result.grid.half;
        result.ratio.assign(rays.size(), 1.0F);
        std::size_t valid = 0;
        double sum = 0.0;
        for (std::size_t k = 0; k < rays.size(); ++k) {
            if (rays.margin[k] < 0.0F || !(rays.weight_average[k] > 0.0F)) continue;
            result.ratio[k] = rays.weight[k] / rays.weight_average[k];
            sum += static_cast<double>(result.ratio[k]);
            ++valid;
        }
        const float mean = valid > 0 ? static_cast<float>(sum / static_cast<double>(valid)) : 1.0F;
        for (std::size_t k = 0; k < rays.size(); ++k)
            if (rays.margin[k] < 0.0F || !(rays.weight_average[k] > 0.0F)) result.ratio[k] = mean;
        result.error = roughness(result.grid, result.ratio);
        if (few_valid * valid >= rays.size() && result.error < allowed) break;
    }
    return result;
}

std::vector<float> ghost_weights(const FlareScene& scene, const TracePath<float>& path,
                                 const MirrorGrid& grid, const PolarisedShare& polarised) {
    std::vector<float> weights;
    scene.films.weights(path, grid.half, weights);
    if (grid.other.size() > 0) {
        std::vector<float> others;
        scene.films.weights(path, grid.other, others);
        for (std::size_t k = 0; k < weights.size(); ++k)
            weights[k] = 0.5F * (weights[k] + others[k]);
    }
    const std::size_t stride = scene.films.stride();
    const Bundle<float>& rays = grid.half;
    if (grid.is_polarised) {
        for (std::size_t k = 0; k < rays.size(); ++k) {
            const float average = rays.weight_average[k];
            const float own = average > 0.0F ? rays.weight[k] / average : 0.0F;
            for (std::size_t w = 0; w < stride; ++w) weights[k * stride + w] *= own;
        }
    } else if (!polarised.ratio.empty()) {
        const std::vector<float> ratio =
            interpolate_smooth(polarised.grid, polarised.ratio, grid.cells);
        for (std::size_t k = 0; k < ratio.size(); ++k)
            for (std::size_t w = 0; w < stride; ++w) weights[k * stride + w] *= ratio[k];
    }
    fill_failed(grid, static_cast<int>(stride), weights);
    return weights;
}

template <int C>
std::vector<float> ray_light(const FlareScene& scene, const MirrorGrid& grid,
                             const std::vector<float>& weights, const std::vector<float>& shares) {
    const std::size_t stride = scene.films.stride();
    std::vector<float> light(grid.half.size() * C, 0.0F);
    for (std::size_t k = 0; k < grid.half.size(); ++k)
        for (std::size_t w = 0; w < scene.samples.size(); ++w) {
            const float value = weights[k * stride + w];
            for (std::size_t c = 0; c < C; ++c) light[k * C + c] += shares[w * C + c] * value;
        }
    correct_means(grid, C, light);
    return light;
}
template std::vector<float> ray_light<gray_channels>(const FlareScene&, const MirrorGrid&,
                                                     const std::vector<float>&,
                                                     const std::vector<float>&);
template std::vector<float> ray_light<color_channels>(const FlareScene&, const MirrorGrid&,
                                                      const std::vector<float>&,
                                                      const std::vector<float>&);

double box_bound_mm2(const FlareScene& scene, const TracePath<float>& path,
                     const MirrorGrid& grid) {
    double bound = grid.box.area_mm2();
    const std::vector<char> lit = beside_light(grid);
    if (std::ranges::none_of(lit, [](char is_lit) { return is_lit != 0; })) return bound;
    for (std::size_t s = 0; s < path.steps.size(); ++s) {
        const TraceStep<float>& step = path.steps[s];
        if (!step.reflects) continue;
        const float* cosines = grid.half.cosines.data() + s * grid.half.cosine_stride;
        float least = 1.0F;
        for (std::size_t k = 0; k < lit.size(); ++k)
            if (lit[k] != 0) least = std::min(least, cosines[k] >= 0.0F ? cosines[k] : 0.0F);
        const double steepest_rad = std::acos(static_cast<double>(least)) + steeper_by_rad;
        bound *=
            scene.films.most_reflected(static_cast<std::size_t>(step.surface), step.sense > 0.0F,
                                       steepest_rad < 1.57 ? std::cos(steepest_rad) : 0.0);
    }
    return bound;
}

}  // namespace ghostlight
