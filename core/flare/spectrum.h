#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/optics/spectral_table.h"

namespace ghostlight {

/// Light of one wavelength.
struct Monochromatic {
    double wavelength_nm = 587.5618;
    bool operator==(const Monochromatic&) const = default;
};
/// CIE illuminants and the equal-energy light, 380 to 780 nm. LED-B3 is a blue-pumped phosphor LED
/// of 4103 K.
enum class Illuminant { e, d65, a, led_b3 };
struct StandardLight {
    Illuminant illuminant = Illuminant::d65;
    bool operator==(const StandardLight&) const = default;
};
struct Blackbody {
    double temperature_k = 5500.0;
    bool operator==(const Blackbody&) const = default;
};
/// The sodium D lines, 588.995 and 589.592 nm in standard air, two to one in power (NIST Atomic
/// Spectra Database; the ratio of an optically thin lamp).
struct SodiumLight {
    bool operator==(const SodiumLight&) const = default;
};
/// Somebody's measurement: linear between its wavelengths, nothing beyond them.
struct TabulatedLight {
    std::string name;     ///< of its file
    SpectralTable power;  ///< at least two wavelengths, rising; none negative
    bool operator==(const TabulatedLight&) const = default;
};
using Spectrum = std::variant<Monochromatic, StandardLight, Blackbody, SodiumLight, TabulatedLight>;

/// Throws Error naming the entry, from 1, unless wavelengths rise, powers are finite and none is
/// negative, and there is power between 400 and 700 nm.
TabulatedLight tabulated_light(std::string name, SpectralTable power);

/// Of one or a few wavelengths alone.
bool is_of_lines(const Spectrum& spectrum);
/// Where a light of lines lies, the mean by power; nothing for others.
std::optional<double> line_nm(const Spectrum& spectrum);

/// "587.5618 nm", "D65", "A", "E", "LED-B3", "sodium", "5500 K", or a table's own name.
std::string name(const Spectrum& spectrum);
/// Reads those names but tables'. Throws Error listing them.
Spectrum parse_spectrum(std::string_view text);

/// Spectral power relative to its own maximum-free scale (arbitrary unit), at a wavelength.
double relative_power(const Spectrum& spectrum, double wavelength_nm);

struct SpectralSample {
    double wavelength_nm = 587.5618;
    double weight = 1.0;  ///< share of the light's power; all weights sum to 1
};
/// Nodes for an integral over the spectrum: a light's lines, else `count` equal bands' midpoints
/// over 400–700 nm; of tables with their mean power over the band.
std::vector<SpectralSample> sample(const Spectrum& spectrum, int count);

/// Clenshaw–Curtis nodes over 400–700 nm with weights that integrate the light's own power times
/// a polynomial of degree `count` − 1 exactly, so that only what the lens does with the light has
/// to be smooth. The nodes of 2n − 1 contain those of n: count = 5, 9, 17, … refine one another.
/// Weights sum to 1. A light of lines has these as nodes, whatever the count.
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
/// `shares` belong to nested_samples(spectrum, shares.size()). Throws Error for a light of
/// lines, which has no such colour.
PassedColor passed_color(const Spectrum& spectrum, const std::vector<double>& shares);

/// Linear Rec.709 colour of each sample, scaled so that the light itself, the sum over samples of
/// weight × colour, is (1, 1, 1) for a light inside the gamut. A single wavelength is shown
/// neutral.
std::vector<Rgb> sample_colors(const Spectrum& spectrum,
                               const std::vector<SpectralSample>& samples);

/// What multiplies the colours of one light, which are balanced for itself, to balance them for
/// another, both of the same luminance: (1, 1, 1) for a light balanced for itself.
Rgb balanced_for(const Spectrum& white, const Spectrum& light);

}  // namespace ghostlight
