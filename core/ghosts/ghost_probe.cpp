#include "core/ghosts/ghost_probe.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/ghosts/cell_judgement.h"

namespace ghostlight {
namespace {

constexpr SearchEffort effort{12, 1, 40, 600};  // as find_pupil's quick one
constexpr int most_zooms = 24;
constexpr int most_cells = 96;  ///< of a look: then cells by themselves are cheaper
constexpr int meridian_rays = 256;
constexpr std::size_t share_passing = 4;  ///< one node of so many is to pass, for a box to serve
constexpr double room_for_moves = 0.15;   ///< about a box of a beam nearby, of its breadth
constexpr std::size_t few_passing = 8;    ///< of the last grid's nodes: look more closely

PupilBox symmetric(PupilBox box) {
    box.u1_mm = std::max(std::abs(box.u0_mm), std::abs(box.u1_mm));
    box.u0_mm = -box.u1_mm;
    return box;
}

/// Nodes that pass, the stop taken as round.
struct PassingNodes {
    std::size_t count = 0;  ///< of the full grid
    Range i, j;             ///< columns from the middle, rows
};

PassingNodes passing_nodes(const MirrorGrid& grid, double stop_radius_mm) {
    PassingNodes nodes;
    const auto r2 = static_cast<float>(stop_radius_mm * stop_radius_mm);
    const Bundle<float>& rays = grid.half;
    std::size_t k = 0;
    for (int j = 0; j < grid.side(); ++j)
        for (int i = 0; i < grid.half_side(); ++i, ++k) {
            bool passes = rays.margin[k] >= 0.0F && rays.r_rel[k] <= 1.0F;
            for (std::size_t s = 0; s < static_cast<std::size_t>(rays.stop_crossings); ++s)
                passes = passes && rays.stop_u_mm[s][k] * rays.stop_u_mm[s][k] +
                                           rays.stop_v_mm[s][k] * rays.stop_v_mm[s][k] <=
                                       r2;
            if (!passes) continue;
            nodes.count += i == 0 ? 1 : 2;  // all but the middle column stand for two
            nodes.i.add(i);
            nodes.j.add(j);
        }
    return nodes;
}

/// Where rays in the y–z plane pass, with a step to spare; a line of rays costs little and crosses
/// rings about the axis and islands that a grid may step over.
Range passing_meridian(const TracePath<float>& path, const BeamFrame& frame,
                       const PupilBox& entrance, double stop_radius_mm) {
    Bundle<float> line;
    const double step = (entrance.v1_mm - entrance.v0_mm) / meridian_rays;
    for (int k = 0; k < meridian_rays; ++k) {
        line.u_mm.push_back(0.0F);
        line.v_mm.push_back(static_cast<float>(entrance.v0_mm + (k + 0.5) * step));
    }
    trace_bundle(path, frame, Weights::none, line);
    auto in_clear = [&](std::size_t k) { return line.margin[k] >= 0.0F && line.r_rel[k] <= 1.0F; };
    Range passing;
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        // A small stop's image may lie between two rays: there the stop coordinate changes sign.
        bool between = in_clear(k) && in_clear(k + 1);
        bool at = in_clear(k);
        for (std::size_t s = 0; s < static_cast<std::size_t>(line.stop_crossings); ++s) {
            const auto here = static_cast<double>(line.stop_v_mm[s][k]);
            const auto next = static_cast<double>(line.stop_v_mm[s][k + 1]);
            at = at && std::abs(here) <= stop_radius_mm;
            between = between && std::min(here, next) <= stop_radius_mm &&
                      std::max(here, next) >= -stop_radius_mm;
        }
        if (!at && !between) continue;
        passing.add(static_cast<double>(line.v_mm[k]) - step);
        passing.add(static_cast<double>(line.v_mm[k]) + 2.0 * step);
    }
    return passing;
}

/// Widens a box to what the meridian showed; light along the axis passes in rings.
void hold(PupilBox& box, const Range& meridian, bool on_axis) {
    if (!(meridian.low <= meridian.high)) return;
    box.v0_mm = std::min(box.v0_mm, meridian.low);
    box.v1_mm = std::max(box.v1_mm, meridian.high);
    if (!on_axis) return;
    box.u1_mm = std::max({box.u1_mm, -meridian.low, meridian.high});
    box.u0_mm = -box.u1_mm;
}

/// A box of a beam nearby with `room` of its breadth on either side for what has moved, within the
/// entrance.
PupilBox widened(const PupilBox& box, const PupilBox& whole, double room) {
    const double du = 2.0 * room * box.u1_mm, dv = room * (box.v1_mm - box.v0_mm);
    PupilBox wide{0.0, std::min(box.u1_mm + du, whole.u1_mm), std::max(box.v0_mm - dv, whole.v0_mm),
                  std::min(box.v1_mm + dv, whole.v1_mm)};
    wide.u0_mm = -wide.u1_mm;
    return wide;
}

/// Whether what may pass reaches a side of the grid beyond which there is more of the entrance, or
/// nothing passes.
bool reaches_edge(const MirrorGrid& grid, const Range& i, const Range& j, const PupilBox& whole) {
    if (!(i.high > 0.0)) return true;
    return (i.high >= grid.cells / 2 && grid.box.u1_mm < whole.u1_mm) ||
           (j.low <= 0.0 && grid.box.v0_mm > whole.v0_mm) ||
           (j.high >= grid.cells && grid.box.v1_mm < whole.v1_mm);
}

/// Whether the box of a beam nearby still serves: what passes fills it, and reaches no side of it
/// beyond which there is more of the entrance. What bulges out between two nodes of a side is at
/// most a ten-thousandth of what passes.
bool still_serves(const MirrorGrid& grid, const PassingNodes& passing, const PupilBox& whole) {
    const double most_free_rows = std::max(3.0, grid.cells / 3.0);
    const std::size_t nodes = static_cast<std::size_t>(grid.cells * grid.cells);
    if (passing.count * share_passing < nodes || passing.i.high < grid.cells / 2 - 1 ||
        passing.j.low + grid.cells - passing.j.high > most_free_rows)
        return false;
    return (passing.i.high < grid.cells / 2 || grid.box.u1_mm >= whole.u1_mm) &&
           (passing.j.low > 0.0 || grid.box.v0_mm <= whole.v0_mm) &&
           (passing.j.high < grid.cells || grid.box.v1_mm >= whole.v1_mm);
}

/// Keeps what passes of a probe's last grid.
PassingNodes keep_passing(const PupilBox& whole, double stop_radius_mm, GhostProbe& probe) {
    const MirrorGrid& grid = probe.grid;
    const PassingNodes passing = passing_nodes(grid, stop_radius_mm);
    probe.passing = passing.count;
    probe.passing_box = grid.box;
    if (passing.count == 0) return passing;
    const double cell_v_mm = (grid.box.v1_mm - grid.box.v0_mm) / grid.cells;
    PupilBox& box = probe.passing_box;
    box.u1_mm = std::min(whole.u1_mm, grid.box.u1_mm * (passing.i.high + 1.0) / (grid.cells / 2));
    box.u0_mm = -box.u1_mm;
    box.v0_mm = std::max(whole.v0_mm, grid.box.v0_mm + (passing.j.low - 1.0) * cell_v_mm);
    box.v1_mm = std::min(whole.v1_mm, grid.box.v0_mm + (passing.j.high + 1.0) * cell_v_mm);
    return passing;
}

/// By cells, each way of looking in turn; false when none finds anything.
bool search_cells(const OpticalSystem& system, const TracePath<float>& path, const BeamFrame& frame,
                  std::initializer_list<PupilSearch> ways, GhostProbe& probe) {
    for (const PupilSearch way : ways) {
        const Pupil pupil = find_pupil(system, path, frame, way);
        probe.rays += pupil.rays;
        probe.empty = pupil.empty();
        if (probe.empty) continue;
        probe.grid.box = symmetric(pupil.box);
        break;
    }
    return !probe.empty;
}

}  // namespace

