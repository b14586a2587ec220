#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/io/text_lines.h"

namespace ghostlight {

/// A row of [lens data].
struct BenchSurface {
    Place place;
    std::string id, radius, thickness;  ///< as they stand: numbers, AS, FS, CG, d12
    std::optional<double> nd, diameter_mm, vd;
    std::string glass;  ///< a catalogue's name beside it is not needed: names are searched in all
};

/// A row of [aspherical data].
struct BenchAsphere {
    Place place;
    std::string id;
    std::optional<double> radius_mm;
    double conic = 0.0;
    std::vector<double> terms;
};

/// A row of [variable distances]: one value for each position; nothing where it is undefined.
struct BenchVariable {
    Place place;
    std::vector<std::optional<double>> values;  ///< infinity for Infinity
};

struct BenchText {
    std::string title, remarks;
    std::optional<int> odd_terms;  ///< AsphericalOddCount
    bool has_square_term = false;  ///< AsphericalA2
    std::map<std::string, BenchVariable> variables;
    std::vector<BenchSurface> surfaces;
    std::vector<BenchAsphere> aspheres;

    /// The row of that name, or of that name with a suffix such as " (p)"; null when there is none.
    const BenchVariable* variable(std::string_view name) const;
};

/// The value of a row in a position: its only one, if it has but one; nothing where undefined.
std::optional<double> value_in(const BenchVariable* variable, std::size_t position);

/// Throws Error naming file and line.
BenchText read_bench_text(std::string_view text, const std::string& file, Notes& notes);

}  // namespace ghostlight
