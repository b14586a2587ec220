#include "core/ghosts/pupil.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "core/ghosts/cell_judgement.h"
#include "core/optics/trace_steps.h"

namespace ghostlight {
namespace {

constexpr SearchEffort thorough{24, 3, 100, 3000};
constexpr SearchEffort quick{12, 1, 40, 600};
constexpr SearchEffort beside_failing{36, 3, 40, 1500, true};

const SearchEffort& effort_of(PupilSearch search) {
    switch (search) {
        case PupilSearch::quick:
            return quick;
        case PupilSearch::beside_failing:
            return beside_failing;
        default:
            return thorough;
    }
}

constexpr int finest_level = 16;

std::uint64_t key_of(std::uint32_t i, std::uint32_t j) { return (std::uint64_t{j} << 32) | i; }

/// The nodes of a level's cells, traced once each.
template <class T>
struct Nodes {
    std::vector<std::uint64_t> keys;
    Bundle<T> rays;

    std::size_t side = 0;  ///< points of a full square grid across, else 0

    std::size_t at(std::uint32_t i, std::uint32_t j) const {
        if (side > 0) return j * side + i;
        const auto found = std::ranges::lower_bound(keys, key_of(i, j));
        return static_cast<std::size_t>(found - keys.begin());
    }
};

template <class T>
Nodes<T> trace_nodes(const TracePath<T>& path, const BeamFrame& frame, const PupilBox& box,
                     int cells_across, const std::vector<PupilCell>& cells) {
    Nodes<T> nodes;
    const auto across = static_cast<std::uint32_t>(cells_across);
    if (cells.size() == std::size_t{across} * across) {
        nodes.side = across + 1;
        for (std::uint32_t j = 0; j <= across; ++j)
            for (std::uint32_t i = 0; i <= across; ++i) nodes.keys.push_back(key_of(i, j));
    } else {
        for (const PupilCell& cell : cells)
            for (std::uint32_t k = 0; k < 4; ++k)
                nodes.keys.push_back(key_of(cell.i + (k & 1), cell.j + (k >> 1)));
        std::ranges::sort(nodes.keys);
        const auto repeated = std::ranges::unique(nodes.keys);
        nodes.keys.erase(repeated.begin(), repeated.end());
    }
    const double du = (box.u1_mm - box.u0_mm) / cells_across;
    const double dv = (box.v1_mm - box.v0_mm) / cells_across;
    for (const std::uint64_t key : nodes.keys) {
        nodes.rays.u_mm.push_back(
            static_cast<T>(box.u0_mm + du * static_cast<double>(key & 0xffffffffU)));
        nodes.rays.v_mm.push_back(static_cast<T>(box.v0_mm + dv * static_cast<double>(key >> 32)));
    }
    trace_bundle(path, frame, Weights::none, nodes.rays);
    return nodes;
}

}  // namespace

PupilBox entrance_box(const OpticalSystem& system, const BeamFrame& frame) {
    const SurfaceAt& first = system.surfaces.front();
    const double c = first.curvature_per_mm;
    Range u, v;
    constexpr int rings = 24, spokes = 48;
    for (int ring = 0; ring <= rings; ++ring) {
        const double r = first.semi_diameter_mm * ring / rings;
        double sag =
            c * r * r / (1.0 + std::sqrt(std::max(0.0, 1.0 - (1.0 + first.conic) * c * c * r * r)));
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

template <class T>
Pupil find_pupil(const OpticalSystem& system, const TracePath<T>& path, const BeamFrame& frame,
                 PupilSearch search) {
    const SearchEffort& effort = effort_of(search);
    const double stop_radius_mm = system.stop_mask.semi_diameter_mm;
    Pupil pupil;
    pupil.entrance = entrance_box(system, frame);
    pupil.across = static_cast<int>(effort.first_level_cells);
    const std::uint32_t first_column =
        search == PupilSearch::beside_failing ? effort.first_level_cells / 2 : 0;
    for (std::uint32_t j = 0; j < effort.first_level_cells; ++j)
        for (std::uint32_t i = first_column; i < effort.first_level_cells; ++i)
            pupil.cells.push_back({i, j});
    for (int level = 0;; ++level) {
        const Nodes<T> nodes = trace_nodes(path, frame, pupil.entrance, pupil.across, pupil.cells);
        pupil.rays += nodes.keys.size();
        std::erase_if(pupil.cells, [&](const PupilCell& cell) {
            std::array<std::size_t, 4> corners;
            for (std::uint32_t k = 0; k < 4; ++k)
                corners[k] = nodes.at(cell.i + (k & 1), cell.j + (k >> 1));
            return !may_pass(nodes.rays, corners, level, stop_radius_mm, effort);
        });
        if (pupil.empty()) return pupil;
        if (passing_rays(nodes.rays, stop_radius_mm) >= effort.enough_passing ||
            pupil.cells.size() >= effort.most_cells || level == finest_level)
            break;
        std::vector<PupilCell> finer;
        finer.reserve(4 * pupil.cells.size());
        for (const PupilCell& cell : pupil.cells)
            for (std::uint32_t k = 0; k < 4; ++k)
                finer.push_back({2 * cell.i + (k & 1), 2 * cell.j + (k >> 1)});
        pupil.cells = std::move(finer);
        pupil.across *= 2;
    }
    Range i, j;
    for (const PupilCell& cell : pupil.cells) {
        i.add(cell.i);
        i.add(cell.i + 1.0);
        j.add(cell.j);
        j.add(cell.j + 1.0);
    }
    const PupilBox& whole = pupil.entrance;
    const double du = (whole.u1_mm - whole.u0_mm) / pupil.across;
    const double dv = (whole.v1_mm - whole.v0_mm) / pupil.across;
    pupil.box = {whole.u0_mm + du * i.low, whole.u0_mm + du * i.high, whole.v0_mm + dv * j.low,
                 whole.v0_mm + dv * j.high};
    return pupil;
}

template Pupil find_pupil(const OpticalSystem&, const TracePath<float>&, const BeamFrame&,
                          PupilSearch);
template Pupil find_pupil(const OpticalSystem&, const TracePath<double>&, const BeamFrame&,
                          PupilSearch);

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
