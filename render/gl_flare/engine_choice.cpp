#include "render/gl_flare/engine_choice.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/error.h"
#include "core/flare/planned_flare.h"
#include "render/gl_flare/gl_flare.h"

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

using Clock = std::chrono::steady_clock;
template <class Work>
double ms_of(Work work) {
    const auto began = Clock::now();
    work();
    return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
}

/// So many ghosts from all along the list.
std::vector<GhostPath> some_of(const std::vector<GhostPath>& ghosts, std::size_t count) {
    std::vector<GhostPath> some;
    for (std::size_t k = 0; k < count; ++k) some.push_back(ghosts[k * ghosts.size() / count]);
    return some;
}

}  // namespace

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

EngineTimes time_engines(const FlareScene& scene, const FlareRequest& request, GlFlare* gl,
                         const std::string& gl_refusal, double budget_ms) {
    EngineTimes times;
    times.gl_refusal = gl_refusal;
    const auto began = Clock::now();
    const auto spent_ms = [&] {
        return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
    };
    FlareRequest trial = request;
    trial.width_px = std::min(trial_width_px, request.width_px);
    trial.tolerance = std::max(trial_tolerance, request.tolerance);
    trial.highlighted.clear();
    const auto draw_cpu = [&] { return ms_of([&] { render_planned(scene, trial); }); };
    const auto draw_gl = [&] {
        return ms_of([&] {
            gl->draw_to_texture(scene, trial);
            glFinish();
        });
    };
    try {
        for (std::size_t count = first_ghosts;; count *= growth) {
            trial.only = some_of(scene.ghosts, std::min(count, scene.ghosts.size()));
            times.cpu_ms = draw_cpu();
            if (count == first_ghosts) times.cpu_ms = std::min(*times.cpu_ms, draw_cpu());
            if (gl != nullptr) {
                if (count == first_ghosts) draw_gl();  // drivers finish their shaders in it
                times.gl_ms = draw_gl();
            }
            if (count >= scene.ghosts.size()) break;
            const bool ahead = times.gl_ms && *times.gl_ms < *times.cpu_ms;
            if (ahead ? spent_ms() > to_be_sure * budget_ms : spent_ms() * (1 + growth) > budget_ms)
                break;
        }
    } catch (const Error& error) {  // the CPU's engine throws none
        times.gl_ms.reset();
        times.gl_refusal = error.what();
        if (!times.cpu_ms) times.cpu_ms = draw_cpu();
    }
    return times;
}

}  // namespace ghostlight
