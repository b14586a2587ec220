#include "render/gl_flare/flare_engines.h"

#include <exception>
#include <utility>

#include "core/error.h"
#include "core/flare/planned_flare.h"
#include "core/flare/ringing.h"

namespace ghostlight {

FlareEngines::FlareEngines(MakeGlEngine make_gl) : make_gl_(std::move(make_gl)) {
    wish(FlareEngine::automatic);
}

void FlareEngines::wish(FlareEngine engine) {
    if (engine == wish_ && (state_.is_settled || !state_.choice.reason.empty())) return;
    wish_ = engine;
    if (engine == FlareEngine::gl) {  // asked for by hand: it may have come back
        times_.gl_refusal.clear();
        state_.gave_up = false;
    }
    state_.is_settled = engine == FlareEngine::cpu;
    state_.choice = {FlareEngine::cpu,
                     state_.is_settled ? "CPU: as asked" : "CPU: the engines are not tried yet"};
}

void FlareEngines::refuse_gl(const std::string& why) {
    gl_.reset();
    times_.gl_ms.reset();
    times_.gl_refusal = why;
    state_.gl_renderer.clear();
}

std::optional<FlareImage> FlareEngines::draw(const FlareScene& scene, const FlareRequest& request,
                                             std::stop_token stop) {
    if (state_.choice.engine == FlareEngine::gl && gl_) {
        try {
            std::optional<FlareImage> image = gl_->draw(scene, request, stop);
            if (image && request.ringing && !add_ringing(scene, request, stop, *image))
                return std::nullopt;
            return image;
        } catch (const std::exception& error) {
            refuse_gl(error.what());
            state_.gave_up = true;
            state_.choice = choose_engine(wish_, times_);
        }
    }
    return render_planned(scene, request, std::move(stop));
}

bool FlareEngines::settle(const FlareScene& scene, const FlareRequest& request,
                          std::stop_token stop) {
    if (state_.is_settled || stop.stop_requested()) return false;
    if (!gl_ && times_.gl_refusal.empty()) {
        try {
            gl_ = make_gl_();
            state_.gl_renderer = gl_->renderer;
        } catch (const std::exception& error) {
            refuse_gl(error.what());
        }
    }
    if (gl_ && wish_ == FlareEngine::automatic && !is_timed_) {
        const auto times = time_engines(scene, request, gl_->draw, {}, 100.0, std::move(stop));
        if (!times) return false;
        times_ = *times;
        is_timed_ = true;
        if (!times_.gl_ms) refuse_gl(times_.gl_refusal);
    }
    // A wish for OpenGL needs no trial: its pictures show whether it works.
    EngineTimes known = times_;
    if (gl_ && !known.gl_ms) known.gl_ms = 0.0;
    state_.choice = choose_engine(wish_, known);
    state_.is_settled = true;
    return state_.choice.engine == FlareEngine::gl;
}

void FlareEngines::close() {
    gl_.reset();
    state_ = {};
    wish(wish_);
}

}  // namespace ghostlight
