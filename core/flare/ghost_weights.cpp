#include "core/flare/ghost_weights.h"

#include <algorithm>
#include <cmath>

#include "core/flare/color_raster.h"
#include "core/flare/ghost_measures.h"
#include "core/flare/grid_light.h"

namespace ghostlight {
namespace {

constexpr int polarised_cells = 6;
constexpr int closer_cells = 12;      ///< where few of those rays are valid
constexpr std::size_t few_valid = 4;  ///< one of so many
constexpr double least_error = 1e-3;  ///< of the light: more is looked at more closely
/// Where films give hardly any light at one wavelength's angles, ratios mean nothing.
constexpr float least_color_ratio = 0.25F, most_color_ratio = 4.0F;
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

/// The sample whose wavelength the main geometry has.
std::size_t main_sample(const FlareScene& scene) {
    return static_cast<std::size_t>(std::ranges::find(scene.samples, scene.system().wavelength_nm,
                                                      &SpectralSample::wavelength_nm) -
                                    scene.samples.begin());
}

}  // namespace

PolarisedShare polarised_share(const FlareScene& scene, const TracePath<float>& path,
                               const BeamFrame& beam, const PupilBox& box) {
    PolarisedShare result;
    if (scene.coating_model != CoatingModel::exact) return result;
    for (const int cells : {polarised_cells, closer_cells}) {
        result.grid.box = box;
        result.grid.cells = cells;
        result.grid.half.keep_cosines = !scene.is_gray();
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
        if (few_valid * valid >= rays.size() && result.error < least_error) break;
    }
    return result;
}

namespace {

/// Of polarisation's effect where planes of incidence are one, what a ray has at the main
/// wavelength: the cosine of twice the angle between those planes, as far as two matter.
float share_of_polarisation(float ratio, float in_one_plane) {
    constexpr float least = 1e-3F, most = 1.5F;
    const float effect = in_one_plane - 1.0F;
    return std::abs(effect) > least ? std::clamp((ratio - 1.0F) / effect, -most, most) : 1.0F;
}

}  // namespace

bool ColorShare::is_for(const FlareScene& scene) const {
    return std::ranges::equal(samples_nm, scene.samples, {}, {}, &SpectralSample::wavelength_nm);
}

ColorShare color_share(const FlareScene& scene, const GhostPath& path, const BeamFrame& beam,
                       const PolarisedShare& polarised) {
    ColorShare result;
    for (const SpectralSample& s : scene.samples) result.samples_nm.push_back(s.wavelength_nm);
    if (scene.is_gray() || polarised.ratio.empty()) return result;
    result.cells = polarised.grid.cells;
    const std::size_t samples = scene.samples.size(), stride = scene.films.stride();
    const Bundle<float>& rays = polarised.grid.half;
    std::vector<float> main, in_one_plane, own;
    const auto trace = trace_path<float>(scene.system(), path);
    scene.films.weights(trace, rays, main);
    scene.films.polarisation(trace, rays, in_one_plane);
    std::vector<std::vector<double>> shares;
    for (const SpectralSample& s : scene.samples)
        shares.push_back(scene.interpolation(s.wavelength_nm));
    const std::size_t at_main = main_sample(scene);
    result.ratio.assign(rays.size() * samples, 0.0F);
    for (std::size_t g = 0; g < scene.geometry.size(); ++g) {
        const bool is_main = g == scene.main;
        MirrorGrid grid;
        if (!is_main) {
            grid.box = polarised.grid.box;
            grid.cells = polarised.grid.cells;
            grid.half.keep_cosines = true;
            const auto other = trace_path<float>(scene.geometry[g], path);
            trace_mirrored(other, beam, Weights::none, grid);
            scene.films.weights(other, grid.half, own);
            result.rays += grid.half.size();
        }
        for (std::size_t k = 0; k < rays.size(); ++k) {
            // Where a colour fails the main one stands for it.
            const bool differs = !is_main && grid.half.margin[k] >= 0.0F && rays.margin[k] >= 0.0F;
            for (std::size_t w = 0; w < samples; ++w) {
                const float there = main[k * stride + w];
                const float angles = differs && there > 0.0F ? own[k * stride + w] / there : 1.0F;
                result.ratio[k * samples + w] +=
                    static_cast<float>(shares[w][g]) *
                    std::clamp(angles, least_color_ratio, most_color_ratio);
            }
        }
    }
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const float share =
            share_of_polarisation(polarised.ratio[k], in_one_plane[k * stride + at_main]);
        for (std::size_t w = 0; w < samples; ++w) {
            const float turned = 1.0F + share * (in_one_plane[k * stride + w] - 1.0F);
            result.ratio[k * samples + w] *=
                std::clamp(turned / polarised.ratio[k], least_color_ratio, most_color_ratio);
        }
    }
    return result;
}

std::vector<float> ghost_weights(const FlareScene& scene, const TracePath<float>& path,
                                 const MirrorGrid& grid, const WeightShares& shares) {
    const auto& [polarised, colors] = shares;
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
            interpolate_smooth(polarised.grid.cells, polarised.ratio, 1, grid.cells);
        for (std::size_t k = 0; k < ratio.size(); ++k)
            for (std::size_t w = 0; w < stride; ++w) weights[k * stride + w] *= ratio[k];
    }
    if (!colors.ratio.empty()) {
        const std::size_t samples = scene.samples.size();
        const std::vector<float> ratio =
            interpolate_smooth(colors.cells, colors.ratio, static_cast<int>(samples), grid.cells);
        for (std::size_t k = 0; k < rays.size(); ++k)
            for (std::size_t w = 0; w < samples; ++w)
                weights[k * stride + w] *= std::max(ratio[k * samples + w], 0.0F);
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

template <int C>
std::vector<float> bundle_light(const FlareScene& scene, const TracePath<float>& path,
                                const Bundle<float>& rays, const std::vector<float>& shares) {
    std::vector<float> light(rays.size() * C, 0.0F);
    if (scene.is_gray()) {
        for (std::size_t k = 0; k < rays.size(); ++k)
            for (std::size_t c = 0; c < C; ++c) light[k * C + c] = shares[c] * rays.weight[k];
        return light;
    }
    const std::size_t stride = scene.films.stride();
    std::vector<float> weights;
    scene.films.weights(path, rays, weights);
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const float average = rays.weight_average[k];
        const float polarised = average > 0.0F ? rays.weight[k] / average : 0.0F;
        for (std::size_t w = 0; w < scene.samples.size(); ++w)
            for (std::size_t c = 0; c < C; ++c)
                light[k * C + c] += shares[w * C + c] * polarised * weights[k * stride + w];
    }
    return light;
}
template std::vector<float> bundle_light<gray_channels>(const FlareScene&, const TracePath<float>&,
                                                        const Bundle<float>&,
                                                        const std::vector<float>&);
template std::vector<float> bundle_light<color_channels>(const FlareScene&, const TracePath<float>&,
                                                         const Bundle<float>&,
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
