#include "core/flare/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/flare/cie_tables.h"

namespace ghostlight {
namespace {

/// Second radiation constant, nm K (CODATA 2018, exact).
constexpr double c2_nm_k = 1.438776877e7;
/// CIE standard illuminant A is Planck's law as it was in 1931: c2 = 1.435e7 nm K, 2848 K.
constexpr double illuminant_a_nm = 1.435e7 / 2848.0;
constexpr double reference_nm = 560.0;

constexpr double coolest_k = 500.0, hottest_k = 1e6;
constexpr double shortest_nm = 100.0, longest_nm = 1e5;
constexpr double band_first_nm = 400.0, band_last_nm = 700.0;
constexpr std::array<SpectralSample, 2> sodium_lines = {
    {{588.9950, 2.0 / 3.0}, {589.5924, 1.0 / 3.0}}};
/// How finely the power of a table is summed.
constexpr double table_step_nm = 0.5;

/// Planck's law in a wavelength, over its value at 560 nm; `scale_nm` is c2 / T. Written with
/// falling exponentials so that a cold source does not overflow.
double planck(double scale_nm, double wavelength_nm) {
    const double x = scale_nm / wavelength_nm;
    const double reference = scale_nm / reference_nm;
    return std::pow(reference_nm / wavelength_nm, 5) * std::exp(reference - x) *
           std::expm1(-reference) / std::expm1(-x);
}

/// Where a wavelength is in a table: the entry before it, and how far it is to the next.
struct Place {
    std::size_t index;
    double share;
};
Place place(double wavelength_nm, double step_nm, std::size_t entries) {
    const double steps = (wavelength_nm - cie::first_nm) / step_nm;
    const auto index = std::min(static_cast<std::size_t>(steps), entries - 2);
    return {index, steps - static_cast<double>(index)};
}

bool is_tabulated(double wavelength_nm) {
    return wavelength_nm >= cie::first_nm && wavelength_nm <= cie::last_nm;
}

struct PowerAt {
    double nm;

