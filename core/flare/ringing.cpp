#include "core/flare/ringing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/elapsed.h"
#include "core/flare/draw_rung.h"
#include "core/flare/picture_levels.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr int band_rows = 16;
/// Those whose fringes change least are left out while what they would change adds up to less than
/// this share of the picture's tolerance.
constexpr double left_out_share = 0.5;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// Half of the beam stands for the other, which a sensor's rectangle may not be alike in.
bool is_lopsided(const OpticalSystem& system, const GhostPath& path, const LightDirection& light) {
    const bool at_sensor = std::ranges::any_of(
        path.reflections, [&](std::size_t s) { return s >= system.surfaces.size(); });
    return at_sensor && std::abs(std::fmod(light.azimuth_deg, 180.0)) != 90.0;
}

/// A ghost that may ring.
struct Candidate {
    const ProbedGhost* ghost = nullptr;
    GhostRims rims;
    double changed_mm2 = 0.0, work = 0.0;
    bool chosen = true;
};

/// Pixels that fringes are drawn in, and what preparing a ghost costs as so many pixels: in
/// proportion to the time they take, to a factor of two.
double work_of(const ProbedGhost& ghost, const GhostRims& rims, const PixelFrame& frame) {
    constexpr double prepared_px = 20'000.0, reach_w = 5.8;
    const auto [least, most] = ghost.planned.spot.sigmas_mm();
    // Around an even ellipse of these moments, as far as that lies on the picture.
    const double around_px =
        2.0 * std::numbers::pi * std::numbers::sqrt2 * std::hypot(least, most) / frame.pitch_mm;
    const double length_px =
        rims.on_frame * std::min(around_px, 2.0 * (frame.width_px + frame.height_px));
    return prepared_px +
           length_px * reach_w * rims.px_per_w() * std::ldexp(1.0, -2 * ghost.planned.level);
}

void leave_out_weakest(std::vector<Candidate>& candidates, double budget_mm2) {
    std::vector<Candidate*> order;
    for (Candidate& candidate : candidates) order.push_back(&candidate);
    std::ranges::stable_sort(order, {},
                             [](const Candidate* each) { return each->changed_mm2 / each->work; });
    for (Candidate* weakest : order) {
        if (weakest->changed_mm2 > budget_mm2) continue;
        budget_mm2 -= weakest->changed_mm2;
        weakest->chosen = false;
    }
}

/// Draws bands of rows of one level, ghosts in their order.
template <class CanvasOf>
bool draw_levels(const std::vector<RungMesh>& rung, const PixelFrame& frame, unsigned threads,
                 const std::stop_token& stop, CanvasOf canvas_at) {
    struct Task {
        int level, band;
    };
    std::array<bool, picture_levels> has{};
    for (const RungMesh& mesh : rung)
        if (!mesh.empty()) has[idx(mesh.level)] = true;
    std::vector<Task> tasks;
    std::array<RungCanvas, picture_levels> canvases;
    for (int level = 0; level < picture_levels; ++level) {
        if (!has[idx(level)]) continue;
        const RasterSize size = level_size(frame, level);
        canvases[idx(level)] = canvas_at(level, size);
        for (int band = 0; band * band_rows < size.height_px; ++band)
            tasks.push_back({level, band});
    }
    std::vector<RungDrawing> drawings(rung.size());
    if (!parallel_for(rung.size(), threads, stop, [&](std::size_t g) {
            if (!rung[g].empty())
                drawings[g] = RungDrawing(rung[g], canvases[idx(rung[g].level)], band_rows);
        }))
        return false;
    return parallel_for(tasks.size(), threads, stop, [&](std::size_t t) {
        const auto [level, band] = tasks[t];
        for (std::size_t g = 0; g < rung.size(); ++g)
            if (rung[g].level == level) drawings[g].draw(band);
    });
}

