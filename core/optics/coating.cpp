#include "core/optics/coating.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/optics/trace_path.h"
#include "core/units.h"

namespace ghostlight {
namespace {

FilmLayer layer_at(double n, double k, double thickness_nm) {
    if (!(n > 0.0) || !(k >= 0.0) || !(thickness_nm >= 0.0) || !std::isfinite(n + k + thickness_nm))
        throw Error({.problem = "a layer is not physical",
                     .file = {},
                     .where = {},
                     .found = fmt::format("n {}, k {}, thickness {} nm", n, k, thickness_nm),
                     .expected = "n > 0, k ≥ 0, thickness ≥ 0"});
    return {n, k, thickness_nm};
}

struct LayersAt {
    const Medium& before;
    const Medium& after;
    double nm;

    std::vector<FilmLayer> operator()(const Uncoated&) const { return {}; }

    std::vector<FilmLayer> operator()(const QuarterWave& film) const {
        if (!(film.center_nm > 0.0))
            throw Error({.problem = "a quarter-wave coating needs a centre wavelength",
                         .file = {},
                         .where = {},
                         .found = fmt::format("{} nm", film.center_nm),
                         .expected = "a positive number of nm, for example 550"});
        auto index = [&](double wavelength_nm) {
            if (const auto* medium = std::get_if<Medium>(&film.layer))
                return refractive_index(*medium, wavelength_nm);
            return std::sqrt(refractive_index(before, wavelength_nm) *
                             refractive_index(after, wavelength_nm));
        };
        const double thickness =
            film.thickness_factor * film.center_nm / (4.0 * index(film.center_nm));
        return {layer_at(index(nm), 0.0, thickness)};
    }

    std::vector<FilmLayer> operator()(const LayerStack& stack) const {
        std::vector<FilmLayer> layers;
        for (const Layer& layer : stack.layers) {
            const double k = layer.extinction_table.empty() ? layer.extinction
                                                            : linear_at(layer.extinction_table, nm);
            layers.push_back(layer_at(refractive_index(layer.medium, nm), k, layer.thickness_nm));
        }
        if (stack.from_air && !is_air(before) && is_air(after)) std::ranges::reverse(layers);
        return layers;
    }

    std::vector<FilmLayer> operator()(const MeasuredReflectance&) const { return {}; }
    std::vector<FilmLayer> operator()(const ConstantReflectance&) const { return {}; }
};

MeasuredShares checked(const MeasuredShares& shares) {
    // Energy to within what tables are printed with.
    constexpr double most = 1.0 + 1e-6;
    const bool in_range = shares.r_s >= 0.0 && shares.r_p >= 0.0 && shares.t_s >= 0.0 &&
                          shares.t_p >= 0.0 && shares.r_s + shares.t_s <= most &&
                          shares.r_p + shares.t_p <= most;
    if (!in_range)
        throw Error({.problem = "a reflectance is not physical",
                     .file = {},
                     .where = {},
                     .found = fmt::format("R {}, {}, T {}, {} (s, p)", shares.r_s, shares.r_p,
                                          shares.t_s, shares.t_p),
                     .expected = "R ≥ 0, T ≥ 0, R + T ≤ 1"});
    return shares;
}

struct AnglesAt {
    double nm;

    template <class LayeredCoating>
    std::vector<FilmAngle> operator()(const LayeredCoating&) const {
        return {};
    }

    std::vector<FilmAngle> operator()(const ConstantReflectance& fixed) const {
        return {{1.0, checked({fixed.reflectance, fixed.reflectance, fixed.transmittance,
                               fixed.transmittance})}};
    }

