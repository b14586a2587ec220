#include "core/flare/planned_flare.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/elapsed.h"
#include "core/flare/draw_picture.h"
#include "core/flare/planned_ghost.h"
#include "core/flare/probe_all.h"
#include "core/flare/radial_flare.h"
#include "core/flare/ringing.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// Cells whose meshes are held at once: 32 MB of edges, more than most pictures within 4 % have.
constexpr std::size_t most_cells_at_once = std::size_t{1} << 17;

struct Batch {
    std::size_t first = 0, count = 0;
};
/// Ghosts in order, as many at once as their cells allow.
std::vector<Batch> batches_of(const GhostPlanner& planner, const std::vector<ProbedGhost>& ghosts) {
    std::vector<Batch> batches;
    std::size_t held = most_cells_at_once;
    for (std::size_t g = 0; g < ghosts.size(); ++g) {
        const std::size_t cells = planner.cells_to_draw(ghosts[g]);
        if (held + cells > most_cells_at_once || batches.empty()) {
            batches.push_back({g, 0});
            held = 0;
        }
        held += cells;
        ++batches.back().count;
    }
    return batches;
}

/// A picture that ghosts are added to, and the strongest of them apart where they are asked for.
template <int C>
struct Canvas {
    LevelPictures<C> picture;
    std::optional<LevelPictures<gray_channels>> highlight;
    unsigned threads;
    std::stop_token stop;

    /// Parts of ghosts, of which some are highlighted.
    bool add(const std::vector<DrawnGhost<C>>& drawn, const std::vector<char>& is_highlighted,
             FlareTimes& times) {
        if (!picture.add(drawn, threads, stop, times)) return false;
        if (!highlight) return true;
        std::vector<DrawnGhost<gray_channels>> apart(drawn.size());
        for (std::size_t k = 0; k < drawn.size(); ++k)
            if (is_highlighted[k]) apart[k] = {last_channel(drawn[k].mesh), drawn[k].level};
        return highlight->add(apart, threads, stop, times);
    }
};

/// One ghost, as many of its bands at once as their cells allow. Returns its flux, or nothing when
/// stopped.
template <int C>
std::optional<double> draw_by_bands(const GhostPlanner& planner, ProbedGhost& ghost,
                                    bool is_highlighted, Canvas<C>& canvas, FlareImage& image) {
    auto traced = Clock::now();
    const GhostGrids grids = planner.lay_grids(ghost);
    planner.choose_level(grids, ghost);
    const auto bands = static_cast<std::size_t>(grids.fineness.bands);
    const auto across = static_cast<std::size_t>(grids.fineness.cells);
    const std::size_t at_once = std::max<std::size_t>(1, most_cells_at_once / (across * across));
    double flux_mm2 = 0.0;
    for (std::size_t first = 0; first < bands; first += at_once) {
        std::vector<DrawnGhost<C>> drawn(std::min(at_once, bands - first));
        if (!parallel_for(drawn.size(), canvas.threads, canvas.stop, [&](std::size_t k) {
                drawn[k].level = ghost.planned.level;
                planner.draw_band(ghost, grids, static_cast<int>(first + k), drawn[k].mesh);
            }))
            return std::nullopt;
        image.times.trace_ms += ms_since(traced);
        if (!canvas.add(drawn, std::vector<char>(drawn.size(), is_highlighted ? 1 : 0),
                        image.times))
            return std::nullopt;
        for (const DrawnGhost<C>& part : drawn) {
            flux_mm2 += part.mesh.flux_mm2[C - 1];
            image.cells += part.mesh.cells;
        }
        traced = Clock::now();
    }
    return flux_mm2;
}

/// What was needed to draw it.
void release(ProbedGhost& ghost) {
    ghost.grid = {};
    ghost.weights = {};
}

