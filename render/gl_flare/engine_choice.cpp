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
/// The trial's picture is small and rough, so that both engines fit into the budget several times.
constexpr int trial_width_px = 640;
constexpr double trial_tolerance = 0.04;
/// A first picture of OpenGL that takes so many times the CPU's, and more than the whole budget.
constexpr double hopeless = 3.0;

using Clock = std::chrono::steady_clock;
template <class Work>
double ms_of(Work work) {
    const auto began = Clock::now();
    work();
    return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
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
    FlareRequest trial = request;
    trial.width_px = std::min(trial_width_px, request.width_px);
    trial.tolerance = std::max(trial_tolerance, request.tolerance);
    trial.highlighted.clear();
    const auto draw_gl = [&] {
        gl->draw_to_texture(scene, trial);
        glFinish();
    };
    const auto began = Clock::now();
    const auto spent_ms = [&] {
        return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
    };
    bool with_gl = gl != nullptr;
    const auto try_gl = [&](auto use) {
        if (!with_gl) return;
        try {
            use(ms_of(draw_gl));
        } catch (const Error& error) {
            with_gl = false;
            times.gl_ms.reset();
            times.gl_refusal = error.what();
        }
    };
    double round_ms = 0.0;
    const auto draw_cpu = [&] { render_planned(scene, trial); };
    keep_best(times.cpu_ms, ms_of(draw_cpu));
    // Drivers finish their shaders in the first picture, so that it does not count, unless it took
    // so long that OpenGL will not come out ahead.
    try_gl([&](double ms) {
        if (ms > hopeless * *times.cpu_ms && ms > budget_ms) times.gl_ms = ms;
    });
    if (times.gl_ms) return times;
    do {
        const double before = spent_ms();
        keep_best(times.cpu_ms, ms_of(draw_cpu));
        try_gl([&](double ms) { keep_best(times.gl_ms, ms); });
        round_ms = spent_ms() - before;
    } while (spent_ms() + round_ms <= budget_ms);
    return times;
}

}  // namespace ghostlight
