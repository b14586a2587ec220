#include "core/flare/planned_flare.h"

#include <algorithm>
#include <cmath>

#include "core/elapsed.h"
#include "core/flare/draw_picture.h"
#include "core/flare/planned_ghost.h"
#include "core/flare/probe_all.h"
#include "core/flare/ringing.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

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

    const auto traced = Clock::now();
    std::vector<DrawnGhost<C>> drawn(probed.size());
    std::vector<DrawnGhost<gray_channels>> highlighted(request.highlighted.empty() ? 0
                                                                                   : probed.size());
    const bool finished = parallel_for(probed.size(), request.threads, stop, [&](std::size_t g) {
        if (probed[g].planned.fate != GhostFate::drawn) return;
        planner.draw(probed[g], drawn[g].mesh);
        drawn[g].level = probed[g].planned.level;
        if (std::ranges::find(request.highlighted, ghosts[g]) != request.highlighted.end()) {
            highlighted[g].mesh = last_channel(drawn[g].mesh);
            highlighted[g].level = drawn[g].level;
        }
    });
    if (!finished) return std::nullopt;
    image.times.trace_ms = ms_since(traced);

    if (!draw_picture<C>(drawn, frame, request.threads, stop, image)) return std::nullopt;
    if (!highlighted.empty() && !draw_highlight(highlighted, frame, request.threads, stop, image))
        return std::nullopt;
    for (std::size_t g = 0; g < probed.size(); ++g) {
        image.flux_mm2 += probed[g].planned.fate == GhostFate::off_sensor
                              ? probed[g].planned.whole_flux_mm2
                              : drawn[g].mesh.flux_mm2[C - 1];
        image.cells += drawn[g].mesh.cells;
        image.rays += probed[g].planned.rays;
    }
    image.plan = plan_of(scene, request, probed);
    if (request.ringing && !add_ringing(scene, request, stop, image)) return std::nullopt;
    image.times.total_ms = ms_since(began);
    return image;
}

}  // namespace

std::optional<FlareImage> render_planned(const FlareScene& scene, const FlareRequest& request,
                                         std::stop_token stop) {
    return scene.is_gray() ? render<gray_channels>(scene, request, std::move(stop))
                           : render<color_channels>(scene, request, std::move(stop));
}

}  // namespace ghostlight
