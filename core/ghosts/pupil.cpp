#include "core/ghosts/pupil.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "core/optics/trace_steps.h"

namespace ghostlight {
namespace {

constexpr int first_level_cells = 16;
constexpr int finest_level = 12;
constexpr int wanted_cells_across = 12;
constexpr int tight_level = 4;
constexpr std::size_t enough_cells = 4000;

struct Cell {
    std::uint32_t i, j;
    std::uint64_t key() const { return (std::uint64_t{j} << 32) | i; }
};

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void widen(double share) {
        const double by = share * (high - low);
        low -= by;
        high += by;
    }
    /// Distance of the range from zero.
    double distance() const { return std::max({0.0, low, -high}); }
};

/// The nodes of a level's cells, traced once each.
struct Nodes {
    std::vector<std::uint64_t> keys;
    Bundle<double> rays;

    std::size_t at(std::uint32_t i, std::uint32_t j) const {
        const auto found = std::ranges::lower_bound(keys, Cell{i, j}.key());
        return static_cast<std::size_t>(found - keys.begin());
    }
};

Nodes trace_nodes(const TracePath<double>& path, const BeamFrame& frame, const PupilBox& box,
                  int cells_across, const std::vector<Cell>& cells) {
    Nodes nodes;
    for (const Cell& cell : cells)
        for (std::uint32_t k = 0; k < 4; ++k)
            nodes.keys.push_back(Cell{cell.i + (k & 1), cell.j + (k >> 1)}.key());
    std::ranges::sort(nodes.keys);
    const auto repeated = std::ranges::unique(nodes.keys);
    nodes.keys.erase(repeated.begin(), repeated.end());
    const double du = (box.u1_mm - box.u0_mm) / cells_across;
    const double dv = (box.v1_mm - box.v0_mm) / cells_across;
    for (const std::uint64_t key : nodes.keys) {
        nodes.rays.u_mm.push_back(box.u0_mm + du * static_cast<double>(key & 0xffffffffU));
        nodes.rays.v_mm.push_back(box.v0_mm + dv * static_cast<double>(key >> 32));
    }
    trace_bundle(path, frame, Weights::none, nodes.rays);
    return nodes;
}

/// Whether a ray through the cell may pass, if the map does not bend by more than `share` of its
/// change across the cell. A cell whose corners all fail is kept on the first levels only.
bool may_pass(const Nodes& nodes, const Cell& cell, int level, double stop_radius_mm) {
    double share = level == 0 ? 0.75 : 0.4;
    const Bundle<double>& rays = nodes.rays;
    Range margin, clearance;
    std::size_t corner[4];
    int valid = 0;
    for (std::uint32_t k = 0; k < 4; ++k) {
        corner[k] = nodes.at(cell.i + (k & 1), cell.j + (k >> 1));
        margin.add(rays.margin[corner[k]]);
        if (rays.margin[corner[k]] >= 0.0) ++valid;
    }
    margin.widen(share);
    if (margin.high < 0.0) return false;
    if (valid == 0) return level < 2;
    // Past a miss or total reflection the map is only continued: trust the valid corners alone.
    if (valid < 4) share = std::max(1.0, 2.0 * share);
    for (const std::size_t c : corner)
        if (rays.margin[c] >= 0.0) clearance.add(rays.r_rel[c]);
    if (valid == 1) clearance.low -= 0.5;
    clearance.widen(share);
    if (clearance.low > 1.0) return false;
    if (valid < 4) return true;
    for (int k = 0; k < rays.stop_crossings; ++k) {
        Range u, v;
        for (const std::size_t c : corner) {
            u.add(rays.stop_u_mm[k][c]);
            v.add(rays.stop_v_mm[k][c]);
        }
        u.widen(share);
        v.widen(share);
        if (std::hypot(u.distance(), v.distance()) > stop_radius_mm) return false;
    }
    return true;
}

/// Whether the nodes that do pass reach to within two cells of the candidates' bounds.
bool is_tight(const Nodes& nodes, const Range& i, const Range& j, double stop_radius_mm) {
    const Bundle<double>& rays = nodes.rays;
    Range pass_i, pass_j;
    for (std::size_t n = 0; n < nodes.keys.size(); ++n) {
        bool passes = rays.margin[n] >= 0.0 && rays.r_rel[n] <= 1.0;
        for (int k = 0; k < rays.stop_crossings; ++k)
            passes = passes &&
                     std::hypot(rays.stop_u_mm[k][n], rays.stop_v_mm[k][n]) <= stop_radius_mm;
        if (!passes) continue;
        pass_i.add(static_cast<double>(nodes.keys[n] & 0xffffffffU));
        pass_j.add(static_cast<double>(nodes.keys[n] >> 32));
    }
    return pass_i.low <= i.low + 2.0 && pass_i.high >= i.high - 2.0 && pass_j.low <= j.low + 2.0 &&
           pass_j.high >= j.high - 2.0;
}

}  // namespace

