#include "core/flare/false_color.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {

std::array<float, 3> false_color(float place) {
    const float at = std::clamp(place, 0.0F, 1.0F) * static_cast<float>(false_color_steps - 1);
    const auto k = std::min(static_cast<std::size_t>(at), false_color_steps - 2);
    const float share = at - static_cast<float>(k);
    std::array<float, 3> color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = std::lerp(false_colors[k][c], false_colors[k + 1][c], share);
    return color;
}

float log_place(float value, float low_decade, float high_decade) {
    if (!(value > 0.0F)) return 0.0F;
    return std::clamp((std::log10(value) - low_decade) / (high_decade - low_decade), 0.0F, 1.0F);
}

}  // namespace ghostlight
