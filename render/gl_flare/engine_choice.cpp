#include "render/gl_flare/engine_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/elapsed.h"
#include "core/error.h"
#include "core/flare/planned_flare.h"

namespace ghostlight {
namespace {

/// OpenGL is taken when it needs less than this share of the CPU's time.
constexpr double clearly_faster = 0.8;
/// The trial's picture is small and rough, and begins with a few ghosts: an OpenGL in software
/// would take seconds for all of them. Their number grows by this factor while time allows.
constexpr int trial_width_px = 640;
constexpr double trial_tolerance = 0.04;
constexpr std::size_t first_ghosts = 8, growth = 4;
/// Few ghosts say little of how OpenGL fills pixels: where it is ahead, it gets this many times the
/// budget to show that it stays so.
constexpr double to_be_sure = 3.0;

/// So many ghosts from all along the list.
std::vector<GhostPath> some_of(const std::vector<GhostPath>& ghosts, std::size_t count) {
    std::vector<GhostPath> some;
    for (std::size_t k = 0; k < count; ++k) some.push_back(ghosts[k * ghosts.size() / count]);
    return some;
}

}  // namespace

const char* engine_name(FlareEngine engine) {
    switch (engine) {
        case FlareEngine::cpu:
            return "cpu";
        case FlareEngine::gl:
            return "opengl";
        case FlareEngine::automatic:
            break;
    }
    return "automatic";
}

std::optional<FlareEngine> parse_engine(std::string_view name) {
    for (const FlareEngine engine : {FlareEngine::automatic, FlareEngine::cpu, FlareEngine::gl})
        if (name == engine_name(engine)) return engine;
    return std::nullopt;
}

FlareEngineChoice choose_engine(FlareEngine wish, const EngineTimes& times) {
    if (wish == FlareEngine::cpu) return {FlareEngine::cpu, "CPU: as asked"};
    if (!times.gl_ms) {
        const std::string why =
            times.gl_refusal.empty() ? "OpenGL was not tried" : times.gl_refusal;
        return {FlareEngine::cpu, "CPU: " + why};
    }
    if (wish == FlareEngine::gl) return {FlareEngine::gl, "OpenGL: as asked"};
    if (!times.cpu_ms) return {FlareEngine::gl, "OpenGL: the CPU was not tried"};
    const bool gl = *times.gl_ms < clearly_faster * *times.cpu_ms;
    return {gl ? FlareEngine::gl : FlareEngine::cpu,
            fmt::format("{}: a trial picture took {:.0f} ms on the CPU, {:.0f} ms in OpenGL",
                        gl ? "OpenGL" : "CPU", *times.cpu_ms, *times.gl_ms)};
}

std::optional<EngineTimes> time_engines(const FlareScene& scene, const FlareRequest& request,
                                        const DrawPlanned& gl, const std::string& gl_refusal,
                                        double budget_ms, std::stop_token stop) {
    EngineTimes times;
    times.gl_refusal = gl_refusal;
    const auto began = Clock::now();
    FlareRequest trial = request;
    trial.width_px = std::min(trial_width_px, request.width_px);
    trial.tolerance = std::max(trial_tolerance, request.tolerance);
    trial.highlighted.clear();
    const auto ms_of = [&](const DrawPlanned& draw) {
        const auto started = Clock::now();
        draw(scene, trial, stop);
        return ms_since(started);
    };
    try {
        for (std::size_t count = first_ghosts;; count *= growth) {
            trial.only = some_of(scene.ghosts, std::min(count, scene.ghosts.size()));
            times.cpu_ms = ms_of(render_planned);
            if (count == first_ghosts)
                times.cpu_ms = std::min(*times.cpu_ms, ms_of(render_planned));
            if (gl) {
                if (count == first_ghosts) ms_of(gl);  // drivers finish their shaders in it
                times.gl_ms = ms_of(gl);
            }
            if (stop.stop_requested()) return std::nullopt;
            if (count >= scene.ghosts.size()) break;
            const bool ahead = times.gl_ms && *times.gl_ms < *times.cpu_ms;
            if (ahead ? ms_since(began) > to_be_sure * budget_ms
                      : ms_since(began) * (1 + growth) > budget_ms)
                break;
        }
    } catch (const Error& error) {  // the CPU's engine throws none
        times.gl_ms.reset();
        times.gl_refusal = error.what();
        if (!times.cpu_ms) times.cpu_ms = ms_of(render_planned);
    }
    return times;
}

}  // namespace ghostlight
