#include "core/optics/dispersion_formula.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

#include "core/error.h"

namespace ghostlight {
namespace {

constexpr double herzberger_pole_um2 = 0.028;  // fixed by the formula, whatever the glass

/// Σ c_i λ²/(λ² − c_(i+1)) over pairs. A pair that is all zero has no pole.
double sellmeier(std::span<const double> pairs, double um2) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < pairs.size(); i += 2)
        if (pairs[i] != 0.0) sum += pairs[i] * um2 / (um2 - pairs[i + 1]);
    return sum;
}

/// c0 + c1 L + c2 L² + c3 λ² + c4 λ⁴ + c5 λ⁶, L = 1/(λ² − 0.028).
double herzberger(std::span<const double> c, double um2) {
    const double l = 1.0 / (um2 - herzberger_pole_um2);
    return c[0] + l * (c[1] + l * c[2]) + um2 * (c[3] + um2 * (c[4] + um2 * c[5]));
}

/// Σ c_i λ^(first − 2i): a polynomial in even powers, from the highest down.
double even_powers(std::span<const double> c, double highest, double um) {
    double sum = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i)
        if (c[i] != 0.0) sum += c[i] * std::pow(um, highest - 2.0 * static_cast<double>(i));
    return sum;
}

template <std::size_t size>
std::array<double, size> padded(std::span<const double> coefficients) {
    std::array<double, size> all{};
    for (std::size_t i = 0; i < std::min(size, coefficients.size()); ++i) all[i] = coefficients[i];
    return all;
}

struct AgfForm {
    std::string_view name;
    std::size_t coefficients;
};
constexpr std::array<AgfForm, last_agf_formula + 1> agf_forms{{{"", 0},
                                                               {"Schott", 6},
                                                               {"Sellmeier 1", 6},
                                                               {"Herzberger", 6},
                                                               {"Sellmeier 2", 5},
                                                               {"Conrady", 3},
                                                               {"Sellmeier 3", 8},
                                                               {"Handbook 1", 4},
                                                               {"Handbook 2", 4},
                                                               {"Sellmeier 4", 5},
                                                               {"Extended", 8},
                                                               {"Sellmeier 5", 10},
                                                               {"Extended 2", 8},
                                                               {"Extended 3", 9}}};

[[noreturn]] void unknown_formula(std::string_view kind, int number, int last) {
    throw Error(fmt::format("{} formula {} is not known; expected 1 to {}", kind, number, last));
}

}  // namespace

bool fits_formula(int formula, std::size_t coefficients) {
    if (formula >= 7) return coefficients >= 1 && coefficients <= (formula == 8 ? 4U : 6U);
    if (coefficients % 2 == 0) return false;
    return formula != 4 || coefficients == 1 || coefficients == 5 || coefficients >= 9;
}

std::size_t agf_coefficient_count(int formula) {
    if (formula < 1 || formula > last_agf_formula)
        unknown_formula("AGF dispersion", formula, last_agf_formula);
    return agf_forms[static_cast<std::size_t>(formula)].coefficients;
}

std::string_view agf_formula_name(int formula) {
    if (formula < 1 || formula > last_agf_formula) return "unknown";
    return agf_forms[static_cast<std::size_t>(formula)].name;
}

