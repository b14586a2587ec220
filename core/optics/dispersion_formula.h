#pragma once

#include <cstddef>
#include <string_view>

#include "core/optics/glass.h"

namespace ghostlight {

/// What a dispersion formula gives: n² for most, n itself for some.
struct FormulaValue {
    double value = 0.0;
    bool is_squared = true;
};

inline constexpr int last_formula = 9;       ///< of refractiveindex.info, from 1
inline constexpr int last_agf_formula = 13;  ///< of AGF catalogues, from 1

/// The closed form's value at λ in µm. A coefficient that is missing is 0. Throws Error for a
/// number that is not known.
FormulaValue formula_value(const FormulaGlass& glass, double um);
FormulaValue formula_value(const AgfGlass& glass, double um);

/// Whether the formula can have that many coefficients: pairs follow a leading one, formula 4
/// begins with two groups of four, and from 7 on each coefficient has its own place.
bool fits_formula(int formula, std::size_t coefficients);

/// How many coefficients an AGF formula takes, and what it is called.
std::size_t agf_coefficient_count(int formula);
std::string_view agf_formula_name(int formula);

}  // namespace ghostlight