/// Draws into a finished picture: full size at once, the others by way of their levels.
bool draw_finished(const std::vector<RungMesh>& rung, const PixelFrame& frame, unsigned threads,
                   const std::stop_token& stop, FlareImage& image) {
    std::array<std::vector<float>, picture_levels> levels;
    int coarsest = 0;
    for (const RungMesh& mesh : rung) coarsest = std::max(coarsest, mesh.level);
    for (int level = 0; coarsest > 0 && level <= coarsest; ++level) {
        const RasterSize size = level_size(frame, level);
        levels[idx(level)].assign(idx(size.width_px) * idx(size.height_px) * rim_channels, 0.0F);
    }
    const bool drawn =
        draw_levels(rung, frame, threads, stop, [&](int level, const RasterSize& size) {
            if (level > 0) return canvas_of(levels[idx(level)], rim_channels, size);
            return RungCanvas{size, 0.0, 0.0, image.irradiance.data(), 1, image.rgb.data(), 3};
        });
    if (!drawn) return false;
    auto bands_of = [&](int level) {
        return idx((level_size(frame, level).height_px + band_rows - 1) / band_rows);
    };
    for (int level = coarsest - 1; level >= 0; --level)
        if (!parallel_for(bands_of(level), threads, stop, [&](std::size_t b) {
                const RasterSize size = level_size(frame, level);
                const int first = static_cast<int>(b) * band_rows;
                add_coarser_rows<rim_channels>(
                    levels[idx(level) + 1], level_size(frame, level + 1), size, first,
                    std::min(first + band_rows, size.height_px), levels[idx(level)]);
            }))
            return false;
    std::vector<double> sums(bands_of(0), 0.0);
    if (!parallel_for(bands_of(0), threads, stop, [&](std::size_t b) {
            const std::size_t band = idx(band_rows) * idx(frame.width_px);
            const std::size_t last =
                std::min((b + 1) * band, idx(frame.width_px) * idx(frame.height_px));
            for (std::size_t k = b * band; k < last; ++k) {
                if (coarsest > 0) {
                    image.irradiance[k] += levels[0][rim_channels * k + rim_channels - 1];
                    for (std::size_t c = 0; c < 3; ++c)
                        image.rgb[3 * k + c] += levels[0][rim_channels * k + c];
                }
                // Where the picture's own rim is softer than the fringes' a trace would be below
                // zero.
                image.irradiance[k] = std::max(0.0F, image.irradiance[k]);
                sums[b] += static_cast<double>(image.irradiance[k]);
            }
        }))
        return false;
    image.flux_on_sensor_mm2 = 0.0;
    for (const double sum : sums) image.flux_on_sensor_mm2 += sum * frame.pixel_area_mm2();
    return true;
}

const PlannedGhost* planned_of(const FlarePlan& plan, std::size_t g, const GhostPath& path) {
    if (g < plan.ghosts.size() && plan.ghosts[g].path == path) return &plan.ghosts[g];
    const auto found = std::ranges::find(plan.ghosts, path, &PlannedGhost::path);
    return found == plan.ghosts.end() ? nullptr : &*found;
}

}  // namespace

std::optional<std::vector<RungMesh>> ringing_of(const FlareScene& scene,
                                                const FlareRequest& request,
                                                const GhostPlanner& planner,
                                                const std::vector<ProbedGhost>& ghosts,
                                                const std::stop_token& stop) {
    const OpticalSystem& system = scene.system();
    double flux_mm2 = 0.0;
    for (const ProbedGhost& ghost : ghosts) flux_mm2 += ghost.planned.flux_mm2;
    std::vector<Candidate> candidates;
    for (const ProbedGhost& ghost : ghosts)
        if (ghost.planned.fate == GhostFate::drawn && !ghost.weights.empty() &&
            ghost.planned.flux_mm2 > 0.0 && !is_lopsided(system, ghost.planned.path, request.light))
            candidates.push_back({.ghost = &ghost, .rims = {}});
    const PixelFrame& frame = planner.placement().frame();
    const EdgeFringes edge(scene);
    if (!parallel_for(candidates.size(), request.threads, stop, [&](std::size_t k) {
            Candidate& own = candidates[k];
            own.rims = ghost_rims(system, planner.placement(), *own.ghost, request.light.field_deg);
            own.changed_mm2 = own.rims.changed_share(edge) * own.ghost->planned.whole_flux_mm2;
            own.work = work_of(*own.ghost, own.rims, frame);
        }))
        return std::nullopt;
    // What is asked for by name gets its fringes.
    if (request.only.empty())
        leave_out_weakest(candidates, left_out_share * request.tolerance * flux_mm2);
    std::vector<RungMesh> meshes(candidates.size());
    if (!parallel_for(candidates.size(), request.threads, stop,
                      [&](std::size_t k) {
                          const Candidate& own = candidates[k];
                          if (!own.chosen)
                              meshes[k].left_out_mm2 = own.changed_mm2;
                          else if (own.changed_mm2 > 0.0)
                              meshes[k] =
                                  rung_mesh(scene, planner, edge, *own.ghost, own.rims, stop);
                      }) ||
        stop.stop_requested())
        return std::nullopt;
    std::erase_if(meshes,
                  [](const RungMesh& mesh) { return mesh.empty() && mesh.left_out_mm2 == 0.0; });
    return meshes;
}

