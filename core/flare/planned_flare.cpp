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

/// What was needed to draw it.
void release(ProbedGhost& ghost) {
    ghost.grid = {};
    ghost.weights = {};
    ghost.colors = {};
    ghost.polarised = {};
}

template <int C>
std::optional<FlareImage> render(const FlareScene& scene, const FlareRequest& request,
                                 std::stop_token stop) {
    const auto began = Clock::now();
    const OpticalSystem& system = scene.system();
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    FlareImage image = empty_image(system, frame);
    const std::vector<GhostPath>& ghosts = request.only.empty() ? scene.ghosts : request.only;
    image.ghosts = ghosts.size();

    const GhostPlanner planner(scene, request.light, frame, request.search, request.economies);
    auto found = probe_all(scene, planner, request, stop);
    if (!found) return std::nullopt;
    std::vector<ProbedGhost>& probed = *found;
    image.times.bounds_ms = ms_since(began);

    LevelPictures<C> picture(frame);
    std::optional<LevelPictures<gray_channels>> highlight;
    if (!request.highlighted.empty()) highlight.emplace(frame);
    for (const Batch& batch : batches_of(planner, probed)) {
        const auto traced = Clock::now();
        std::vector<DrawnGhost<C>> drawn(batch.count);
        std::vector<DrawnGhost<gray_channels>> highlighted(highlight ? batch.count : 0);
        const bool finished = parallel_for(batch.count, request.threads, stop, [&](std::size_t k) {
            ProbedGhost& ghost = probed[batch.first + k];
            if (ghost.planned.fate != GhostFate::drawn) return;
            planner.draw(ghost, drawn[k].mesh);
            drawn[k].level = ghost.planned.level;
            if (std::ranges::find(request.highlighted, ghost.planned.path) !=
                request.highlighted.end()) {
                highlighted[k].mesh = last_channel(drawn[k].mesh);
                highlighted[k].level = drawn[k].level;
            }
        });
        if (!finished) return std::nullopt;
        image.times.trace_ms += ms_since(traced);
        if (!picture.add(drawn, request.threads, stop, image.times) ||
            (highlight && !highlight->add(highlighted, request.threads, stop, image.times)))
            return std::nullopt;
        for (std::size_t k = 0; k < batch.count; ++k) {
            const PlannedGhost& planned = probed[batch.first + k].planned;
            image.flux_mm2 += planned.fate == GhostFate::off_sensor ? planned.whole_flux_mm2
                                                                    : drawn[k].mesh.flux_mm2[C - 1];
            image.cells += drawn[k].mesh.cells;
            image.rays += planned.rays;
            // Fringes need what they are drawn from once more.
            if (!request.ringing) release(probed[batch.first + k]);
        }
    }
    FringesLeftOut fringes;
    if (request.ringing) {
        const auto rang = Clock::now();
        const auto rung = ringing_of(scene, request, planner, probed, stop);
        if (!rung || !draw_ringing(*rung, frame, request.threads, stop, picture))
            return std::nullopt;
        fringes = take_reports(*rung, image);
        image.times.ringing_ms = ms_since(rang);
    }
    if (!picture.finish(request.threads, stop, image) ||
        (highlight && !finish_highlight(*highlight, request.threads, stop, image)))
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