GhostProbe probe_ghost(const OpticalSystem& system, const TracePath<float>& path,
                       const BeamFrame& frame, const PupilBox& entrance, int cells,
                       ProbeSearch search, const PupilBox* nearby) {
    const bool careful = search == ProbeSearch::careful;
    const double stop_radius_mm = system.stop_mask.semi_diameter_mm;
    GhostProbe probe;
    MirrorGrid& grid = probe.grid;
    const PupilBox whole = symmetric(entrance);
    const double first_cell_mm = 2.0 * whole.u1_mm / cells;
    auto begin_with_all = [&] {
        nearby = nullptr;
        grid.box = whole;
        // The first look is a finer one: beside failing rays a coarse cell says nothing.
        grid.cells = 2 * cells;
    };
    if (nearby != nullptr && nearby->area_mm2() > 0.0) {
        if (!careful) {
            grid.box = widened(*nearby, whole, 0.0);
            grid.cells = cells;
            grid.half.keep_cosines = true;
            trace_mirrored(path, frame, Weights::none, grid);
            probe.rays += grid.half.size();
            if (still_serves(grid, keep_passing(whole, stop_radius_mm, probe), whole)) return probe;
            grid.half.keep_cosines = false;
        }
        grid.box = widened(*nearby, whole, room_for_moves);
        grid.cells = cells + 2;
    } else {
        begin_with_all();
    }
    const bool on_axis = frame.direction.z == 1.0;
    Range meridian;
    if (careful) {
        meridian = passing_meridian(path, frame, entrance, stop_radius_mm);
        probe.rays += meridian_rays;
    }
    bool searched = false;
    for (int zoom = 0; zoom < most_zooms; ++zoom) {
        trace_mirrored(path, frame, Weights::none, grid);
        probe.rays += grid.half.size();
        const int across = grid.cells;
        // How often the first cells have been halved, for what the judgement allows within one.
        const double cell_mm =
            std::max(2.0 * grid.box.u1_mm, grid.box.v1_mm - grid.box.v0_mm) / across;
        const int level = static_cast<int>(std::lround(std::log2(first_cell_mm / cell_mm)));
        Range i_range, j_range;
        for (int j = 0; j < across; ++j)
            for (int i = across / 2; i < across; ++i) {
                const std::array<std::size_t, 4> corners = {
                    grid.of_node(i, j), grid.of_node(i + 1, j), grid.of_node(i, j + 1),
                    grid.of_node(i + 1, j + 1)};
                if (!may_pass(grid.half, corners, level, stop_radius_mm, effort)) continue;
                i_range.add(i + 1.0 - across / 2);
                j_range.add(j);
                j_range.add(j + 1.0);
            }
        if (nearby != nullptr) {
            if (reaches_edge(grid, i_range, j_range, whole)) {
                begin_with_all();
                continue;
            }
            nearby = nullptr;
        }
        if (!(i_range.high > 0.0)) {
            if (!careful) {
                probe.empty = true;
                return probe;
            }
            // Crescents between rays that fail: a box about all that may hold them shows nothing.
            if (!search_cells(system, path, frame, {PupilSearch::beside_failing}, probe))
                return probe;
            searched = true;
            break;
        }
        const double v0 = grid.box.v0_mm, height = grid.box.v1_mm - v0;
        grid.box.u1_mm *= i_range.high / (across / 2);
        grid.box.u0_mm = -grid.box.u1_mm;
        grid.box.v0_mm = v0 + height * j_range.low / across;
        grid.box.v1_mm = v0 + height * j_range.high / across;
        if (passing_nodes(grid, stop_radius_mm).count >= effort.enough_passing) break;
        // Each look halves the cells at least; where the box hardly shrinks it takes more of them.
        const double kept = std::max(2.0 * i_range.high, j_range.high - j_range.low);
        grid.cells = std::max(cells, 2 * static_cast<int>(std::ceil(kept)));
        if (grid.cells > most_cells) break;
    }
    grid.cells = cells;
    grid.half.keep_cosines = true;
    const PupilBox found = grid.box;
    trace_mirrored(path, frame, Weights::none, grid);
    probe.rays += grid.half.size();
    keep_passing(whole, stop_radius_mm, probe);
    const bool too_few = probe.passing < few_passing && !searched;
    if (too_few && careful &&
        !search_cells(system, path, frame, {PupilSearch::quick, PupilSearch::beside_failing},
                      probe))
        return probe;
    if (too_few && !careful && !search_cells(system, path, frame, {PupilSearch::quick}, probe))
        return probe;
    hold(grid.box, meridian, on_axis);
    if (grid.box.u1_mm == found.u1_mm && grid.box.v0_mm == found.v0_mm &&
        grid.box.v1_mm == found.v1_mm)
        return probe;
    trace_mirrored(path, frame, Weights::none, grid);
    probe.rays += grid.half.size();
    keep_passing(whole, stop_radius_mm, probe);
    return probe;
}

}  // namespace ghostlight
