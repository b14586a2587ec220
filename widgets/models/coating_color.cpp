#include "widgets/models/coating_color.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/flare/tone_map.h"

namespace ghostlight {

namespace {

Rgb reflected(const Medium& before, const Coating& coating, const Medium& after,
              const Spectrum& light) {
    constexpr int samples = 16;
    const auto nodes = sample(light, samples);
    const auto colors = sample_colors(light, nodes);
    Rgb sum;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const Film film = film_at(coating, before, after, nodes[k].wavelength_nm);
        const double share = nodes[k].weight * reflectances(film, 1.0).r();
        sum.r += share * colors[k].r;
        sum.g += share * colors[k].g;
        sum.b += share * colors[k].b;
    }
    return sum;
}

}  // namespace

std::optional<QColor> coating_color(const Medium& before, const Coating& coating,
                                    const Medium& after, const Spectrum& light) {
    Rgb color;
    try {
        color = reflected(before, coating, after, light);
    } catch (const Error&) {
        return std::nullopt;
    }
    const double strongest = std::max({color.r, color.g, color.b});
    if (!(strongest > 1e-9)) {
        return std::nullopt;
    }
    // Bare glass, 4 to 5 %, is the brightest; the square root keeps a good coating visible.
    constexpr double bare_reflectance = 0.045;
    const double level = std::clamp(std::sqrt(strongest / bare_reflectance), 0.35, 1.0);
    const auto channel = [&](double linear) {
        const double scaled = std::max(0.0, linear) / strongest * level * level * 0.75;
        return std::clamp(srgb_encoded(static_cast<float>(scaled)), 0.0F, 1.0F);
    };
    return QColor::fromRgbF(channel(color.r), channel(color.g), channel(color.b));
}

}  // namespace ghostlight
