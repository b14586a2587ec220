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
/// The trial's picture is small and rough, so that both engines fit into the budget.
constexpr int trial_width_px = 640;
constexpr double trial_tolerance = 0.04;
/// Before it, a few ghosts on a smaller one: an OpenGL that takes so many times what the CPU does
/// there (one in software) is not tried further, since that would take seconds.
constexpr std::size_t few_ghosts = 8;
constexpr int few_width_px = 240;
constexpr double few_tolerance = 0.1, hopeless = 2.5;

using Clock = std::chrono::steady_clock;
template <class Work>
double ms_of(Work work) {
    const auto began = Clock::now();
    work();
    return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
}

/// A few ghosts from all along the list.
std::vector<GhostPath> some_of(const std::vector<GhostPath>& ghosts) {
    std::vector<GhostPath> some;
    const std::size_t step = std::max<std::size_t>(1, ghosts.size() / few_ghosts);
    for (std::size_t g = 0; g < ghosts.size(); g += step) some.push_back(ghosts[g]);
    return some;
}

void keep_best(std::optional<double>& best, double ms) { best = std::min(best.value_or(ms), ms); }

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
    trial.width_px = std::min(few_width_px, request.width_px);
    trial.tolerance = few_tolerance;
    trial.highlighted.clear();
    trial.only = some_of(scene.ghosts);
    const auto draw_cpu = [&] { return ms_of([&] { render_planned(scene, trial); }); };
    const auto draw_gl = [&] {
        return ms_of([&] {
            gl->draw_to_texture(scene, trial);
            glFinish();
        });
    };
    try {
        if (gl != nullptr) {
            draw_gl();  // drivers finish their shaders in the first picture
            times.gl_ms = draw_gl();
        }
        times.cpu_ms = draw_cpu();
        if (times.gl_ms && *times.gl_ms > hopeless * *times.cpu_ms) return times;
        trial.width_px = std::min(trial_width_px, request.width_px);
        trial.tolerance = std::max(trial_tolerance, request.tolerance);
        trial.only = request.only;
        times.cpu_ms.reset();
        times.gl_ms.reset();
        double round_ms = 0.0;
        do {
            const double before = spent_ms();
            keep_best(times.cpu_ms, draw_cpu());
            if (gl != nullptr) keep_best(times.gl_ms, draw_gl());
            round_ms = spent_ms() - before;
        } while (spent_ms() + round_ms <= budget_ms);
    } catch (const Error& error) {  // the CPU's engine throws none
        times.gl_ms.reset();
        times.gl_refusal = error.what();
        if (!times.cpu_ms) times.cpu_ms = draw_cpu();
    }
    return times;
}

}  // namespace ghostlight
