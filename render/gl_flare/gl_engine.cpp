#include "render/gl_flare/gl_engine.h"

#include <memory>
#include <utility>

#include "render/gl_flare/gl_flare.h"
#include "render/offscreen.h"

namespace ghostlight {
namespace {

/// The flare's objects go before their context.
struct Offscreen {
    OffscreenContext context;
    std::string renderer = gl_offer().renderer;
    GlFlare flare;
};

}  // namespace

GlEngine offscreen_gl_engine() {
    auto gl = std::make_shared<Offscreen>();
    std::string renderer = gl->renderer;
    return {std::move(renderer),
            [gl = std::move(gl)](const FlareScene& scene, const FlareRequest& request,
                                 std::stop_token stop) {
                return gl->flare.render(scene, request, std::move(stop));
            }};
}

}  // namespace ghostlight
