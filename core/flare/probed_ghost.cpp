// GhostPlanner's first look at a ghost: where it enters, its light, and what a first drawing of it
// would get wrong. What follows from that is in planned_ghost.cpp.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/flare/ghost_measures.h"
#include "core/flare/ghost_spot.h"
#include "core/flare/grid_light.h"
#include "core/flare/planned_ghost.h"
#include "core/ghosts/double_trace.h"
#include "core/ghosts/path_stability.h"

namespace ghostlight {
namespace {

constexpr int close_cells = 48;           ///< where hardly a ray of a probe passes
constexpr std::size_t few_passing = 12;   ///< of a probe's nodes
constexpr std::size_t compared_rays = 8;  ///< of a probe, with double precision
/// Cells that a plan nearby wants, for fewer of them to be enough.
constexpr double few_enough = 6.5;
/// Of the light in singular cells: a root drawn as a line is off by as much, over a cell.
constexpr double singular_factor = 0.1;

/// Of a box's breadth, that its edges may move by, for what is smooth over it to hold.
constexpr double most_moved = 0.15;

bool are_alike(const PupilBox& a, const PupilBox& b) {
    const double du = most_moved * (b.u1_mm - b.u0_mm), dv = most_moved * (b.v1_mm - b.v0_mm);
    return std::abs(a.u0_mm - b.u0_mm) <= du && std::abs(a.u1_mm - b.u1_mm) <= du &&
           std::abs(a.v0_mm - b.v0_mm) <= dv && std::abs(a.v1_mm - b.v1_mm) <= dv;
}

/// By so many cells a box is widened at a time where another colour passes at its edge, and so
/// often at most.
constexpr int cells_of_room = 2, most_widenings = 4;

PupilBox with_room(const PupilBox& box, const ColorRoom& room, const PupilBox& entrance) {
    const double u = box.u1_mm - box.u0_mm, v = box.v1_mm - box.v0_mm;
    const double edge_mm =
        std::min(std::max(std::abs(entrance.u0_mm), entrance.u1_mm), box.u1_mm + room.u * u);
    return {-edge_mm, edge_mm, std::max(entrance.v0_mm, box.v0_mm - room.v_below * v),
            std::min(entrance.v1_mm, box.v1_mm + room.v_above * v)};
}

}  // namespace

GhostPlanner::GhostPlanner(const FlareScene& scene, const LightDirection& light,
                           const PixelFrame& frame, ProbeSearch search, PlanEconomies economies)
    : scene_(scene),
      search_(search),
      economies_(economies),
      placement_(scene.system(), light, frame),
      beam_(beam_frame({light.field_deg, 90.0})),
      entrance_(entrance_box(scene.system(), beam_)) {}

void GhostPlanner::trace(const ProbedGhost& ghost, const OpticalSystem& system, Weights weights,
                         Bundle<float>& rays) const {
    if (ghost.in_double)
        trace_in_double(system, ghost.planned.path, beam_, weights, rays);
    else
        trace_bundle(trace_path<float>(system, ghost.planned.path), beam_, weights, rays);
}

MirrorGrid GhostPlanner::traced(const ProbedGhost& ghost, const OpticalSystem& system, int cells,
                                bool keep_cosines, Weights weights) const {
    MirrorGrid grid;
    grid.box = ghost.planned.box;
    grid.cells = cells;
    grid.half.keep_cosines = keep_cosines;
    lay_mirrored(grid);
    trace(ghost, system, weights, grid.half);
    grid.is_polarised = weights == Weights::polarised;
    if (!economies_.half_beams) trace_other_half(ghost, system, weights, grid);
    return grid;
}

void GhostPlanner::trace_other_half(const ProbedGhost& ghost, const OpticalSystem& system,
                                    Weights weights, MirrorGrid& grid) const {
    lay_other_half(grid);
    trace(ghost, system, weights, grid.other);
    take_mean_of_halves(grid);
}

/// Compares some of the probe's rays with double precision; where they differ by what shows, the
/// probe is traced anew, and all that follows in double.
void GhostPlanner::mind_rounding(ProbedGhost& ghost) const {
    const OpticalSystem& system = scene_.system();
    if (ghost.known != nullptr) {
        ghost.in_double = ghost.known->in_double;
    } else {
        PathStability seen;
        seen.position_worst_mm = float_displacement_mm(system, ghost.planned.path, beam_,
                                                       ghost.grid.half, compared_rays);
        ghost.in_double = is_ill_conditioned(seen, system.sensor_width_mm);
    }
    ghost.planned.look.in_double = ghost.in_double;
    if (!ghost.in_double) return;
    trace(ghost, system, Weights::none, ghost.grid.half);
    ghost.planned.rays += ghost.grid.half.size();
}

ProbedGhost GhostPlanner::find(const GhostPath& path, const PlannedGhost* nearby) const {
    return find(path, nearby, search_);
}

ProbedGhost GhostPlanner::find(const GhostPath& path, const PlannedGhost* nearby,
                               ProbeSearch search) const {
    ProbedGhost result;
    PlannedGhost& planned = result.planned;
    planned.path = path;
    if (nearby != nullptr && nearby->fate == GhostFate::nothing_passes) {
        planned.fate = GhostFate::nothing_passes;
        return result;
    }
    const auto trace = trace_path<float>(scene_.system(), path);
    const bool few = nearby != nullptr && search == ProbeSearch::quick &&
                     nearby->look.cells_wanted > 0.0 && nearby->look.cells_wanted < few_enough;
    GhostProbe probe =
        probe_ghost(scene_.system(), trace, beam_, entrance_, few ? few_probe_cells : probe_cells,
                    search, nearby != nullptr ? &nearby->look.box : nullptr);
    planned.rays = probe.rays;
    planned.look.box = probe.passing_box;
    if (probe.empty) {
        planned.fate = GhostFate::nothing_passes;
        return result;
    }
    result.passing = probe.passing;
    result.grid = std::move(probe.grid);
    planned.box = result.grid.box;
    planned.bound_mm2 = box_bound_mm2(scene_, trace, result.grid);
    return result;
}

/// Looks whether rays of the outer geometry wavelengths pass at the edges of the box, which was
/// found for the main one.
ColorRoom GhostPlanner::room_for_colors(const ProbedGhost& ghost) const {
    ColorRoom room;
    ProbedGhost wider;
    wider.planned.path = ghost.planned.path;
    wider.in_double = ghost.in_double;
    const int cells = ghost.grid.cells;
    const double step = static_cast<double>(cells_of_room) / cells;
    for (int k = 0; k < most_widenings; ++k) {
        wider.planned.box = with_room(ghost.planned.box, room, entrance_);
        ColorRoom more;
        for (const OpticalSystem* outer : {&scene_.geometry.front(), &scene_.geometry.back()}) {
            const MeshNodes nodes = placement_.place(traced(wider, *outer, cells));
            for (int n = 0; n <= cells; ++n) {
                auto passes = [&](int i, int j) {
                    return is_within(nodes, static_cast<std::size_t>(j * (cells + 1) + i), 0.0);
                };
                if (passes(0, n) || passes(cells, n)) more.u = step;
                if (passes(n, 0)) more.v_below = step;
                if (passes(n, cells)) more.v_above = step;
            }
        }
        if (more.is_none()) break;
        room = {room.u + more.u, room.v_below + more.v_below, room.v_above + more.v_above};
    }
    return room;
}

void GhostPlanner::make_room_for_colors(ProbedGhost& ghost) const {
    PlannedGhost& planned = ghost.planned;
    planned.look.room = ghost.known != nullptr ? ghost.known->room : room_for_colors(ghost);
    if (planned.look.room.is_none()) return;
    const double area_mm2 = planned.box.area_mm2();
    planned.box = with_room(planned.box, planned.look.room, entrance_);
    planned.bound_mm2 *= planned.box.area_mm2() / area_mm2;
    ghost.grid = traced(ghost, scene_.system(), ghost.grid.cells, true);
    planned.rays += ghost.grid.half.size();
}

std::shared_ptr<const WeightShares> GhostPlanner::shares_of(ProbedGhost& ghost,
                                                            const TracePath<float>& path) const {
    auto shares = std::make_shared<WeightShares>();
    PolarisedShare& polarised = shares->polarised;
    polarised = polarised_share(scene_, path, beam_, ghost.planned.box);
    shares->colors = color_share(scene_, ghost.planned.path, beam_, polarised);
    ghost.planned.rays += polarised.ratio.size() + shares->colors.rays;
    // What they came from is most of their memory.
    polarised.grid.half = {};
    return shares;
}

void GhostPlanner::weigh(ProbedGhost& ghost) const {
    PlannedGhost& planned = ghost.planned;
    if (planned.fate != GhostFate::drawn) return;
    if (ghost.known != nullptr && !are_alike(ghost.known->box, planned.look.box))
        ghost.known = nullptr;
    const auto trace = trace_path<float>(scene_.system(), planned.path);
    mind_rounding(ghost);
    if (scene_.geometry.size() > 1) make_room_for_colors(ghost);
    if (!economies_.half_beams) {
        trace_other_half(ghost, scene_.system(), Weights::none, ghost.grid);
        planned.rays += ghost.grid.other.size();
    }
    std::shared_ptr<const WeightShares>& shares = planned.look.shares;
    if (ghost.known != nullptr) shares = ghost.known->shares;
    if (!shares || !shares->colors.is_for(scene_)) shares = shares_of(ghost, trace);
    ghost.weights = ghost_weights(scene_, trace, ghost.grid, *shares);

    MirrorGrid closer;
    if (ghost.passing < few_passing) {
        closer = traced(ghost, scene_.system(), close_cells);
        planned.rays += closer.half.size() + closer.other.size();
    }
    const MirrorGrid& first = closer.cells > 0 ? closer : ghost.grid;
    MeshNodes nodes = placement_.place(first);
    interpolate(ghost.grid,
                ray_light<gray_channels>(scene_, ghost.grid, ghost.weights,
                                         channel_shares<gray_channels>(scene_, 0, 1)),
                1, nodes.cells, nodes.weights);
    const FrameLight light = light_on_frame(nodes, placement_.frame());
    planned.flux_mm2 = light.flux_mm2;
    planned.whole_flux_mm2 = light.whole_flux_mm2;
    planned.spot = spot_of(nodes, gray_channels, placement_.frame());
    if (!light.passes)
        planned.fate = GhostFate::nothing_passes;
    else if (!light.near_frame)
        planned.fate = GhostFate::off_sensor;
    else
        look(first, nodes, ghost);
    // Its weights are known: what they came from is most of a ghost's memory.
    ghost.grid.half.cosines = {};
    ghost.grid.half.lengths_mm = {};
}

ProbedGhost GhostPlanner::probe(const GhostPath& path) const {
    ProbedGhost ghost = find(path);
    weigh(ghost);
    return ghost;
}

/// What one band would get wrong, from grids like the first one at the outer geometry wavelengths.
ColorMisplacement GhostPlanner::misplaced_colors(const ProbedGhost& ghost,
                                                 const MeshNodes& main) const {
    const MeshNodes first = placement_.place(traced(ghost, scene_.geometry.front(), main.cells));
    const MeshNodes last = placement_.place(traced(ghost, scene_.geometry.back(), main.cells));
    const PixelFrame& frame = placement_.frame();
    ColorMisplacement misplaced;
    misplaced.distance =
        0.5 * (picture_distance(main, first, frame) + picture_distance(main, last, frame));
    misplaced.shift_px = shift_px(first, last);
    std::size_t passing = 0, failing = 0;
    for (const MeshNodes* outer : {&first, &last})
        for (std::size_t k = 0; k < main.margin.size(); ++k) {
            const bool here = is_within(main, k, 0.0), there = is_within(*outer, k, 0.0);
            if (here || there) ++passing;
            if ((here && outer->margin[k] < 0.0F) || (there && main.margin[k] < 0.0F)) ++failing;
        }
    if (passing > 0)
        misplaced.failing_share = static_cast<double>(failing) / static_cast<double>(passing);
    return misplaced;
}

/// What a plain drawing of the first grid would get wrong.
void GhostPlanner::look(const MirrorGrid& first, const MeshNodes& nodes, ProbedGhost& ghost) const {
    const PixelFrame& frame = placement_.frame();
    ColorMesh<gray_channels> mesh;
    add_grid(nodes, frame, mesh);
    const double contrast = mesh.edge_contrast * frame.pixel_area_mm2();
    FirstErrors& errors = ghost.errors;
    errors.contrast_mm2 = contrast;
    errors.slopes_mm2 = mesh.slope_contrast * frame.pixel_area_mm2();
    errors.cells = first.cells;
    errors.area_px2 = mesh.area_px2;
    if (scene_.coating_model == CoatingModel::exact)
        errors.singular_mm2 = singular_factor * light_in(singular_cells(first, nodes), nodes);
    // The error of a bilinear map falls fourfold on doubling the grid.
    errors.grid_mm2 =
        contrast * (grid_factor * bend_px(nodes, frame) + rim_factor * rim_px(nodes, frame));
    if (scene_.geometry.size() > 1) {
        std::optional<ColorMisplacement>& colors = ghost.planned.look.colors;
        if (ghost.known != nullptr) colors = ghost.known->colors;
        if (!colors) colors = misplaced_colors(ghost, nodes);
        errors.colors = *colors;
    }
    errors.weight_mm2 = ghost.planned.flux_mm2 *
                        roughness(ghost.grid, ray_light<gray_channels>(
                                                  scene_, ghost.grid, ghost.weights,
                                                  channel_shares<gray_channels>(scene_, 0, 1)));
}

}  // namespace ghostlight
