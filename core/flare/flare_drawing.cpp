#include "core/flare/flare_drawing.h"

#include <utility>

#include "core/elapsed.h"
#include "core/error.h"
#include "core/flare/planned_ghost.h"
#include "core/flare/probe_all.h"
#include "core/parallel.h"

namespace ghostlight {

std::optional<FlareDrawing> plan_drawing(const FlareScene& scene, const FlareRequest& request,
                                         std::stop_token stop) {
    const auto began = Clock::now();
    const OpticalSystem& system = scene.system();
    FlareDrawing drawing;
    drawing.frame = pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    const GhostPlanner planner(scene, request.light, drawing.frame, request.search);
    drawing.beam = planner.beam();
    drawing.stop_mask = planner.placement().stop_mask();
    drawing.cos_azimuth = planner.placement().cos_azimuth();
    drawing.sin_azimuth = planner.placement().sin_azimuth();
    auto probed = probe_all(scene, planner, request, stop);
    if (!probed) return std::nullopt;
    for (const ProbedGhost& ghost : *probed)
        if (ghost.in_double && ghost.planned.fate == GhostFate::drawn)
            throw Error({.problem = "a ghost's rays move by more than a tenth of a pixel in single "
                                    "precision, which is all that shaders have",
                         .file = {},
                         .where = "ghost " + name(ghost.planned.path),
                         .found = {},
                         .expected = "ghosts that single precision holds still"});
    std::vector<GhostDrawing> prepared(probed->size());
    const bool finished = parallel_for(probed->size(), request.threads, stop, [&](std::size_t g) {
        if ((*probed)[g].planned.fate == GhostFate::drawn)
            prepared[g] = planner.prepare((*probed)[g]);
    });
    if (!finished) return std::nullopt;
    drawing.plan = plan_of(scene, request, *probed);
    for (std::size_t g = 0; g < prepared.size(); ++g)
        if (drawing.plan.ghosts[g].fate == GhostFate::drawn)
            drawing.ghosts.push_back(std::move(prepared[g]));
    drawing.planning_ms = ms_since(began);
    return drawing;
}

}  // namespace ghostlight
