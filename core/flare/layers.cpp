#include "core/flare/layers.h"

#include <algorithm>

#include "core/flare/extended_flare.h"
#include "core/flare/light.h"

namespace ghostlight {

std::string_view name(LayerKind kind) {
    switch (kind) {
        case LayerKind::ghosts:
            return "ghosts";
        case LayerKind::starburst:
            return "starburst";
        case LayerKind::veil:
            return "veil";
        case LayerKind::backdrop:
            break;
    }
    return "backdrop";
}

std::optional<LayerKind> find_layer(std::string_view wanted) {
    for (const LayerKind kind : layer_kinds)
        if (name(kind) == wanted) return kind;
    return std::nullopt;
}

FlareImage compose(std::span<const LayerImage> layers, const LayerSettings& settings) {
    FlareImage sum;
    for (const LayerImage& layer : layers) {
        if (!settings.shows(layer.kind)) continue;
        const double gain = gain_of_ev(settings.of(layer.kind).gain_ev);
        if (sum.irradiance.empty()) {
            sum = *layer.image;
            if (gain == 1.0) continue;
            std::ranges::fill(sum.rgb, 0.0F);
            std::ranges::fill(sum.irradiance, 0.0F);
            std::ranges::fill(sum.highlight, 0.0F);
            sum.flux_mm2 = sum.flux_on_sensor_mm2 = 0.0;
            sum.rays = sum.cells = 0;
            sum.times = {};
        }
        add_image(sum, *layer.image, {gain, gain, gain, gain});
    }
    return sum;
}

}  // namespace ghostlight
