#include "core/ghosts/weighted_grid.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {
namespace {

constexpr int probe_cells = 8;
constexpr int split_cells = 4;          ///< across a singular cell
constexpr double smooth_enough = 0.01;  ///< roughness of weights that may be interpolated

/// Calls visit(before, node, after) for every odd node of a probe that passes with its two even
/// neighbours, along either direction.
template <class Visit>
void for_each_triple(const RayField<float>& probe, Visit visit) {
    constexpr int side = probe_cells + 1;
    auto passes = [&](std::size_t node) {
        return std::ranges::all_of(probe.clearances,
                                   [&](const auto& c) { return c[node] >= 0.0F; });
    };
    for (int j = 0; j < side; j += 2)
        for (int i = 1; i < side; i += 2)
            for (const bool along_u : {true, false}) {
                const auto step = static_cast<std::size_t>(along_u ? 1 : side);
                const auto node = static_cast<std::size_t>(along_u ? j * side + i : i * side + j);
                if (passes(node - step) && passes(node) && passes(node + step))
                    visit(node - step, node, node + step);
            }
}

/// How far the weights of a probe's odd nodes are from the mean of their even neighbours, flux for
/// flux: about four times the error of interpolating the probe bilinearly.
double roughness(const RayField<float>& probe) {
    double change = 0.0, sum = 0.0;
    const auto& w = probe.rays.weight;
    for_each_triple(probe, [&](std::size_t before, std::size_t node, std::size_t after) {
        change += std::abs(static_cast<double>(w[node]) -
                           0.5 * static_cast<double>(w[before] + w[after]));
        sum += static_cast<double>(w[node]);
    });
    return sum > 0.0 ? change / sum : 1.0;
}

/// Gives the nodes of a grid that was traced without weights the polarised weights of a coarser
/// one, bilinearly: films vary slowly over the pupil, and cost more than the geometry.
void fill_weights(const RayField<float>& probe, BundleGrid<float>& grid) {
    constexpr int side = probe_cells + 1;
    // Failed rays take the mean of their neighbours, so that edges are not darkened.
    std::vector<float> known(probe.rays.weight);
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            if (probe.rays.margin[static_cast<std::size_t>(j * side + i)] >= 0.0F) continue;
            float sum = 0.0F;
            int count = 0;
            for (int n = std::max(0, j - 1); n <= std::min(side - 1, j + 1); ++n)
                for (int m = std::max(0, i - 1); m <= std::min(side - 1, i + 1); ++m) {
                    const auto node = static_cast<std::size_t>(n * side + m);
                    if (probe.rays.margin[node] < 0.0F) continue;
                    sum += probe.rays.weight[node];
                    ++count;
                }
            if (count > 0)
                known[static_cast<std::size_t>(j * side + i)] = sum / static_cast<float>(count);
        }
    auto at = [&](int i, int j) { return known[static_cast<std::size_t>(j * side + i)]; };
    for (int j = 0; j <= grid.cells; ++j)
        for (int i = 0; i <= grid.cells; ++i) {
            const float x = static_cast<float>(i * probe_cells) / static_cast<float>(grid.cells);
            const float y = static_cast<float>(j * probe_cells) / static_cast<float>(grid.cells);
            const int i0 = std::min(static_cast<int>(x), probe_cells - 1);
            const int j0 = std::min(static_cast<int>(y), probe_cells - 1);
            const float fx = x - static_cast<float>(i0), fy = y - static_cast<float>(j0);
            grid.field.rays.weight[static_cast<std::size_t>(j * (grid.cells + 1) + i)] =
                std::lerp(std::lerp(at(i0, j0), at(i0 + 1, j0), fx),
                          std::lerp(at(i0, j0 + 1), at(i0 + 1, j0 + 1), fx), fy);
        }
}

}  // namespace

RayField<float> probe_bundle(const OpticalSystem& system, const TracePath<float>& path,
                             const BeamFrame& frame, const PupilBox& box) {
    Bundle<float> points;
    lay_grid(box, probe_cells, points);
    return trace_field(system, path, frame, std::move(points), Weights::polarised);
}

int cells_for_bend(const RayField<float>& probe, double bend_mm, double reach_mm,
                   int finest_cells) {
    constexpr int unknown_cells = 32;
    double sum = 0.0;
    int count = 0;
    const auto &x = probe.rays.x_mm, &y = probe.rays.y_mm;
    for_each_triple(probe, [&](std::size_t before, std::size_t node, std::size_t after) {
        const double at = std::hypot(static_cast<double>(x[node]), static_cast<double>(y[node]));
        if (at > reach_mm) return;
        const double dx = static_cast<double>(x[node]) -
                          0.5 * (static_cast<double>(x[before]) + static_cast<double>(x[after]));
        const double dy = static_cast<double>(y[node]) -
                          0.5 * (static_cast<double>(y[before]) + static_cast<double>(y[after]));
        sum += dx * dx + dy * dy;
        ++count;
    });
    if (count == 0) return unknown_cells;
    // The triples are those of a grid half as fine.
    const double probe_bend_mm = 0.25 * std::sqrt(sum / count);
    const double cells = probe_cells * std::sqrt(probe_bend_mm / bend_mm);
    return std::clamp(8 * static_cast<int>(std::ceil(cells / 8.0)), probe_cells, finest_cells);
}

SplitGrid<float> weighted_grid(const OpticalSystem& system, const TracePath<float>& path,
                               const BeamFrame& frame, const PupilBox& box,
                               const RayField<float>& probe, int cells) {
    const bool smooth = roughness(probe) < smooth_enough;
    auto grid = trace_grid(system, path, frame, box, cells, split_cells,
                           smooth ? Weights::none : Weights::polarised);
    if (smooth) fill_weights(probe, grid.base);
    return grid;
}

}  // namespace ghostlight
