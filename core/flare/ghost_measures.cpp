#include "core/flare/ghost_measures.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ghostlight {
namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

}  // namespace

bool is_within(const MeshNodes& nodes, std::size_t k, double least) {
    return nodes.margin[k] >= 0.0F && std::ranges::all_of(nodes.clearances, [&](const auto& c) {
               return static_cast<double>(c[k]) >= least;
           });
}

double bend_px(const MeshNodes& nodes, const PixelFrame& frame) {
    const int side = nodes.cells + 1;
    const double reach2 =
        0.25 * (frame.width_px * frame.width_px + frame.height_px * frame.height_px);
    double square = 0.0;
    int count = 0;
    auto look = [&](int k, int step) {
        for (const int n : {k - step, k, k + step})
            if (!is_within(nodes, idx(n), near_rim)) return;
        const auto at = [&](const std::vector<float>& values, int n) {
            return static_cast<double>(values[idx(n)]);
        };
        const double dx = at(nodes.column, k) - 0.5 * frame.width_px;
        const double dy = at(nodes.row, k) - 0.5 * frame.height_px;
        if (dx * dx + dy * dy > reach2) return;
        for (const auto* values : {&nodes.column, &nodes.row}) {
            const double off =
                at(*values, k) - 0.5 * (at(*values, k - step) + at(*values, k + step));
            square += off * off;
        }
        ++count;
    };
    for (int j = 0; j < side; ++j)
        for (int i = 1; i < side; i += 2) {
            look(j * side + i, 1);
            look(i * side + j, side);
        }
    return count > 0 ? 0.25 * std::sqrt(square / count) : 0.0;
}

double rim_px(const MeshNodes& nodes, const PixelFrame& frame) {
    const int side = nodes.cells + 1;
    double sum = 0.0;
    int count = 0;
    for (int j = 1; j + 1 < side; ++j)
        for (int i = 1; i + 1 < side; ++i) {
            const int k = j * side + i;
            if (!is_within(nodes, idx(k), near_rim)) continue;
            const auto at = [&](const std::vector<float>& values, int n) {
                return static_cast<double>(values[idx(n)]);
            };
            const double du_x = 0.5 * (at(nodes.column, k + 1) - at(nodes.column, k - 1));
            const double du_y = 0.5 * (at(nodes.row, k + 1) - at(nodes.row, k - 1));
            const double dv_x = 0.5 * (at(nodes.column, k + side) - at(nodes.column, k - side));
            const double dv_y = 0.5 * (at(nodes.row, k + side) - at(nodes.row, k - side));
            const double size_px = std::min(std::sqrt(std::abs(du_x * dv_y - du_y * dv_x)),
                                            static_cast<double>(frame.width_px));
            for (const auto& c : nodes.clearances) {
                const double u = 0.5 * (at(c, k + 1) - at(c, k - 1));
                const double v = 0.5 * (at(c, k + side) - at(c, k - side));
                const double slope = std::hypot(u, v);
                // Only cells that the rim goes through.
                if (!(slope > 0.0) || std::abs(at(c, k)) > slope) continue;
                const double bend = at(c, k + 1) + at(c, k - 1) + at(c, k + side) +
                                    at(c, k - side) - 4.0 * at(c, k);
                sum += std::min(1.0, std::abs(bend) / (8.0 * slope)) * size_px;
                ++count;
            }
        }
    return count > 0 ? sum / count : 0.0;
}

double shift_px(const MeshNodes& a, const MeshNodes& b) {
    double square = 0.0;
    int count = 0;
    for (std::size_t k = 0; k < a.column.size(); ++k) {
        if (!is_within(a, k, near_rim) || !is_within(b, k, near_rim)) continue;
        const auto dx = static_cast<double>(a.column[k] - b.column[k]);
        const auto dy = static_cast<double>(a.row[k] - b.row[k]);
        square += dx * dx + dy * dy;
        ++count;
    }
    return count > 0 ? std::sqrt(square / count) : 0.0;
}

double roughness(const MirrorGrid& grid, const std::vector<float>& light) {
    const int across = grid.half_side();
    double change = 0.0, sum = 0.0;
    auto look = [&](int k, int step) {
        for (const int n : {k - step, k, k + step})
            if (grid.half.margin[idx(n)] < 0.0F || grid.half.r_rel[idx(n)] > 1.0F) return;
        change += std::abs(static_cast<double>(
            light[idx(k)] - 0.5F * (light[idx(k - step)] + light[idx(k + step)])));
        sum += static_cast<double>(light[idx(k)]);
    };
    for (int j = 0; j < grid.side(); ++j)
        for (int i = 1; i + 1 < across; i += 2) look(j * across + i, 1);
    for (int j = 1; j + 1 < grid.side(); j += 2)
        for (int i = 0; i < across; ++i) look(j * across + i, across);
    return sum > 0.0 ? 0.25 * change / sum : 0.0;
}

