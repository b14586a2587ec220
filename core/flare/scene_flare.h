#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/extended_flare.h"
#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"
#include "core/flare/light_pattern.h"
#include "core/flare/scene.h"
#include "core/flare/starburst.h"

namespace ghostlight {

/// A lens compiled for the spectra of several lights, kept as long as the lens and they stay.
class CompiledSpectra {
   public:
    explicit CompiledSpectra(CoatingModel model = CoatingModel::exact) : model_(model) {}
    /// Throws Error like compile(). The reference holds until a call for another lens.
    const FlareScene& of(const Prescription& lens, const Spectrum& spectrum);

   private:
    CoatingModel model_;
    Prescription lens_;
    std::vector<std::unique_ptr<const FlareScene>> scenes_;
};

/// An engine: draws the ghost layer of a point light.
using DrawGhosts = std::function<std::optional<FlareImage>(
    const FlareScene& scene, const FlareRequest& request, std::stop_token stop)>;

/// Where a light's picture comes from; throws Error when it cannot be read.
using PatternOf = std::function<LightPattern(const LightSize& size)>;

/// What the layers of a scene are made from. All must outlive it.
struct SceneView {
    const Prescription& lens;  ///< configured
    const Scene& scene;
    CompiledSpectra& spectra;
    const PatternOf& pattern_of;
    const DrawGhosts& draw;
};

/// The scene's ghosts: of each light that is on, times its intensity, balanced for the first
/// light's spectrum. Point lights are drawn by `view.draw`, lights of some extent and ghosts that
/// an artist has changed by render_extended(), or sampled where the planned method cannot serve.
/// The light, spectrum and selection of `request` are set here. The plan is the active light's.
/// Nothing when stopped.
std::optional<FlareImage> ghosts_layer(const SceneView& view, const FlareRequest& request,
                                       std::stop_token stop = {});

/// The scene's veil: ghosts folded away, as one series, and the lens's scatter about each light's
/// image. Black when neither is asked for. `ghosts`: the scene's own layer, if it is there, which
/// knows what it folded; without it all ghosts are probed again. Nothing when stopped.
std::optional<FlareImage> veil_layer(const SceneView& view, const FlareRequest& request,
                                     std::stop_token stop = {}, const FlareImage* ghosts = nullptr);

/// What draws the starburst of a point light on a sensor of some size.
using DrawStarburst = std::function<std::optional<FlareImage>(
    const Prescription& lens, const StarburstRequest& request, std::stop_token stop)>;

/// The scene's starburst: of each light that is on, times its intensity. Of a light of some extent
/// it is the point's, folded with the light's shape as the direct image maps it. Nothing when
/// stopped.
std::optional<FlareImage> starburst_layer(const SceneView& view, const FlareRequest& request,
                                          const DrawStarburst& draw, std::stop_token stop = {});

/// A picture of a sensor without light.
FlareImage black_image(const Sensor& sensor, int width_px);

/// What a light's own colours and irradiance are multiplied by in its scene.
std::array<double, 4> gain_of(const Scene& scene, const Light& light);

}  // namespace ghostlight