PupilBox entrance_box(const OpticalSystem& system, const BeamFrame& frame) {
    const SurfaceAt& first = system.surfaces.front();
    const double c = first.curvature_per_mm;
    Range u, v;
    constexpr int rings = 24, spokes = 48;
    for (int ring = 0; ring <= rings; ++ring) {
        const double r = first.semi_diameter_mm * ring / rings;
        double sag = c * r * r /
                     (1.0 + std::sqrt(std::max(0.0, 1.0 - (1.0 + first.conic) * c * c * r * r)));
        double power = r * r;
        for (const double a : first.aspheric) sag += a * (power *= r * r);
        for (int spoke = 0; spoke < spokes; ++spoke) {
            const double phi = 2.0 * std::numbers::pi * spoke / spokes;
            const glm::dvec3 point(r * std::cos(phi), r * std::sin(phi), sag);
            u.add(dot(point, frame.e1));
            v.add(dot(point, frame.e2));
        }
    }
    // The polygon of spokes falls short of the circle by 1 − cos(π/spokes) = 0.2 %.
    u.widen(0.005);
    v.widen(0.005);
    return {u.low, u.high, v.low, v.high};
}

Pupil find_pupil(const OpticalSystem& system, const TracePath<double>& path,
                 const BeamFrame& frame) {
    const PupilBox whole = entrance_box(system, frame);
    const double stop_radius_mm = system.stop_mask.semi_diameter_mm;
    Pupil pupil;
    std::vector<Cell> cells;
    for (std::uint32_t j = 0; j < first_level_cells; ++j)
        for (std::uint32_t i = 0; i < first_level_cells; ++i) cells.push_back({i, j});
    int across = first_level_cells;
    for (int level = 0;; ++level, across *= 2) {
        const Nodes nodes = trace_nodes(path, frame, whole, across, cells);
        pupil.rays += nodes.keys.size();
        std::erase_if(cells, [&](const Cell& cell) {
            return !may_pass(nodes, cell, level, stop_radius_mm);
        });
        if (cells.empty()) return pupil;
        Range i, j;
        for (const Cell& cell : cells) {
            i.add(cell.i);
            i.add(cell.i + 1.0);
            j.add(cell.j);
            j.add(cell.j + 1.0);
        }
        const double narrow = std::min(i.high - i.low, j.high - j.low);
        const bool resolved = narrow >= wanted_cells_across &&
                              (is_tight(nodes, i, j, stop_radius_mm) || level >= tight_level);
        if (resolved || cells.size() >= enough_cells || level == finest_level) {
            const double du = (whole.u1_mm - whole.u0_mm) / across;
            const double dv = (whole.v1_mm - whole.v0_mm) / across;
            pupil.box = {whole.u0_mm + du * i.low, whole.u0_mm + du * i.high,
                         whole.v0_mm + dv * j.low, whole.v0_mm + dv * j.high};
            pupil.empty = false;
            return pupil;
        }
        std::vector<Cell> finer;
        finer.reserve(4 * cells.size());
        for (const Cell& cell : cells)
            for (std::uint32_t k = 0; k < 4; ++k)
                finer.push_back({2 * cell.i + (k & 1), 2 * cell.j + (k >> 1)});
        cells = std::move(finer);
    }
}

template <class T>
void lay_grid(const PupilBox& box, int cells, Bundle<T>& bundle) {
    const std::size_t side = static_cast<std::size_t>(cells) + 1;
    bundle.u_mm.resize(side * side);
    bundle.v_mm.resize(side * side);
    for (std::size_t j = 0; j < side; ++j) {
        const double v = std::lerp(box.v0_mm, box.v1_mm, static_cast<double>(j) / cells);
        for (std::size_t i = 0; i < side; ++i) {
            const double u = std::lerp(box.u0_mm, box.u1_mm, static_cast<double>(i) / cells);
            bundle.u_mm[j * side + i] = static_cast<T>(u);
            bundle.v_mm[j * side + i] = static_cast<T>(v);
        }
    }
}
template void lay_grid(const PupilBox&, int, Bundle<float>&);
template void lay_grid(const PupilBox&, int, Bundle<double>&);

}  // namespace ghostlight
