#include "app/cli/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ghostlight::cli {

double automatic_exposure_ev(const FlareImage& image) {
    std::vector<float> levels;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) {
        const float level = std::max({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
        if (level > 0.0F) levels.push_back(level);
    }
    if (levels.empty()) return 0.0;
    const auto place =
        levels.begin() + static_cast<std::ptrdiff_t>(levels.size() - 1 - levels.size() / 1000);
    std::nth_element(levels.begin(), place, levels.end());
    return -std::log2(static_cast<double>(*place));
}

}  // namespace ghostlight::cli