    double operator()(const Monochromatic& light) const {
        return nm == light.wavelength_nm ? 1.0 : 0.0;
    }
    double operator()(const Blackbody& light) const {
        return planck(c2_nm_k / light.temperature_k, nm);
    }
    double operator()(const StandardLight& light) const {
        if (!is_tabulated(nm)) return 0.0;
        switch (light.illuminant) {
            case Illuminant::e:
                return 1.0;
            case Illuminant::a:
                return planck(illuminant_a_nm, nm);
            case Illuminant::led_b3: {
                const Place at = place(nm, cie::observer_step_nm, cie::led_b3.size());
                return std::lerp(cie::led_b3[at.index], cie::led_b3[at.index + 1], at.share);
            }
            case Illuminant::d65:
                break;
        }
        const Place at = place(nm, cie::d65_step_nm, cie::d65.size());
        return std::lerp(cie::d65[at.index], cie::d65[at.index + 1], at.share) / 100.0;
    }
    double operator()(const SodiumLight&) const {
        for (const SpectralSample& line : sodium_lines)
            if (nm == line.wavelength_nm) return line.weight;
        return 0.0;
    }
    double operator()(const TabulatedLight& light) const {
        const bool inside =
            nm >= light.power.front().wavelength_nm && nm <= light.power.back().wavelength_nm;
        return inside ? linear_at(light.power, nm) : 0.0;
    }
};

struct NameOf {
    std::string operator()(const Monochromatic& light) const {
        return fmt::format("{} nm", light.wavelength_nm);
    }
    std::string operator()(const Blackbody& light) const {
        return fmt::format("{} K", light.temperature_k);
    }
    std::string operator()(const StandardLight& light) const {
        switch (light.illuminant) {
            case Illuminant::e:
                return "E";
            case Illuminant::a:
                return "A";
            case Illuminant::led_b3:
                return "LED-B3";
            case Illuminant::d65:
                break;
        }
        return "D65";
    }
    std::string operator()(const SodiumLight&) const { return "sodium"; }
    std::string operator()(const TabulatedLight& light) const { return light.name; }
};

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

[[noreturn]] void refuse(std::string_view text) {
    throw Error({.problem = "not a known light",
                 .file = {},
                 .where = "spectrum",
                 .found = fmt::format("'{}'", text),
                 .expected = "D65, A, E, LED-B3, sodium, a temperature such as '5500 K' (500 to "
                             "1000000), or a wavelength such as '550 nm'"});
}

double luminance(const Rgb& rgb) { return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b; }

/// What a light's colour is divided by to make it neutral. A channel that is negative, or next to
/// nothing, cannot be balanced: then only the luminance.
Rgb balance_of(const Rgb& light) {
    constexpr double least_share = 1e-3;
    const double y = luminance(light);
    if (std::min({light.r, light.g, light.b}) < least_share * y) return {y, y, y};
    return light;
}

std::vector<SpectralSample> lines_of(const Spectrum& spectrum) {
    if (const auto* single = std::get_if<Monochromatic>(&spectrum))
        return {{single->wavelength_nm, 1.0}};
    if (std::holds_alternative<SodiumLight>(spectrum))
        return {sodium_lines.begin(), sodium_lines.end()};
    return {};
}

/// Power over a band: of smooth lights at its middle.
double mean_power(const Spectrum& spectrum, double middle_nm, double width_nm) {
    if (!std::holds_alternative<TabulatedLight>(spectrum))
        return relative_power(spectrum, middle_nm);
    const int steps = std::max(1, static_cast<int>(std::ceil(width_nm / table_step_nm)));
    double sum = 0.0;
    for (int k = 0; k < steps; ++k)
        sum += relative_power(spectrum, middle_nm + width_nm * ((k + 0.5) / steps - 0.5));
    return sum / steps;
}

/// Linear Rec.709 of the light itself, of the power that its samples share.
Rgb own_color(const Spectrum& spectrum) {
    constexpr int count = 300;
    Rgb color;
    for (const SpectralSample& s : sample(spectrum, count)) {
        const Rgb at = linear_rec709(color_matching(s.wavelength_nm));
        color.r += s.weight * at.r;
        color.g += s.weight * at.g;
        color.b += s.weight * at.b;
    }
    return color;
}

/// Calls visit(nm, shares) every 0.5 nm of the band with the Lagrange polynomials of the nested
/// nodes there, in barycentric form.
template <class Visit>
void for_each_wavelength(const std::vector<SpectralSample>& nodes, Visit visit) {
    constexpr double step_nm = 0.5;
    std::vector<double> shares(nodes.size());
    for (double nm = band_first_nm + 0.5 * step_nm; nm < band_last_nm; nm += step_nm) {
        double sum = 0.0;
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const double distance = nm - nodes[k].wavelength_nm;
            if (distance == 0.0) {
                std::ranges::fill(shares, 0.0);
                shares[k] = sum = 1.0;
                break;
            }
            const bool end = k == 0 || k + 1 == nodes.size();
            shares[k] = (k % 2 == 0 ? 1.0 : -1.0) * (end ? 0.5 : 1.0) / distance;
            sum += shares[k];
        }
        for (double& share : shares) share /= sum;
        visit(nm, shares);
    }
}

}  // namespace

TabulatedLight tabulated_light(std::string name, SpectralTable power) {
    const auto refuse_entry = [&](std::size_t k, std::string problem, std::string found,
                                  std::string expected) {
        throw Error({.problem = std::move(problem),
                     .file = {},
                     .where = fmt::format("entry {}", k + 1),
                     .found = std::move(found),
                     .expected = std::move(expected)});
    };
    if (power.size() < 2)
        throw Error({.problem = "a spectrum's table is too short",
                     .file = {},
                     .where = {},
                     .found = fmt::format("{} entries", power.size()),
                     .expected = "two or more"});
    for (std::size_t k = 0; k < power.size(); ++k) {
        const auto [nm, value] = power[k];
        if (!(nm > 0.0) || !std::isfinite(nm))
            refuse_entry(k, "not a wavelength", fmt::format("{}", nm), "nm, above 0");
        if (k > 0 && !(nm > power[k - 1].wavelength_nm))
            refuse_entry(k, "wavelengths do not rise",
                         fmt::format("{} nm after {} nm", nm, power[k - 1].wavelength_nm),
                         "each above the one before");
        if (!(value >= 0.0) || !std::isfinite(value))
            refuse_entry(k, "not a spectral power", fmt::format("{}", value), "0 or more");
    }
    TabulatedLight light{std::move(name), std::move(power)};
    const bool is_dark =
        std::ranges::all_of(light.power, [](const auto& entry) { return entry.value == 0.0; });
    const Spectrum spectrum = light;
    if (!(mean_power(spectrum, 0.5 * (band_first_nm + band_last_nm), band_last_nm - band_first_nm) >
          0.0))
        throw Error(
            {.problem = "a spectrum without power where pictures are made",
             .file = {},
             .where = {},
             .found = is_dark
                          ? std::string("no power at any wavelength")
                          : fmt::format("power from {} to {} nm", light.power.front().wavelength_nm,
                                        light.power.back().wavelength_nm),
             .expected = fmt::format("some between {} and {} nm", band_first_nm, band_last_nm)});
    return light;
}

