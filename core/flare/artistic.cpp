#include "core/flare/artistic.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/flare/light.h"

namespace ghostlight {
namespace {

/// Two normal deviates of a ghost, the same with every standard library (Box and Muller, Ann.
/// Math. Stat. 29 (1958) 610).
std::array<double, 2> deviates(const GhostPath& path, std::uint32_t seed) {
    std::uint64_t key = seed;
    for (const std::size_t row : path.reflections) key = key * 1000003ULL + row + 1;
    std::mt19937_64 engine(key);
    const auto unit = [&] { return (static_cast<double>(engine() >> 11) + 0.5) * 0x1.0p-53; };
    const double radius = std::sqrt(-2.0 * std::log(unit()));
    const double angle = 2.0 * std::numbers::pi * unit();
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

bool Artistic::is_neutral() const {
    return exaggeration_ev == 0.0 && jitter_mm == 0.0 &&
           std::ranges::all_of(ghosts, [](const GhostStyle& style) {
               return style == GhostStyle{.path = style.path};
           });
}

GhostLook look_of(const Artistic& artistic, const GhostPath& path) {
    GhostLook look;
    double gain = gain_of_ev(artistic.exaggeration_ev);
    std::array<double, 3> tint = {1.0, 1.0, 1.0};
    for (const GhostStyle& style : artistic.ghosts) {
        if (style.path != path) continue;
        look.on = look.on && style.on;
        gain *= gain_of_ev(style.gain_ev);
        for (std::size_t c = 0; c < 3; ++c) tint[c] *= style.tint[c];
        look.offset_x_mm += style.offset_x_mm;
        look.offset_y_mm += style.offset_y_mm;
    }
    if (artistic.jitter_mm > 0.0) {
        const auto [x, y] = deviates(path, artistic.seed);
        look.offset_x_mm += artistic.jitter_mm * x;
        look.offset_y_mm += artistic.jitter_mm * y;
    }
    // The colourless irradiance goes with the tint's luminance.
    look.gain = {gain * tint[0], gain * tint[1], gain * tint[2],
                 gain * (0.2126 * tint[0] + 0.7152 * tint[1] + 0.0722 * tint[2])};
    return look;
}

}  // namespace ghostlight