RungMesh ringing_of(const FlareScene& scene, const FlareRequest& request,
                    const GhostPlanner& planner, const ProbedGhost& ghost, double layer_flux_mm2,
                    std::size_t ghosts, const std::stop_token& stop) {
    const OpticalSystem& system = scene.system();
    if (is_lopsided(system, ghost.planned.path, request.light)) return {};
    const GhostRims rims = ghost_rims(system, planner.placement(), ghost, request.light.field_deg);
    const EdgeFringes edge(scene);
    const double least_mm2 =
        left_out_share * request.tolerance * layer_flux_mm2 / static_cast<double>(ghosts);
    RungMesh mesh;
    mesh.left_out_mm2 = rims.changed_share(edge) * ghost.planned.whole_flux_mm2;
    if (ghosts > 1 && mesh.left_out_mm2 < least_mm2) return mesh;
    return rung_mesh(scene, planner, edge, ghost, rims, stop);
}

FringesLeftOut take_reports(const std::vector<RungMesh>& rung, FlareImage& image) {
    FringesLeftOut left_out;
    for (const RungMesh& mesh : rung) {
        if (!mesh.empty()) image.ringing.push_back(mesh.report);
        if (mesh.left_out_mm2 > 0.0) ++left_out.ghosts;
        left_out.changed_mm2 += mesh.left_out_mm2;
    }
    return left_out;
}

template <int C>
bool draw_ringing(const std::vector<RungMesh>& rung, const PixelFrame& frame, unsigned threads,
                  const std::stop_token& stop, LevelPictures<C>& picture) {
    return draw_levels(rung, frame, threads, stop, [&](int level, const RasterSize& size) {
        return canvas_of(picture.level(level), C, size);
    });
}
template bool draw_ringing(const std::vector<RungMesh>&, const PixelFrame&, unsigned,
                           const std::stop_token&, LevelPictures<gray_channels>&);
template bool draw_ringing(const std::vector<RungMesh>&, const PixelFrame&, unsigned,
                           const std::stop_token&, LevelPictures<color_channels>&);

bool add_ringing(const FlareScene& scene, const FlareRequest& request, const std::stop_token& stop,
                 FlareImage& image) {
    const auto began = Clock::now();
    const OpticalSystem& system = scene.system();
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    const std::vector<GhostPath>& paths = request.only.empty() ? scene.ghosts : request.only;
    const GhostPlanner planner(scene, request.light, frame, request.search);
    std::vector<ProbedGhost> ghosts(paths.size());
    const bool finished = parallel_for(paths.size(), request.threads, stop, [&](std::size_t g) {
        const PlannedGhost* planned = planned_of(image.plan, g, paths[g]);
        ghosts[g].planned.fate = GhostFate::left_out;
        if (planned != nullptr && planned->fate != GhostFate::drawn) return;
        ghosts[g] = planner.find(paths[g], planned);
        planner.weigh(ghosts[g]);
        if (planned != nullptr) ghosts[g].planned.level = planned->level;
    });
    if (!finished) return false;
    const auto rung = ringing_of(scene, request, planner, ghosts, stop);
    if (!rung || !draw_finished(*rung, frame, request.threads, stop, image)) return false;
    image.plan.fringes_left_out = take_reports(*rung, image);
    image.times.ringing_ms = ms_since(began);
    return true;
}

}  // namespace ghostlight