bool is_of_lines(const Spectrum& spectrum) { return !lines_of(spectrum).empty(); }

std::optional<double> line_nm(const Spectrum& spectrum) {
    const auto lines = lines_of(spectrum);
    if (lines.empty()) return std::nullopt;
    double mean = 0.0;
    for (const SpectralSample& line : lines) mean += line.weight * line.wavelength_nm;
    return mean;
}

std::string name(const Spectrum& spectrum) { return std::visit(NameOf{}, spectrum); }

Spectrum parse_spectrum(std::string_view text) {
    const std::string_view whole = trimmed(text);
    std::string lower(whole);
    std::ranges::transform(lower, lower.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (lower == "d65") return StandardLight{Illuminant::d65};
    if (lower == "a") return StandardLight{Illuminant::a};
    if (lower == "e") return StandardLight{Illuminant::e};
    if (lower == "led-b3" || lower == "led") return StandardLight{Illuminant::led_b3};
    if (lower == "sodium") return SodiumLight{};

    double value = 0.0;
    const auto [end, status] = std::from_chars(lower.data(), lower.data() + lower.size(), value);
    if (status != std::errc{}) refuse(text);
    const std::string_view unit =
        trimmed({end, static_cast<std::size_t>(lower.data() + lower.size() - end)});
    if (unit == "k" && value >= coolest_k && value <= hottest_k) return Blackbody{value};
    if (unit == "nm" && value >= shortest_nm && value <= longest_nm) return Monochromatic{value};
    refuse(text);
}

double relative_power(const Spectrum& spectrum, double wavelength_nm) {
    return std::visit(PowerAt{wavelength_nm}, spectrum);
}

std::vector<SpectralSample> nested_samples(const Spectrum& spectrum, int count) {
    if (const auto lines = lines_of(spectrum); !lines.empty()) return lines;
    const int last = count - 1;
    const double middle = 0.5 * (band_first_nm + band_last_nm);
    const double half = 0.5 * (band_last_nm - band_first_nm);
    std::vector<SpectralSample> samples;
    for (int k = 0; k < count; ++k) {
        // sin of the angle from the middle: the same digits for every count.
        const double node = std::sin(std::numbers::pi * (2 * k - last) / (2.0 * last));
        samples.push_back({middle + half * std::round(node * 1e12) / 1e12, 0.0});
    }
    for_each_wavelength(samples, [&](double nm, const std::vector<double>& shares) {
        const double power = relative_power(spectrum, nm);
        for (std::size_t k = 0; k < samples.size(); ++k) samples[k].weight += power * shares[k];
    });
    double total = 0.0;
    for (const SpectralSample& s : samples) total += s.weight;
    for (SpectralSample& s : samples) s.weight /= total;
    return samples;
}

std::vector<SpectralSample> sample(const Spectrum& spectrum, int count) {
    if (const auto lines = lines_of(spectrum); !lines.empty()) return lines;
    if (count < 1)
        throw Error({.problem = "a spectrum needs at least one sample",
                     .file = {},
                     .where = {},
                     .found = fmt::format("{}", count),
                     .expected = "1 or more"});
    std::vector<SpectralSample> samples;
    double sum = 0.0;
    const double width_nm = (band_last_nm - band_first_nm) / count;
    for (int i = 0; i < count; ++i) {
        const double nm = band_first_nm + (i + 0.5) * width_nm;
        samples.push_back({nm, mean_power(spectrum, nm, width_nm)});
        sum += samples.back().weight;
    }
    for (SpectralSample& each : samples) each.weight /= sum;
    return samples;
}

Xyz color_matching(double wavelength_nm) {
    if (!is_tabulated(wavelength_nm)) return {};
    const Place at = place(wavelength_nm, cie::observer_step_nm, cie::observer.size());
    const auto& before = cie::observer[at.index];
    const auto& after = cie::observer[at.index + 1];
    return {std::lerp(before[0], after[0], at.share), std::lerp(before[1], after[1], at.share),
            std::lerp(before[2], after[2], at.share)};
}

Rgb linear_rec709(const Xyz& xyz) {
    // IEC 61966-2-1: the primaries of Rec. 709 with D65.
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

PassedColor passed_color(const Spectrum& spectrum, const std::vector<double>& shares) {
    if (is_of_lines(spectrum))
        throw Error("light of one wavelength has no colour that a lens could change");
    const auto nodes = nested_samples(spectrum, static_cast<int>(shares.size()));
    Xyz passed, light;
    for_each_wavelength(nodes, [&](double nm, const std::vector<double>& part) {
        const double power = relative_power(spectrum, nm);
        const Xyz seen = color_matching(nm);
        double share = 0.0;
        for (std::size_t k = 0; k < shares.size(); ++k) share += part[k] * shares[k];
        light.x += power * seen.x;
        light.y += power * seen.y;
        light.z += power * seen.z;
        passed.x += power * share * seen.x;
        passed.y += power * share * seen.y;
        passed.z += power * share * seen.z;
    });
    PassedColor color;
    const double sum = passed.x + passed.y + passed.z;
    if (sum > 0.0) {
        color.x = passed.x / sum;
        color.y = passed.y / sum;
    }
    const Rgb white = balance_of(linear_rec709(light));
    const Rgb rgb = linear_rec709(passed);
    color.balanced = {rgb.r / white.r, rgb.g / white.g, rgb.b / white.b};
    return color;
}

std::vector<Rgb> sample_colors(const Spectrum& spectrum,
                               const std::vector<SpectralSample>& samples) {
    std::vector<Rgb> colors(samples.size(), Rgb{1.0, 1.0, 1.0});
    if (std::holds_alternative<Monochromatic>(spectrum) || samples.size() < 2) return colors;
    Rgb white;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        colors[i] = linear_rec709(color_matching(samples[i].wavelength_nm));
        white.r += samples[i].weight * colors[i].r;
        white.g += samples[i].weight * colors[i].g;
        white.b += samples[i].weight * colors[i].b;
    }
    white = balance_of(white);
    for (Rgb& color : colors) color = {color.r / white.r, color.g / white.g, color.b / white.b};
    return colors;
}

Rgb balanced_for(const Spectrum& white, const Spectrum& light) {
    if (white == light) return {1.0, 1.0, 1.0};
    // What each light's own colours are divided by, at a luminance of 1. A single wavelength's are
    // neutral, hence multiplied by its true colour.
    const auto divisor = [](const Spectrum& of) {
        const Rgb own = own_color(of);
        const double y = luminance(own);
        const Rgb balance = balance_of(own);
        return Rgb{balance.r / y, balance.g / y, balance.b / y};
    };
    Rgb own = divisor(light);
    if (std::holds_alternative<Monochromatic>(light)) {
        const Rgb color = own_color(light);
        const double y = luminance(color);
        // Beyond what eyes see there is nothing to balance.
        own = y > 0.0 ? Rgb{color.r / y, color.g / y, color.b / y} : Rgb{1.0, 1.0, 1.0};
    }
    const Rgb to =
        std::holds_alternative<Monochromatic>(white) ? Rgb{1.0, 1.0, 1.0} : divisor(white);
    return {own.r / to.r, own.g / to.g, own.b / to.b};
}

}  // namespace ghostlight
