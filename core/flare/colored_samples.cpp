#include "core/flare/colored_samples.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ghostlight {
namespace {

/// How finely the light itself is summed: 0.5 nm.
constexpr int dense_count = 600;
constexpr int cubic_nodes = 4;

}  // namespace

ColoredSamples colored_samples(const Spectrum& spectrum, int count) {
    ColoredSamples result;
    result.samples = sample(spectrum, count);
    result.colors = sample_colors(spectrum, result.samples);
    if (is_of_lines(spectrum) || count < cubic_nodes) return result;
    const double first_nm = result.samples.front().wavelength_nm;
    const double step_nm = (result.samples.back().wavelength_nm - first_nm) / (count - 1);
    for (SpectralSample& s : result.samples) s.weight = 0.0;
    std::ranges::fill(result.colors, Rgb{});
    const std::vector<SpectralSample> dense = sample(spectrum, dense_count);
    const std::vector<Rgb> light = sample_colors(spectrum, dense);
    for (std::size_t d = 0; d < dense.size(); ++d) {
        const double at = (dense[d].wavelength_nm - first_nm) / step_nm;
        const int from = std::clamp(static_cast<int>(std::floor(at)) - 1, 0, count - cubic_nodes);
        const double t = at - from;
        const std::array<double, cubic_nodes> shares = {
            (t - 1.0) * (t - 2.0) * (t - 3.0) / -6.0, t * (t - 2.0) * (t - 3.0) / 2.0,
            t * (t - 1.0) * (t - 3.0) / -2.0, t * (t - 1.0) * (t - 2.0) / 6.0};
        for (int k = 0; k < cubic_nodes; ++k) {
            const auto node = static_cast<std::size_t>(from + k);
            const double weight = dense[d].weight * shares[static_cast<std::size_t>(k)];
            result.samples[node].weight += weight;
            result.colors[node].r += weight * light[d].r;
            result.colors[node].g += weight * light[d].g;
            result.colors[node].b += weight * light[d].b;
        }
    }
    // A node without power has none of its colours, which stand for that power.
    for (std::size_t k = 0; k < result.colors.size(); ++k) {
        const double weight = result.samples[k].weight;
        const double inverse = weight != 0.0 ? 1.0 / weight : 0.0;
        Rgb& color = result.colors[k];
        color = {color.r * inverse, color.g * inverse, color.b * inverse};
    }
    return result;
}

}  // namespace ghostlight
