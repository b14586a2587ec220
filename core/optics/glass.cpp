#include "core/optics/glass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double largest_index = 10.0;

constexpr double inverse_square(double length_um) { return 1.0 / (length_um * length_um); }

double index_squared_or_index(const FormulaGlass& glass, double um, bool& is_squared) {
    const auto& c = glass.coefficients;
    const double um2 = um * um;
    is_squared = true;
    auto powers = [&](std::size_t first) {
        double sum = 0.0;
        for (std::size_t i = first; i + 1 < c.size(); i += 2) sum += c[i] * std::pow(um, c[i + 1]);
        return sum;
    };
    double value = c.empty() ? 0.0 : c[0];
    switch (glass.formula) {
        case 1:
        case 2:
            value += 1.0;
            for (std::size_t i = 1; i + 1 < c.size(); i += 2) {
                const double pole = glass.formula == 1 ? c[i + 1] * c[i + 1] : c[i + 1];
                value += c[i] * um2 / (um2 - pole);
            }
            return value;
        case 3:
            return value + powers(1);
        case 4:
            for (std::size_t i = 1; i + 3 < c.size() && i < 9; i += 4)
                value += c[i] * std::pow(um, c[i + 1]) / (um2 - std::pow(c[i + 2], c[i + 3]));
            return value + powers(9);
        case 5:
            is_squared = false;
            return value + powers(1);
        case 6:
            is_squared = false;
            value += 1.0;
            for (std::size_t i = 1; i + 1 < c.size(); i += 2)
                value += c[i] / (c[i + 1] - inverse_square(um));
            return value;
        default:
            throw Error(
                fmt::format("dispersion formula {} is not known; expected 1 to 6", glass.formula));
    }
}

struct IndexAt {
    double nm;
    const std::string& name;

    double operator()(const ConstantIndex& glass) const { return glass.n; }

    double operator()(const ModelGlass& glass) const {
        const double d = inverse_square(um_from_nm(d_line_nm));
        const double slope =
            (glass.nd - 1.0) / (glass.vd * (inverse_square(um_from_nm(f_line_nm)) -
                                            inverse_square(um_from_nm(c_line_nm))));
        const double n = glass.nd + slope * (inverse_square(um_from_nm(nm)) - d);
        if (!(n >= 1.0) || n > largest_index)
            refuse(n, "a model glass (nd, Vd) is meant for visible light");
        return n;
    }

    double operator()(const FormulaGlass& glass) const {
        const bool below = glass.min_nm > 0.0 && nm < glass.min_nm;
        const bool above = glass.max_nm > 0.0 && nm > glass.max_nm;
        if (below || above)
            throw Error({.problem = fmt::format("glass {} has no index at {} nm", label(), nm),
                         .file = {},
                         .where = {},
                         .found = fmt::format("{} nm", nm),
                         .expected = fmt::format("a wavelength from {} to {} nm", glass.min_nm,
                                                 glass.max_nm)});
        bool is_squared = true;
        const double value = index_squared_or_index(glass, um_from_nm(nm), is_squared);
        if (!std::isfinite(value) || value <= 1.0) refuse(value, "the formula has a pole there");
        const double n = is_squared ? std::sqrt(value) : value;
        if (n > largest_index) refuse(n, "no glass has such an index");
        return n;
    }

    double operator()(const UnknownGlass& glass) const {
        throw Error({.problem = fmt::format("glass {} is not known: {}", label(), glass.why),
                     .file = {},
                     .where = {},
                     .found = {},
                     .expected = "a glass of the catalogue, a model glass (nd, Vd) or an index"});
    }

    std::string label() const { return name.empty() ? "without a name" : "'" + name + "'"; }

    [[noreturn]] void refuse(double value, const char* why) const {
        throw Error(
            {.problem = fmt::format("glass {} has no usable index at {} nm ({})", label(), nm, why),
             .file = {},
             .where = {},
             .found = fmt::format("{}", value),
             .expected = "an index from 1 to 10"});
    }
};

bool same_letters(std::string_view a, std::string_view b) {
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::toupper(x) == std::toupper(y); });
}

}  // namespace

double refractive_index(const Medium& medium, double wavelength_nm) {
    if (!(wavelength_nm > 0.0) || !std::isfinite(wavelength_nm))
        throw Error({.problem = "a wavelength must be a positive number of nm",
                     .file = {},
                     .where = {},
                     .found = fmt::format("{}", wavelength_nm),
                     .expected = "for example 587.5618"});
    return std::visit(IndexAt{wavelength_nm, medium.name}, medium.dispersion);
}

double abbe_number(const Medium& medium) {
    const double spread = refractive_index(medium, f_line_nm) - refractive_index(medium, c_line_nm);
    if (spread == 0.0) return std::numeric_limits<double>::infinity();
    return (refractive_index(medium, d_line_nm) - 1.0) / spread;
}

std::string describe(const Medium& medium) {
    if (!medium.name.empty()) return medium.name;
    if (is_air(medium)) return "air";
    if (std::holds_alternative<UnknownGlass>(medium.dispersion)) return "not known";
    return fmt::format("n {:.4f}", refractive_index(medium, d_line_nm));
}

bool is_air(const Medium& medium) {
    const auto* constant = std::get_if<ConstantIndex>(&medium.dispersion);
    return constant != nullptr && constant->n == 1.0;
}

Medium magnesium_fluoride() {
    return {"MgF2", FormulaGlass{.formula = 1,
                                 .coefficients = {0.0, 0.48755108, 0.04338408, 0.39875031,
                                                  0.09461442, 2.3120353, 23.793604},
                                 .min_nm = 200.0,
                                 .max_nm = 7000.0}};
}

const Medium* GlassCatalog::find(std::string_view name) const {
    const auto found = std::ranges::find_if(
        glasses, [&](const Medium& medium) { return same_letters(medium.name, name); });
    return found == glasses.end() ? nullptr : &*found;
}

}  // namespace ghostlight
