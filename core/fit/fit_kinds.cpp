#include "core/fit/fit_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ghostlight {
namespace {

constexpr FitKindData kinds[] = {
    {FitKind::center, "center", "λ0", "nm", false, false},
    {FitKind::thickness, "thickness", "thickness", "×", false, false},
    {FitKind::layer_thickness, "layer", "layer", "nm", false, true},
    {FitKind::layer_index, "layer-index", "index of layer", "", false, true},
    {FitKind::reflectance, "reflectance", "R", "", false, false},
    {FitKind::radius, "radius", "radius", "mm", false, false},
    {FitKind::gap, "gap", "gap after", "mm", false, false},
    {FitKind::index, "index", "index after", "", false, false},
    {FitKind::semi_diameter, "semi-diameter", "semi-diameter", "mm", false, false},
    {FitKind::stop_size, "stop-size", "stop size", "×", true, false},
    {FitKind::stop_x, "stop-x", "stop x", "mm", true, false},
    {FitKind::stop_y, "stop-y", "stop y", "mm", true, false},
    {FitKind::stop_rotation, "stop-rotation", "blades", "°", true, false},
};

}  // namespace

std::span<const FitKindData> fit_kinds() { return kinds; }

const FitKindData& data_of(FitKind kind) {
    return *std::ranges::find(kinds, kind, &FitKindData::kind);
}

Medium* layer_medium(Coating& coating, std::size_t layer) {
    if (auto* film = std::get_if<QuarterWave>(&coating))
        return layer == 0 ? std::get_if<Medium>(&film->layer) : nullptr;
    if (auto* stack = std::get_if<LayerStack>(&coating))
        return layer < stack->layers.size() ? &stack->layers[layer].medium : nullptr;
    return nullptr;
}

std::optional<double> value_in(const Prescription& lens, FitKind kind, std::size_t row,
                               std::size_t layer) {
    Surface surface = row < lens.surfaces.size() ? lens.surfaces[row] : Surface{};
    switch (kind) {
        case FitKind::center:
            if (const auto* film = std::get_if<QuarterWave>(&surface.coating))
                return film->center_nm;
            return std::nullopt;
        case FitKind::thickness:
            if (const auto* film = std::get_if<QuarterWave>(&surface.coating))
                return film->thickness_factor;
            if (std::holds_alternative<LayerStack>(surface.coating)) return 1.0;
            return std::nullopt;
        case FitKind::layer_thickness:
            if (const auto* stack = std::get_if<LayerStack>(&surface.coating))
                if (layer < stack->layers.size()) return stack->layers[layer].thickness_nm;
            return std::nullopt;
        case FitKind::layer_index:
            if (layer_medium(surface.coating, layer)) return 0.0;
            return std::nullopt;
        case FitKind::reflectance:
            if (const auto* fixed = std::get_if<ConstantReflectance>(&surface.coating))
                return fixed->reflectance;
            return std::nullopt;
        case FitKind::radius: {
            const double c = curvature_per_mm(surface.curve);
            if (c == 0.0) return std::nullopt;
            return 1.0 / c;
        }
        case FitKind::gap:
            if (row + 1 == lens.surfaces.size() && lens.sensor.at_paraxial_focus)
                return std::nullopt;
            return surface.thickness_mm;
        case FitKind::index:
            if (is_air(surface.medium_after)) return std::nullopt;
            return 0.0;
        case FitKind::semi_diameter:
            return surface.semi_diameter_mm;
        case FitKind::stop_size:
            return 1.0;
        case FitKind::stop_x:
        case FitKind::stop_y:
            return 0.0;
        case FitKind::stop_rotation:
            return lens.stop.blades > 2 ? std::optional(lens.stop.rotation_deg) : std::nullopt;
    }
    return std::nullopt;
}

std::string why_not(const Prescription& lens, FitKind kind, std::size_t row) {
    const std::string coating =
        row < lens.surfaces.size() ? describe(lens.surfaces[row].coating) : "";
    switch (kind) {
        case FitKind::center:
            return fmt::format("a quarter-wave coating there (it has {})",
                               coating.empty() ? "none" : coating);
        case FitKind::thickness:
        case FitKind::layer_thickness:
        case FitKind::layer_index:
            return fmt::format("a coating of such layers there (it has {})",
                               coating.empty() ? "none" : coating);
        case FitKind::reflectance:
            return "a coating of constant reflectance there";
        case FitKind::radius:
            return "a surface that is not plane";
        case FitKind::gap:
            return "a sensor that is not put at the paraxial focus";
        case FitKind::index:
            return "glass behind that surface";
        case FitKind::stop_rotation:
            return "a stop with blades";
        default:
            return "a surface of the lens";
    }
}

void set_defaults(FitParameter& p) {
    auto around = [&](double sigma, double reach) {
        p.prior = sigma;
        p.lower = p.start - reach;
        p.upper = p.start + reach;
    };
    switch (p.kind) {
        case FitKind::center:
            // Anywhere in the visible range: what makers choose is not published.
            p.prior = 80.0;
            p.lower = 350.0;
            p.upper = 900.0;
            return;
        case FitKind::thickness:
            around(0.05, 0.4);
            return;
        case FitKind::layer_thickness:
            around(0.05 * p.start, 0.8 * p.start);
            return;
        case FitKind::layer_index:
            around(0.02, 0.15);
            return;
        case FitKind::reflectance:
            p.prior = 0.01;
            p.lower = 0.0;
            p.upper = std::max(0.2, 4.0 * p.start);
            return;
        case FitKind::radius:
            around(0.002 * std::abs(p.start), 0.02 * std::abs(p.start));
            return;
        case FitKind::gap:
            around(0.03, 0.5);
            return;
        case FitKind::index:
            around(5e-4, 5e-3);
            return;
        case FitKind::semi_diameter:
            around(0.1, 0.1 * p.start);
            return;
        case FitKind::stop_size:
            around(0.03, 0.3);
            return;
        case FitKind::stop_x:
        case FitKind::stop_y:
            around(0.1, 1.0);
            return;
        case FitKind::stop_rotation:
            around(5.0, 30.0);
            return;
    }
}

}  // namespace ghostlight