template <int C>
std::optional<FlareImage> render(const FlareScene& scene, const FlareRequest& request,
                                 std::stop_token stop) {
    const auto began = Clock::now();
    const OpticalSystem& system = scene.system();
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    FlareImage image = empty_image(system, frame);
    image.ghosts = request.only.empty() ? scene.ghosts.size() : request.only.size();

    const GhostPlanner planner(scene, request.light, frame, request.search, request.economies);
    auto found = probe_all(scene, planner, request, stop);
    if (!found) return std::nullopt;
    std::vector<ProbedGhost>& probed = *found;
    image.times.bounds_ms = ms_since(began);

    Canvas<C> canvas{LevelPictures<C>(frame), std::nullopt, request.threads, stop};
    if (!request.highlighted.empty()) canvas.highlight.emplace(frame);
    auto is_highlighted = [&](const ProbedGhost& ghost) {
        return std::ranges::find(request.highlighted, ghost.planned.path) !=
               request.highlighted.end();
    };
    for (const Batch& batch : batches_of(planner, probed)) {
        std::vector<double> fluxes_mm2(batch.count, 0.0);
        ProbedGhost* ghosts_at = probed.data() + batch.first;
        if (batch.count == 1 && planner.cells_to_draw(*ghosts_at) > most_cells_at_once) {
            const auto flux_mm2 =
                draw_by_bands(planner, *ghosts_at, is_highlighted(*ghosts_at), canvas, image);
            if (!flux_mm2) return std::nullopt;
            fluxes_mm2.front() = *flux_mm2;
        } else {
            const auto traced = Clock::now();
            std::vector<DrawnGhost<C>> drawn(batch.count);
            std::vector<char> highlighted(batch.count, 0);
            const bool finished =
                parallel_for(batch.count, request.threads, stop, [&](std::size_t k) {
                    ProbedGhost& ghost = ghosts_at[k];
                    if (ghost.planned.fate != GhostFate::drawn) return;
                    planner.draw(ghost, drawn[k].mesh);
                    drawn[k].level = ghost.planned.level;
                    highlighted[k] = is_highlighted(ghost) ? 1 : 0;
                });
            if (!finished) return std::nullopt;
            image.times.trace_ms += ms_since(traced);
            if (!canvas.add(drawn, highlighted, image.times)) return std::nullopt;
            for (std::size_t k = 0; k < batch.count; ++k) {
                fluxes_mm2[k] = drawn[k].mesh.flux_mm2[C - 1];
                image.cells += drawn[k].mesh.cells;
            }
        }
        for (std::size_t k = 0; k < batch.count; ++k) {
            const PlannedGhost& planned = ghosts_at[k].planned;
            image.flux_mm2 +=
                planned.fate == GhostFate::off_sensor ? planned.whole_flux_mm2 : fluxes_mm2[k];
            image.rays += planned.rays;
            // Fringes need what they are drawn from once more.
            if (!request.ringing) release(ghosts_at[k]);
        }
    }
    FringesLeftOut fringes;
    if (request.ringing) {
        const auto rang = Clock::now();
        const auto rung = ringing_of(scene, request, planner, probed, stop);
        if (!rung || !draw_ringing(*rung, frame, request.threads, stop, canvas.picture))
            return std::nullopt;
        fringes = take_reports(*rung, image);
        image.times.ringing_ms = ms_since(rang);
    }
    if (!canvas.picture.finish(request.threads, stop, image) ||
        (canvas.highlight && !finish_highlight(*canvas.highlight, request.threads, stop, image)))
        return std::nullopt;
    image.plan = plan_of(scene, request, probed);
    image.plan.fringes_left_out = fringes;
    image.times.total_ms = ms_since(began);
    return image;
}

}  // namespace

std::optional<FlareImage> render_planned(const FlareScene& scene, const FlareRequest& request,
                                         std::stop_token stop) {
    if (is_radial(scene, request)) return render_radial(scene, request, std::move(stop));
    return scene.is_gray() ? render<gray_channels>(scene, request, std::move(stop))
                           : render<color_channels>(scene, request, std::move(stop));
}

}  // namespace ghostlight
