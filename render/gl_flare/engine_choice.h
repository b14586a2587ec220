#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"
#include "render/gl_flare/gl_engine.h"

namespace ghostlight {

/// What the person at the machine wants to draw flares with.
enum class FlareEngine { automatic, cpu, gl };

/// "automatic", "cpu" or "opengl", as settings and options have it; nothing for other words.
const char* engine_name(FlareEngine engine);
std::optional<FlareEngine> parse_engine(std::string_view name);

/// What each engine takes for the same picture, ms. Nothing: it cannot, or was not tried.
struct EngineTimes {
    std::optional<double> cpu_ms, gl_ms;
    std::string gl_refusal;  ///< why OpenGL cannot, if it cannot
};

/// The engine that is used, and why, in words for a status line.
struct FlareEngineChoice {
    FlareEngine engine = FlareEngine::cpu;
    std::string reason;
    bool operator==(const FlareEngineChoice&) const = default;
};

/// Of the wish and the times alone. OpenGL has to be clearly faster, since the CPU's pictures are
/// the more exact. A wish for OpenGL that cannot be met falls back to the CPU and says why.
FlareEngineChoice choose_engine(FlareEngine wish, const EngineTimes& times);

/// Draws a part of the scene's ghosts with both engines, a larger part while that is likely to fit
/// into the budget, or into a few times that while OpenGL is ahead; the last times count. `gl` may
/// be empty (then `gl_refusal` says why). An Error of OpenGL becomes its refusal. Nothing when
/// stopped.
std::optional<EngineTimes> time_engines(const FlareScene& scene, const FlareRequest& request,
                                        const DrawPlanned& gl, const std::string& gl_refusal = {},
                                        double budget_ms = 100.0, std::stop_token stop = {});

}  // namespace ghostlight
