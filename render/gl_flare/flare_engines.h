#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"
#include "render/gl_flare/engine_choice.h"
#include "render/gl_flare/gl_engine.h"

namespace ghostlight {

/// The engine in use, for whoever shows it.
struct EngineState {
    FlareEngineChoice choice;
    std::string gl_renderer;  ///< empty until OpenGL was found to work
    bool is_settled = false;  ///< false before the choice has been made: the CPU serves meanwhile
    bool gave_up = false;     ///< OpenGL was in use, and failed
    bool operator==(const EngineState&) const = default;
};

/// Draws planned pictures with the engine that is wished for or is the faster one. Belongs to one
/// thread, OpenGL's context with it.
class FlareEngines {
   public:
    explicit FlareEngines(MakeGlEngine make_gl = offscreen_gl_engine);

    void wish(FlareEngine engine);
    /// By the engine in use. Where OpenGL fails, by the CPU at once, and for good.
    std::optional<FlareImage> draw(const FlareScene& scene, const FlareRequest& request,
                                   std::stop_token stop = {});
    /// Makes the choice that the wish leaves open; for a moment when nobody waits for a picture.
    /// Making OpenGL and its trial take some hundred ms, once; when stopped they are made up for at
    /// the next call. True if another engine is in use afterwards.
    bool settle(const FlareScene& scene, const FlareRequest& request, std::stop_token stop = {});
    const EngineState& state() const { return state_; }
    /// Gives OpenGL back.
    void close();

   private:
    MakeGlEngine make_gl_;
    FlareEngine wish_ = FlareEngine::automatic;
    std::optional<GlEngine> gl_;
    EngineTimes times_;      ///< of the one trial
    bool is_timed_ = false;  ///< and with it, whether there has been one
    EngineState state_;
    void refuse_gl(const std::string& why);
};

}  // namespace ghostlight
