#pragma once

#include <limits>
#include <string>
#include <vector>

namespace ghostlight {

/// A stiff or extreme case with an answer in closed form, and how far the trace is from it.
struct ExtremeCase {
    std::string name;     ///< "radius of 1e9 mm against a plane"
    std::string physics;  ///< the closed form, or the limit
    std::string unit;     ///< of what follows: "mm", or "1" for weights and reflectances
    double expected = 0.0;
    double double_error = 0.0;  ///< |trace − expected|, one ray in double precision
    double float_error = std::numeric_limits<double>::quiet_NaN();  ///< in single; NaN: not traced
    /// What rounding alone may come to in double precision there.
    double double_bound = 0.0;
    bool holds() const { return double_error <= double_bound; }
};

/// All of them, by the trace that pictures and tables use. Takes milliseconds.
std::vector<ExtremeCase> extreme_cases();

}  // namespace ghostlight
