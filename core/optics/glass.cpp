#include "core/optics/glass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/optics/dispersion_formula.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double largest_index = 10.0;

constexpr double inverse_square(double length_um) { return 1.0 / (length_um * length_um); }

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

    double operator()(const FormulaGlass& glass) const { return of_formula(glass); }
    double operator()(const AgfGlass& glass) const { return of_formula(glass); }

    double operator()(const TabulatedGlass& glass) const {
        if (glass.index.empty()) refuse(0.0, "its table is empty");
        if (!glass.held_beyond)
            require_range(glass.index.front().wavelength_nm, glass.index.back().wavelength_nm);
        // A metal's index may be below 1, and far beyond a glass's.
        const double n = smooth_at(glass.index, nm);
        if (!(n > 0.0) || !std::isfinite(n)) refuse(n, "the table has no usable index there");
        return n;
    }

    double operator()(const UnknownGlass& glass) const {
        throw Error({.problem = fmt::format("glass {} is not known: {}", label(), glass.why),
                     .file = {},
                     .where = {},
                     .found = {},
                     .expected = "a glass of the catalogue, a model glass (nd, Vd) or an index"});
    }

    template <class Formula>
    double of_formula(const Formula& glass) const {
        require_range(glass.min_nm, glass.max_nm);
        const FormulaValue found = formula_value(glass, um_from_nm(nm));
        if (!std::isfinite(found.value) || found.value <= 1.0)
            refuse(found.value, "the formula has a pole there");
        const double n = found.is_squared ? std::sqrt(found.value) : found.value;
        if (n > largest_index) refuse(n, "no glass has such an index");
        return n;
    }

    void require_range(double min_nm, double max_nm) const {
        const bool below = min_nm > 0.0 && nm < min_nm;
        const bool above = max_nm > 0.0 && nm > max_nm;
        if (below || above)
            throw Error({.problem = fmt::format("glass {} has no index at {} nm", label(), nm),
                         .file = {},
                         .where = {},
                         .found = fmt::format("{} nm", nm),
                         .expected = fmt::format("a wavelength from {} to {} nm", min_nm, max_nm)});
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

struct RangeOf {
    using Range = std::optional<std::pair<double, double>>;
    static constexpr double no_end = std::numeric_limits<double>::infinity();

    Range operator()(const ConstantIndex&) const { return Range({0.0, no_end}); }
    Range operator()(const ModelGlass&) const { return Range({0.0, no_end}); }
    Range operator()(const UnknownGlass&) const { return std::nullopt; }
    Range operator()(const FormulaGlass& glass) const { return of_formula(glass); }
    Range operator()(const AgfGlass& glass) const { return of_formula(glass); }
    Range operator()(const TabulatedGlass& glass) const {
        if (glass.held_beyond || glass.index.empty()) return Range({0.0, no_end});
        return Range({glass.index.front().wavelength_nm, glass.index.back().wavelength_nm});
    }
    template <class Formula>
    static Range of_formula(const Formula& glass) {
        return Range({glass.min_nm, glass.max_nm > 0.0 ? glass.max_nm : no_end});
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

std::optional<std::pair<double, double>> wavelength_range_nm(const Medium& medium) {
    return std::visit(RangeOf{}, medium.dispersion);
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

double absorption_per_mm(const Medium& medium, double wavelength_nm) {
    if (medium.transmittance.empty()) return 0.0;
    // A catalogue's 0 means less than it could print.
    constexpr double least_share = 1e-10;
    SpectralTable absorption;
    // Several thicknesses at one wavelength: a thick piece tells small losses better, until too
    // little comes through.
    constexpr double telling_share = 0.1;
    for (const InternalTransmittance& at : medium.transmittance) {
        const double loss = -std::log(std::max(at.share, least_share)) / at.thickness_mm;
        const bool again =
            !absorption.empty() && absorption.back().wavelength_nm == at.wavelength_nm;
        if (!again)
            absorption.push_back({at.wavelength_nm, loss});
        else if (at.share >= telling_share)
            absorption.back().value = loss;
    }
    return linear_at(absorption, wavelength_nm);
}

double internal_transmittance(const Medium& medium, double wavelength_nm, double length_mm) {
    return std::exp(-absorption_per_mm(medium, wavelength_nm) * length_mm);
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
