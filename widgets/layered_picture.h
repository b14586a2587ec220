#pragma once

#include <array>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/layers.h"
#include "core/flare/scene_flare.h"

namespace ghostlight {

/// One layer of a picture, linear, without its gain.
struct ShownLayer {
    LayerKind kind = LayerKind::ghosts;
    std::shared_ptr<const FlareImage> image;
};

/// Makes the layers of a scene and keeps those at rest, so that what does not change a layer does
/// not draw it again: gains and switches only add up what is there. Belongs to one thread.
class LayeredPicture {
   public:
    /// What all layers of a picture have in common.
    struct Wanted {
        const Prescription& lens;  ///< configured
        const Scene& scene;
        FlareRequest request;  ///< tolerance, search, width and highlight
        bool is_final = false;
    };
    struct Result {
        std::shared_ptr<const FlareImage> sum;
        std::vector<ShownLayer> layers;  ///< of the sum, in its order
        double drawing_ms = 0.0;         ///< 0 when all were there
    };

    /// Layers that are on, drawn with `draw` where they are ghosts of a point light. Throws Error
    /// for a lens, spectrum or picture that does not do; nothing when stopped.
    std::optional<Result> make(const Wanted& wanted, const DrawGhosts& draw, std::stop_token stop);
    /// Whether all layers that the scene shows are there at rest: then there is no need for a
    /// coarse picture first.
    bool is_at_rest(const Wanted& wanted) const;

    /// Draws a layer anew the next time, whatever was kept.
    void forget(LayerKind kind) { kept_[static_cast<std::size_t>(kind)] = {}; }

    const FlareScene& compiled(const Prescription& lens, const Spectrum& spectrum) {
        return spectra_.of(lens, spectrum);
    }

   private:
    struct Kept {
        Prescription lens;
        Scene scene;  ///< what of it matters to the layer
        FlareRequest request;
        std::shared_ptr<const FlareImage> image;
    };
    const Kept* find(LayerKind kind, const Wanted& wanted) const;
    std::optional<FlareImage> draw_layer(LayerKind kind, const SceneView& view,
                                         const Wanted& wanted, const FlareImage* ghosts,
                                         std::stop_token stop);
    /// While a light moves: its pattern at a few fields, moved.
    std::optional<FlareImage> moving_starburst(const Prescription& lens,
                                               const StarburstRequest& request);

    CompiledSpectra spectra_;
    struct Moving {
        Prescription lens;
        Spectrum spectrum;
        int width_px = 0;
        std::unique_ptr<MovingStarburst> starburst;
    };
    std::vector<Moving> moving_;
    /// At rest, and of the coarse size where that costs more than it holds.
    std::array<std::array<std::optional<Kept>, 2>, layer_kinds.size()> kept_;
};

}  // namespace ghostlight