FormulaValue formula_value(const FormulaGlass& glass, double um) {
    const auto& c = glass.coefficients;
    const double um2 = um * um;
    auto powers = [&](std::size_t first) {
        double sum = 0.0;
        for (std::size_t i = first; i + 1 < c.size(); i += 2) sum += c[i] * std::pow(um, c[i + 1]);
        return sum;
    };
    const double first = c.empty() ? 0.0 : c[0];
    const std::span<const double> rest =
        c.empty() ? std::span<const double>{} : std::span<const double>(c).subspan(1);
    switch (glass.formula) {
        case 1: {
            std::vector<double> squared(rest.begin(), rest.end());
            for (std::size_t i = 1; i < squared.size(); i += 2) squared[i] *= squared[i];
            return {1.0 + first + sellmeier(squared, um2), true};
        }
        case 2:
            return {1.0 + first + sellmeier(rest, um2), true};
        case 3:
            return {first + powers(1), true};
        case 4: {
            double value = first;
            for (std::size_t i = 1; i + 3 < c.size() && i < 9; i += 4)
                if (c[i] != 0.0)
                    value += c[i] * std::pow(um, c[i + 1]) / (um2 - std::pow(c[i + 2], c[i + 3]));
            return {value + powers(9), true};
        }
        case 5:
            return {first + powers(1), false};
        case 6: {
            double value = 1.0 + first;
            for (std::size_t i = 1; i + 1 < c.size(); i += 2)
                value += c[i] / (c[i + 1] - 1.0 / um2);
            return {value, false};
        }
        case 7:
            return {herzberger(padded<6>(c), um2), false};
        case 8: {
            // (n² − 1)/(n² + 2) = q.
            const auto a = padded<4>(c);
            const double q = a[0] + (a[1] == 0.0 ? 0.0 : a[1] * um2 / (um2 - a[2])) + a[3] * um2;
            return {(1.0 + 2.0 * q) / (1.0 - q), true};
        }
        case 9: {
            const auto a = padded<6>(c);
            const double away = um - a[4];
            double value = a[0];
            if (a[1] != 0.0) value += a[1] / (um2 - a[2]);
            if (a[3] != 0.0) value += a[3] * away / (away * away + a[5]);
            return {value, true};
        }
        default:
            unknown_formula("dispersion", glass.formula, last_formula);
    }
}

FormulaValue formula_value(const AgfGlass& glass, double um) {
    const double um2 = um * um;
    const auto a = padded<10>(glass.coefficients);
    const std::span<const double> all(a);
    auto term = [](double strength, double over) {
        return strength == 0.0 ? 0.0 : strength / over;
    };
    switch (glass.formula) {
        case 1:
        case 10: {
            // a1 λ² + a0 + a2 λ⁻² + …: the first two stand in the other order in the file.
            const std::array<double, 8> ordered{a[1],
                                                a[0],
                                                a[2],
                                                a[3],
                                                a[4],
                                                a[5],
                                                glass.formula == 10 ? a[6] : 0.0,
                                                glass.formula == 10 ? a[7] : 0.0};
            return {even_powers(ordered, 2.0, um), true};
        }
        case 2:
            return {1.0 + sellmeier(all.first(6), um2), true};
        case 3:
            return {herzberger(all.first(6), um2), false};
        case 4:
            return {
                1.0 + a[0] + um2 * term(a[1], um2 - a[2] * a[2]) + term(a[3], um2 - a[4] * a[4]),
                true};
        case 5:
            return {a[0] + a[1] / um + a[2] / std::pow(um, 3.5), false};
        case 6:
            return {1.0 + sellmeier(all.first(8), um2), true};
        case 7:
            return {a[0] + term(a[1], um2 - a[2]) - a[3] * um2, true};
        case 8:
            return {a[0] + um2 * term(a[1], um2 - a[2]) - a[3] * um2, true};
        case 9:
            return {a[0] + um2 * term(a[1], um2 - a[2]) + um2 * term(a[3], um2 - a[4]), true};
        case 11:
            return {1.0 + sellmeier(all, um2), true};
        case 12: {
            const std::array<double, 8> ordered{a[7], a[6], a[1], a[0], a[2], a[3], a[4], a[5]};
            return {even_powers(ordered, 6.0, um), true};
        }
        case 13: {
            const std::array<double, 9> ordered{a[2], a[1], a[0], a[3], a[4],
                                                a[5], a[6], a[7], a[8]};
            return {even_powers(ordered, 4.0, um), true};
        }
        default:
            unknown_formula("AGF dispersion", glass.formula, last_agf_formula);
    }
}

}  // namespace ghostlight
