#include "render/auto_exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ghostlight {

namespace {
constexpr std::size_t most_samples = 100'000;  // more do not move a percentile
constexpr double display_white = 0.8;          // where the tone map's shoulder begins
constexpr double middle_grey = 0.18;
constexpr double steps_per_ev = 3.0;
constexpr double most_ev = 60.0;

/// The largest value when the given share of the largest is left out.
double brightest_but(std::vector<float>& values, double share) {
    const auto above = static_cast<std::size_t>(share * static_cast<double>(values.size()));
    const auto nth =
        values.end() - 1 - static_cast<std::ptrdiff_t>(std::min(above, values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return static_cast<double>(*nth);
}
}  // namespace

double auto_exposure_ev(const FlareImage& image, double share) {
    const std::size_t pixels = image.rgb.size() / 3;
    const std::size_t step = std::max<std::size_t>(1, pixels / most_samples);
    std::vector<float> lit;
    for (std::size_t i = 0; i < pixels; i += step) {
        const float* rgb = &image.rgb[3 * i];
        const float brightest = std::max({rgb[0], rgb[1], rgb[2]});
        if (brightest > 0.0F && std::isfinite(brightest)) {
            lit.push_back(brightest);
        }
    }
    if (lit.empty()) {
        return 0.0;
    }
    const double white_ev = std::log2(display_white / brightest_but(lit, share));
    const double grey_ev = std::log2(middle_grey / brightest_but(lit, 0.5));
    const double ev = std::min(white_ev, grey_ev);
    return std::clamp(std::floor(ev * steps_per_ev) / steps_per_ev, -most_ev, most_ev);
}

}  // namespace ghostlight
