#include "core/optics/reverse.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.h"

namespace ghostlight {

namespace {

BaseCurve mirrored(BaseCurve curve) {
    if (auto* radius = std::get_if<Radius>(&curve)) radius->mm = -radius->mm;
    if (auto* curvature = std::get_if<Curvature>(&curve)) curvature->per_mm = -curvature->per_mm;
    return curve;
}

/// Row `row` follows `row - 1` through a gap that lies, reversed, after the mirrored row.
std::size_t mirrored_gap(std::size_t row, std::size_t count) {
    return row + 1 == count ? row : count - 2 - row;
}

}  // namespace

Coating reversed(const Coating& coating) {
    Coating turned = coating;
    // A stack listed from the air is listed so from either side; tables hold for both sides.
    if (auto* stack = std::get_if<LayerStack>(&turned); stack != nullptr && !stack->from_air)
        std::ranges::reverse(stack->layers);
    return turned;
}

Prescription reversed(const Prescription& lens) {
    Prescription turned = lens;
    const std::size_t count = lens.surfaces.size();
    if (count == 0) return turned;
    if (!is_air(lens.surfaces.back().medium_after))
        throw Error({"the lens cannot be reversed",
                     {},
                     {},
                     describe(lens.surfaces.back().medium_after) + " after the last surface",
                     "air there, as light comes from air"});
    for (std::size_t row = 0; row < count; ++row) {
        const Surface& from = lens.surfaces[count - 1 - row];
        Surface& to = turned.surfaces[row];
        to = from;
        to.curve = mirrored(from.curve);
        for (double& term : to.aspheric) term = -term;
        to.medium_after = medium_before(lens, count - 1 - row);
        to.thickness_mm = lens.surfaces[mirrored_gap(row, count)].thickness_mm;
        to.coating = reversed(from.coating);
    }
    turned.stop.surface = count - 1 - lens.stop.surface;
    for (Configuration& configuration : turned.configurations) {
        std::map<std::size_t, double> gaps;
        for (const auto& [row, thickness_mm] : configuration.thickness_mm)
            gaps[mirrored_gap(row, count)] = thickness_mm;
        configuration.thickness_mm = std::move(gaps);
    }
    return turned;
}

}  // namespace ghostlight