std::vector<int> singular_cells(const MirrorGrid& grid, const MeshNodes& nodes) {
    std::vector<int> cells;
    const int side = grid.side();
    for (int j = 0; j < grid.cells; ++j)
        for (int i = grid.cells / 2; i < grid.cells; ++i) {
            const std::size_t rays[4] = {grid.of_node(i, j), grid.of_node(i + 1, j),
                                         grid.of_node(i, j + 1), grid.of_node(i + 1, j + 1)};
            auto range = [&](const std::vector<float>& values) {
                float low = values[rays[0]], high = low;
                for (const std::size_t k : rays) {
                    low = std::min(low, values[k]);
                    high = std::max(high, values[k]);
                }
                return std::pair{low, high};
            };
            const auto [low, high] = range(grid.half.margin);
            if (high < 0.0F) continue;
            bool singular = low <= high - low;
            for (const auto& onset : grid.half.onset) {
                if (onset.empty()) continue;  // fewer reflections
                const auto [least, most] = range(onset);
                singular = singular || (least <= most - least && most >= least - most);
            }
            if (!singular) continue;
            const bool stopped = std::ranges::any_of(nodes.clearances, [&](const auto& clearance) {
                float least = 1e30F, most = -1e30F;
                for (const int k : {0, 1, side, side + 1}) {
                    const float value = clearance[idx(j * side + i + k)];
                    least = std::min(least, value);
                    most = std::max(most, value);
                }
                return most + 0.5F * (most - least) < 0.0F;
            });
            if (!stopped) cells.push_back(j * grid.cells + i);
        }
    return cells;
}

double light_in(const std::vector<int>& cells, const MeshNodes& nodes) {
    const int side = nodes.cells + 1;
    double sum = 0.0;
    for (const int cell : cells) {
        const int a = cell / nodes.cells * side + cell % nodes.cells;
        for (const int k : {a, a + 1, a + side, a + side + 1})
            if (is_within(nodes, idx(k), 0.0)) sum += static_cast<double>(nodes.weights[idx(k)]);
    }
    // A quarter for each corner; each cell stands for its mirror image too.
    return 0.5 * sum * nodes.cell_area_mm2;
}

FrameLight light_on_frame(const MeshNodes& nodes, const PixelFrame& frame) {
    /// A cell about the whole frame has no corner on it.
    constexpr double least_on_frame = 0.1;
    FrameLight light;
    const int side = nodes.cells + 1;
    const auto width = static_cast<float>(frame.width_px);
    const auto height = static_cast<float>(frame.height_px);
    std::vector<char> inside(idx(side * side));
    for (std::size_t k = 0; k < inside.size(); ++k)
        inside[k] = static_cast<char>(is_within(nodes, k, 0.0));
    for (int j = 0; j < nodes.cells; ++j)
        for (int i = 0; i < nodes.cells; ++i) {
            const int a = j * side + i;
            int passing = 0, on_frame = 0;
            float left = 1e30F, right = -1e30F, low = 1e30F, high = -1e30F;
            double weight = 0.0;
            for (const int k : {a, a + 1, a + side, a + side + 1}) {
                passing += inside[idx(k)];
                const float x = nodes.column[idx(k)], y = nodes.row[idx(k)];
                left = std::min(left, x);
                right = std::max(right, x);
                low = std::min(low, y);
                high = std::max(high, y);
                on_frame += x > 0.0F && y > 0.0F && x < width && y < height ? 1 : 0;
                weight += 0.25 * static_cast<double>(nodes.weights[idx(k)]);
            }
            if (passing == 0) continue;
            light.passes = true;
            light.whole_flux_mm2 += weight * 0.25 * passing * nodes.cell_area_mm2;
            if (right < 0.0F || high < 0.0F || left > width || low > height) continue;
            light.near_frame = true;
            light.flux_mm2 += weight * 0.25 * passing * nodes.cell_area_mm2 *
                              std::max(0.25 * on_frame, least_on_frame);
        }
    return light;
}

}  // namespace ghostlight
