#include "core/flare/flare_scene.h"

#include <algorithm>
#include <cmath>

#include "core/flare/color_raster.h"
#include "core/flare/colored_samples.h"
#include "core/flare/grid_light.h"
#include "core/flare/propagated_masks.h"

namespace ghostlight {
namespace {

constexpr double shortest_nm = 400.0, longest_nm = 700.0;
/// Of half the range in 1/λ², from its middle, for how far the light's mean may take the third.
constexpr double most_inner = 0.5;

double inverse_square(double nm) { return 1.0 / (nm * nm); }

std::vector<OpticalSystem> compiled(const Prescription& lens,
                                    const std::vector<double>& wavelengths_nm) {
    std::vector<OpticalSystem> systems;
    for (const double nm : wavelengths_nm) systems.push_back(compile(lens, nm));
    return systems;
}

}  // namespace

std::vector<double> geometry_wavelengths_nm(const std::vector<SpectralSample>& samples) {
    if (samples.size() == 1) return {samples.front().wavelength_nm};
    const double low = inverse_square(longest_nm), high = inverse_square(shortest_nm);
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    double mean = 0.0;
    for (const SpectralSample& s : samples) mean += s.weight * inverse_square(s.wavelength_nm);
    mean = std::clamp(mean, middle - most_inner * half, middle + most_inner * half);
    const double inner_nm = std::ranges::min_element(samples, {}, [&](const SpectralSample& s) {
                                return std::abs(inverse_square(s.wavelength_nm) - mean);
                            })->wavelength_nm;
    return {1.0 / std::sqrt(middle + half * outer_geometry_node), inner_nm,
            1.0 / std::sqrt(middle - half * outer_geometry_node)};
}

std::vector<double> node_shares(const std::vector<OpticalSystem>& geometry, double wavelength_nm) {
    std::vector<double> shares(geometry.size(), 1.0);
    const double at = inverse_square(wavelength_nm);
    for (std::size_t i = 0; i < geometry.size(); ++i)
        for (std::size_t k = 0; k < geometry.size(); ++k)
            if (k != i) {
                const double other = inverse_square(geometry[k].wavelength_nm);
                shares[i] *= (at - other) / (inverse_square(geometry[i].wavelength_nm) - other);
            }
    return shares;
}

std::vector<double> FlareScene::interpolation(double wavelength_nm) const {
    return node_shares(geometry, wavelength_nm);
}

FlareScene flare_scene(const Prescription& lens, const Spectrum& spectrum, int spectral_samples,
                       unsigned threads, CoatingModel model) {
    const auto [samples, colors] = colored_samples(spectrum, spectral_samples);
    std::vector<double> weight_nm;
    for (const SpectralSample& s : samples) weight_nm.push_back(s.wavelength_nm);
    const std::optional<double> line = line_nm(spectrum);
    std::vector<OpticalSystem> geometry =
        compiled(lens, line ? std::vector<double>{*line} : geometry_wavelengths_nm(samples));
    const std::size_t main = geometry.size() / 2;
    std::vector<double> band_nm;
    if (geometry.size() > 1) {
        const ColorAxis axis(samples);
        constexpr int halves = 2 * FlareScene::most_own_bands;
        for (int k = 1; k < halves; ++k)
            band_nm.push_back(axis.wavelength_nm(static_cast<double>(k) / halves));
    }
    std::vector<GhostPath> ghosts = two_reflection_ghosts(geometry[main]);
    FilmTables films(compiled(lens, weight_nm), threads, model, &geometry[main]);
    return {.spectrum = spectrum,
            .samples = samples,
            .colors = colors,
            .geometry = std::move(geometry),
            .main = main,
            .band_systems = compiled(lens, band_nm),
            .coating_model = model,
            .films = std::move(films),
            .ghosts = std::move(ghosts),
            .dirt = lens.stop.dirt,
            .propagated_masks = std::make_shared<PropagatedMasks>()};
}

template <int C>
std::vector<float> channel_shares(const FlareScene& scene, int band, int bands) {
    const ColorAxis axis(scene.samples);
    std::vector<float> shares;
    for (std::size_t w = 0; w < scene.samples.size(); ++w) {
        const SpectralSample& s = scene.samples[w];
        const double weight = s.weight * band_weight(axis.at(s.wavelength_nm), band, bands);
        const double color[4] = {scene.colors[w].r, scene.colors[w].g, scene.colors[w].b, 1.0};
        for (int c = 0; c < C; ++c)
            shares.push_back(static_cast<float>(weight * color[C == gray_channels ? 3 : c]));
    }
    return shares;
}
template std::vector<float> channel_shares<gray_channels>(const FlareScene&, int, int);
template std::vector<float> channel_shares<color_channels>(const FlareScene&, int, int);

}  // namespace ghostlight