    std::vector<FilmAngle> operator()(const MeasuredReflectance& table) const {
        const auto& waves = table.wavelengths_nm;
        const std::size_t count = table.angles_deg.size();
        if (waves.empty() || count == 0 || table.shares.size() != waves.size() * count)
            throw Error({.problem = "a measured coating's table is not complete",
                         .file = {},
                         .where = {},
                         .found = fmt::format("{} values for {} wavelengths and {} angles",
                                              table.shares.size(), waves.size(), count),
                         .expected = "a value for every wavelength and angle"});
        const auto after =
            static_cast<std::size_t>(std::ranges::upper_bound(waves, nm) - waves.begin());
        const std::size_t last = waves.size() - 1;
        const std::size_t low = after == 0 ? 0 : after - 1, high = std::min(after, last);
        const double share = low == high ? 0.0 : (nm - waves[low]) / (waves[high] - waves[low]);
        std::vector<FilmAngle> angles;
        for (std::size_t i = 0; i < count; ++i) {
            const MeasuredShares a = checked(table.shares[low * count + i]);
            const MeasuredShares b = checked(table.shares[high * count + i]);
            auto between = [&](double x, double y) { return x + share * (y - x); };
            angles.push_back({cos_from_deg(table.angles_deg[i]),
                              {between(a.r_s, b.r_s), between(a.r_p, b.r_p), between(a.t_s, b.t_s),
                               between(a.t_p, b.t_p)}});
        }
        return angles;
    }
};

Film simplified(Film film) {
    std::erase_if(film.layers, [](const FilmLayer& layer) { return layer.thickness_nm == 0.0; });
    std::vector<FilmLayer> merged;
    for (const FilmLayer& layer : film.layers) {
        const bool as_previous =
            !merged.empty() && merged.back().n == layer.n && merged.back().k == layer.k;
        if (as_previous)
            merged.back().thickness_nm += layer.thickness_nm;
        else
            merged.push_back(layer);
    }
    auto is_medium = [](const FilmLayer& layer, double n) {
        return layer.n == n && layer.k == 0.0;
    };
    if (!merged.empty() && is_medium(merged.front(), film.n_in)) merged.erase(merged.begin());
    if (!merged.empty() && is_medium(merged.back(), film.n_out)) merged.pop_back();
    film.layers = std::move(merged);
    return film;
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

double number(std::string_view text, std::string_view whole, const char* expected) {
    text = trimmed(text);
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        throw Error({.problem = fmt::format("stack \"{}\" cannot be read", whole),
                     .file = {},
                     .where = {},
                     .found = fmt::format("'{}'", text),
                     .expected = expected});
    return value;
}

std::string describe_medium(const Medium& medium) {
    if (!medium.name.empty()) return medium.name;
    if (const auto* constant = std::get_if<ConstantIndex>(&medium.dispersion))
        return fmt::format("{}", constant->n);
    return "layer";
}

}  // namespace

Film film_at(const Coating& coating, const Medium& before, const Medium& after,
             double wavelength_nm) {
    Film film;
    film.n_in = refractive_index(before, wavelength_nm);
    film.n_out = refractive_index(after, wavelength_nm);
    film.wavelength_nm = wavelength_nm;
    film.layers = std::visit(LayersAt{before, after, wavelength_nm}, coating);
    film.angles = std::visit(AnglesAt{wavelength_nm}, coating);
    return simplified(std::move(film));
}

Film reversed(const Film& film) {
    Film other = film;
    std::swap(other.n_in, other.n_out);
    std::ranges::reverse(other.layers);
    return other;
}

bool is_invisible(const Film& film) {
    // Shares that are given hold also where the media are equal, unless they say that all passes.
    const bool passes = std::ranges::all_of(
        film.angles, [](const FilmAngle& at) { return at.shares == MeasuredShares{}; });
    return film.layers.empty() && film.n_in == film.n_out && passes;
}

bool is_absorbing(const Film& film) {
    return std::ranges::any_of(film.layers, [](const FilmLayer& layer) { return layer.k > 0.0; }) ||
           std::ranges::any_of(film.angles, [](const FilmAngle& at) {
               return at.shares.r_s + at.shares.t_s < 1.0 || at.shares.r_p + at.shares.t_p < 1.0;
           });
}

Reflectances reflectances(const Film& film, double cos_incidence) {
    if (is_invisible(film)) return {};
    auto intensities = [](const Amplitudes<double>& amplitude) {
        return Reflectances{norm(amplitude.r_s), norm(amplitude.r_p), norm(amplitude.t_s),
                            norm(amplitude.t_p)};
    };
    if (!film.angles.empty()) {
        const auto angles = angles_at<double>(film);
        return intensities(given_amplitudes(
            film.n_in, angles.data(), static_cast<int>(angles.size()), film.n_out, cos_incidence));
    }
    std::vector<LayerAt<double>> layers;
    for (const FilmLayer& layer : film.layers)
        layers.push_back({layer.n * layer.n - layer.k * layer.k, 2.0 * layer.n * layer.k,
                          2.0 * std::numbers::pi / film.wavelength_nm * layer.thickness_nm});
    const int count = static_cast<int>(layers.size());
    return intensities(
        is_absorbing(film)
            ? film_amplitudes<true>(film.n_in, layers.data(), count, film.n_out, cos_incidence)
            : film_amplitudes<false>(film.n_in, layers.data(), count, film.n_out, cos_incidence));
}

Film parse_stack(std::string_view text, double wavelength_nm) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0;;) {
        const std::size_t bar = text.find('|', begin);
        parts.push_back(trimmed(text.substr(begin, bar == text.npos ? bar : bar - begin)));
        if (bar == text.npos) break;
        begin = bar + 1;
    }
    if (parts.size() < 2)
        throw Error(
            {.problem = fmt::format("stack \"{}\" has no exit medium", text),
             .file = {},
             .where = {},
             .found = fmt::format("{} part", parts.size()),
             .expected = "two media and the layers between, like \"1.0 | 1.38:96.4 | 1.5\""});
    Film film;
    film.wavelength_nm = wavelength_nm;
    film.n_in = number(parts.front(), text, "the incident medium's index, like 1.0");
    film.n_out = number(parts.back(), text, "the exit medium's index, like 1.5");
    layer_at(film.n_in, 0.0, 0.0);
    layer_at(film.n_out, 0.0, 0.0);
    for (std::size_t i = 1; i + 1 < parts.size(); ++i) {
        const std::string_view part = parts[i];
        const std::size_t colon = part.find(':');
        if (colon == part.npos)
            number("", part, "a layer as index:thickness in nm, like 1.38:96.4");
        const std::string_view index = part.substr(0, colon);
        const std::size_t comma = index.find(',');
        const double n = number(index.substr(0, comma), text, "a layer's index, like 1.38");
        const double k = comma == index.npos
                             ? 0.0
                             : number(index.substr(comma + 1), text, "a layer's k, like 0.01");
        film.layers.push_back(
            layer_at(n, k, number(part.substr(colon + 1), text, "a thickness in nm, like 96.4")));
    }
    return simplified(std::move(film));
}

namespace {

struct Describe {
    std::string operator()(const Uncoated&) const { return "none"; }
    std::string operator()(const QuarterWave& film) const {
        const auto* medium = std::get_if<Medium>(&film.layer);
        std::string text =
            fmt::format("{} λ/4 {}", medium ? describe_medium(*medium) : "ideal", film.center_nm);
        if (film.thickness_factor != 1.0) text += fmt::format(" × {}", film.thickness_factor);
        return text;
    }
    std::string operator()(const LayerStack& stack) const {
        if (!stack.name.empty()) return stack.name;
        const std::size_t count = stack.layers.size();
        return fmt::format("{} layer{}", count, count == 1 ? "" : "s");
    }
    std::string operator()(const MeasuredReflectance& table) const {
        return table.name.empty() ? "measured" : table.name;
    }
    std::string operator()(const ConstantReflectance& fixed) const {
        std::string text = fmt::format("R {:.4g} %", 100.0 * fixed.reflectance);
        if (fixed.transmittance != 1.0 - fixed.reflectance)
            text += fmt::format(", T {:.4g} %", 100.0 * fixed.transmittance);
        return text;
    }
};

}  // namespace

std::string describe(const Coating& coating) { return std::visit(Describe{}, coating); }

}  // namespace ghostlight
