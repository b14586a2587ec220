#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "core/flare/flare_image.h"

namespace ghostlight {

/// What a flare picture is the sum of.
enum class LayerKind { ghosts, starburst, veil, backdrop };
inline constexpr std::array layer_kinds = {LayerKind::ghosts, LayerKind::starburst, LayerKind::veil,
                                           LayerKind::backdrop};
/// "ghosts", "starburst", …
std::string_view name(LayerKind kind);
std::optional<LayerKind> find_layer(std::string_view name);

struct LayerSetting {
    bool on = false;
    double gain_ev = 0.0;
    bool operator==(const LayerSetting&) const = default;
};

/// Which layers are seen, and how bright.
struct LayerSettings {
    std::array<LayerSetting, layer_kinds.size()> each = {LayerSetting{.on = true, .gain_ev = 0.0}};
    std::optional<LayerKind> alone;  ///< this one only
    bool operator==(const LayerSettings&) const = default;

    LayerSetting& of(LayerKind kind) { return each[static_cast<std::size_t>(kind)]; }
    const LayerSetting& of(LayerKind kind) const { return each[static_cast<std::size_t>(kind)]; }
    bool shows(LayerKind kind) const { return alone ? *alone == kind : of(kind).on; }
};

/// One layer's picture, linear, over E0, without its gain; all of a picture are of the same size.
struct LayerImage {
    LayerKind kind = LayerKind::ghosts;
    const FlareImage* image = nullptr;
};

/// The sum of the layers that are seen, each times its gain. Counts, times and plan are the ghosts'
/// where those are among them. Empty without any layer.
FlareImage compose(std::span<const LayerImage> layers, const LayerSettings& settings);

}  // namespace ghostlight
