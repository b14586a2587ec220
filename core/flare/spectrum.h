#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ghostlight {

/// Light of one wavelength.
struct Monochromatic {
    double wavelength_nm = 587.5618;
    bool operator==(const Monochromatic&) const = default;
};
/// CIE standard illuminants and the equal-energy light, 380 to 780 nm.
enum class Illuminant { e, d65, a };
struct StandardLight {
    Illuminant illuminant = Illuminant::d65;
    bool operator==(const StandardLight&) const = default;
};
struct Blackbody {
    double temperature_k = 5500.0;
    bool operator==(const Blackbody&) const = default;
};
using Spectrum = std::variant<Monochromatic, StandardLight, Blackbody>;

/// "587.5618 nm", "D65", "A", "E", "5500 K".
std::string name(const Spectrum& spectrum);
/// Reads those names. Throws Error listing them.
Spectrum parse_spectrum(std::string_view text);

/// Spectral power relative to its own maximum-free scale (arbitrary unit), at a wavelength.
double relative_power(const Spectrum& spectrum, double wavelength_nm);

struct SpectralSample {
    double wavelength_nm = 587.5618;
    double weight = 1.0;  ///< share of the light's power; all weights sum to 1
};
/// Nodes for an integral over the spectrum: one for a single wavelength, else `count` equal bands'
/// midpoints over 400–700 nm.
std::vector<SpectralSample> sample(const Spectrum& spectrum, int count);

/// Clenshaw–Curtis nodes over 400–700 nm with weights that integrate the light's own power times
/// a polynomial of degree `count` − 1 exactly, so that only what the lens does with the light has
/// to be smooth. The nodes of 2n − 1 contain those of n: count = 5, 9, 17, … refine one another.
/// Weights sum to 1. One node for a single wavelength.
std::vector<SpectralSample> nested_samples(const Spectrum& spectrum, int count);

struct Rgb {
    double r = 0.0, g = 0.0, b = 0.0;
};
/// CIE 1931 2° colour-matching functions (CIE 15), linear in the 5 nm table; 0 outside 380–780 nm.
struct Xyz {
    double x = 0.0, y = 0.0, z = 0.0;
};
Xyz color_matching(double wavelength_nm);
Rgb linear_rec709(const Xyz& xyz);

/// What becomes of the light's colour when a share of it passes: the share is known at the
/// spectrum's nested nodes and interpolated as their rule does, then integrated with the light's
/// power and the colour-matching functions over 400–700 nm.
struct PassedColor {
    double x = 0.0, y = 0.0;  ///< CIE 1931 chromaticity of the light that passed
    Rgb balanced;             ///< linear Rec.709, the light itself being (1, 1, 1)
};
/// `shares` belong to nested_samples(spectrum, shares.size()). Throws Error for a single
/// wavelength, which has no such colour.
PassedColor passed_color(const Spectrum& spectrum, const std::vector<double>& shares);

/// Linear Rec.709 colour of each sample, scaled so that the light itself, the sum over samples of
/// weight × colour, is (1, 1, 1) for a light inside the gamut. A single wavelength is shown
/// neutral.
std::vector<Rgb> sample_colors(const Spectrum& spectrum,
                               const std::vector<SpectralSample>& samples);

}  // namespace ghostlight
