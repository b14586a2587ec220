#include "core/fit/fit_scene.h"

#include <cmath>
#include <numbers>

#include "core/flare/flare_scene.h"

namespace ghostlight {
namespace {

/// Chebyshev nodes over the visible range, each with the colour of what a polynomial through the
/// nodes takes of it: ∫ power × colour × Lagrange's polynomial. Exact for weights that are
/// polynomials of the wavelength, so that a dozen nodes do for films; midpoints need thirty.
void set_samples(const Spectrum& spectrum, int count, FitScene& scene) {
    if (std::holds_alternative<Monochromatic>(spectrum)) {
        scene.samples = sample(spectrum, 1);
        scene.colors = sample_colors(spectrum, scene.samples);
        return;
    }
    constexpr double low_nm = 400.0, high_nm = 700.0;
    constexpr int fine = 600;
    for (int k = 0; k < count; ++k) {
        const double at = std::cos(std::numbers::pi * (2 * k + 1) / (2.0 * count));
        scene.samples.push_back({0.5 * (low_nm + high_nm) - 0.5 * (high_nm - low_nm) * at, 0.0});
    }
    scene.colors.resize(scene.samples.size());
    double power = 0.0;
    Rgb white;
    for (int i = 0; i < fine; ++i) {
        const double nm = low_nm + (high_nm - low_nm) * (i + 0.5) / fine;
        const double p = relative_power(spectrum, nm);
        const Xyz xyz = color_matching(nm);
        const Rgb rgb = linear_rec709({p * xyz.x, p * xyz.y, p * xyz.z});
        power += p;
        white = {white.r + rgb.r, white.g + rgb.g, white.b + rgb.b};
        for (std::size_t k = 0; k < scene.samples.size(); ++k) {
            const double own_nm = scene.samples[k].wavelength_nm;
            double share = 1.0;
            for (std::size_t other = 0; other < scene.samples.size(); ++other)
                if (other != k)
                    share *= (nm - scene.samples[other].wavelength_nm) /
                             (own_nm - scene.samples[other].wavelength_nm);
            scene.samples[k].weight += share * p;
            Rgb& color = scene.colors[k];
            color = {color.r + share * rgb.r, color.g + share * rgb.g, color.b + share * rgb.b};
        }
    }
    for (std::size_t k = 0; k < scene.samples.size(); ++k) {
        scene.samples[k].weight /= power;
        Rgb& color = scene.colors[k];
        color = {color.r / white.r, color.g / white.g, color.b / white.b};
    }
}

}  // namespace

FitScene fit_scene(const FittedLens& lens, const Spectrum& spectrum, int spectral_samples) {
    FitScene scene;
    scene.lens = lens;
    set_samples(spectrum, spectral_samples, scene);
    for (const double nm : geometry_wavelengths_nm(scene.samples))
        scene.geometry.push_back(compile(lens.lens, nm));
    scene.main = scene.geometry.size() / 2;
    for (const SpectralSample& each : scene.samples)
        scene.nodes.push_back(node_shares(scene.geometry, each.wavelength_nm));
    scene.ghosts = two_reflection_ghosts(scene.system());
    return scene;
}

}  // namespace ghostlight
