#include "widgets/layered_picture.h"

#include <algorithm>
#include <utility>

#include "core/elapsed.h"
#include "core/error.h"
#include "core/io/scene_pictures.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight {

namespace {

/// What of a scene a layer depends on; the rest as it is by default.
Scene what_matters(LayerKind kind, const Scene& scene) {
    Scene key = scene;
    const bool folds = scene.veil.folded_share > 0.0 && scene.layers.shows(LayerKind::veil);
    key.layers = {};
    key.tolerance = key.flare_tolerance = 0.0;
    key.ringing = scene.ringing && kind == LayerKind::ghosts;
    for (Light& light : key.lights) {
        light.name.clear();
    }
    switch (kind) {
        case LayerKind::ghosts:
            key.backdrop = {};
            if (!folds) {
                key.veil = {};
            }
            key.veil.spread = {};
            break;
        case LayerKind::veil:
            key.backdrop = {};
            break;
        case LayerKind::starburst:
            key.backdrop = {};
            key.veil = {};
            key.artistic = {};
            break;
        case LayerKind::backdrop:
            key.lights = {Light{}};
            key.active_light = 0;
            key.veil = {};
            key.artistic = {};
            break;
    }
    return key;
}

/// Spectra and sizes of pictures whose moving starbursts are kept.
constexpr std::size_t most_moving = 8;

bool is_same(LayerKind kind, const FlareRequest& a, const FlareRequest& b) {
    if (kind == LayerKind::backdrop) {
        return a.width_px == b.width_px;
    }
    return a.width_px == b.width_px && a.tolerance == b.tolerance && a.search == b.search &&
           (kind != LayerKind::ghosts || a.highlighted == b.highlighted);
}

}  // namespace

const LayeredPicture::Kept* LayeredPicture::find(LayerKind kind, const Wanted& wanted) const {
    for (const auto& kept : kept_[static_cast<std::size_t>(kind)]) {
        if (kept && is_same(kind, kept->request, wanted.request) &&
            kept->scene == what_matters(kind, wanted.scene) && kept->lens == wanted.lens) {
            return &*kept;
        }
    }
    return nullptr;
}

bool LayeredPicture::is_at_rest(const Wanted& wanted) const {
    for (const LayerKind kind : layer_kinds) {
        if (wanted.scene.layers.shows(kind) && find(kind, wanted) == nullptr) {
            return false;
        }
    }
    return true;
}

std::optional<FlareImage> LayeredPicture::draw_layer(LayerKind kind, const SceneView& view,
                                                     const Wanted& wanted, const FlareImage* ghosts,
                                                     std::stop_token stop) {
    switch (kind) {
        case LayerKind::ghosts:
            return ghosts_layer(view, wanted.request, std::move(stop));
        case LayerKind::veil:
            return veil_layer(view, wanted.request, std::move(stop), ghosts);
        case LayerKind::backdrop:
            if (!wanted.scene.backdrop.file.empty()) {
                return read_backdrop(
                    wanted.scene.backdrop.file, wanted.lens.sensor, wanted.request.width_px,
                    sunlit_white_per_e0(first_order(compile(wanted.lens, d_line_nm)).f_number));
            }
            break;
        case LayerKind::starburst:
            if (wanted.is_final) {
                return starburst_layer(view, wanted.request, render_starburst, std::move(stop));
            }
            return starburst_layer(
                view, wanted.request,
                [this](const Prescription& lens, const StarburstRequest& request,
                       const std::stop_token&) { return moving_starburst(lens, request); },
                std::move(stop));
    }
    return black_image(wanted.lens.sensor, wanted.request.width_px);
}

std::optional<FlareImage> LayeredPicture::moving_starburst(const Prescription& lens,
                                                           const StarburstRequest& request) {
    const auto fits = [&](const Moving& of) {
        return of.spectrum == request.spectrum && of.width_px == request.width_px &&
               of.lens == lens;
    };
    auto found = std::ranges::find_if(moving_, fits);
    if (found == moving_.end()) {
        std::erase_if(moving_, [&](const Moving& of) { return of.lens != lens; });
        if (moving_.size() >= most_moving) {
            moving_.erase(moving_.begin());
        }
        moving_.push_back({lens, request.spectrum, request.width_px,
                           std::make_unique<MovingStarburst>(lens, request)});
        found = moving_.end() - 1;
    }
    return found->starburst->frame(request.light);
}

std::optional<LayeredPicture::Result> LayeredPicture::make(const Wanted& wanted,
                                                           const DrawGhosts& draw,
                                                           std::stop_token stop) {
    static const PatternOf pattern_of = pattern_of_size;
    const SceneView view{wanted.lens, wanted.scene, spectra_, pattern_of, draw};
    const auto began = Clock::now();
    Result result;
    bool drew = false;
    for (const LayerKind kind : layer_kinds) {
        if (!wanted.scene.layers.shows(kind)) {
            continue;
        }
        if (const Kept* kept = find(kind, wanted)) {
            result.layers.push_back({kind, kept->image});
            continue;
        }
        // Ghosts come before the veil.
        const auto ghosts = std::ranges::find(result.layers, LayerKind::ghosts, &ShownLayer::kind);
        std::optional<FlareImage> image =
            draw_layer(kind, view, wanted,
                       ghosts == result.layers.end() ? nullptr : ghosts->image.get(), stop);
        if (!image) {
            return std::nullopt;
        }
        drew = true;
        auto shared = std::make_shared<const FlareImage>(std::move(*image));
        if (wanted.is_final || kind == LayerKind::backdrop) {
            kept_[static_cast<std::size_t>(kind)][wanted.is_final ? 0 : 1] =
                Kept{wanted.lens, what_matters(kind, wanted.scene), wanted.request, shared};
        }
        result.layers.push_back({kind, std::move(shared)});
    }
    const LayerSettings& settings = wanted.scene.layers;
    if (result.layers.size() == 1 && settings.of(result.layers.front().kind).gain_ev == 0.0) {
        result.sum = result.layers.front().image;
    } else {
        std::vector<LayerImage> layers;
        for (const ShownLayer& layer : result.layers) {
            layers.push_back({layer.kind, layer.image.get()});
        }
        FlareImage sum = layers.empty() ? black_image(wanted.lens.sensor, wanted.request.width_px)
                                        : compose(layers, settings);
        result.sum = std::make_shared<const FlareImage>(std::move(sum));
    }
    result.drawing_ms = drew ? ms_since(began) : 0.0;
    return result;
}

}  // namespace ghostlight
