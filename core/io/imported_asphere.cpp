#include "core/io/imported_asphere.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/import_notes.h"

namespace ghostlight {
namespace {

/// A reflection at a slope wrong by this lands 2 µm off, 50 mm on: below a pixel.
constexpr double harmless_slope = 2e-5;

double bound_of_fit_mm(const ImportedLens& lens, std::size_t row) {
    if (const auto& own = lens.surfaces[row].semi_diameter_mm) return *own;
    double largest = 0.0;
    for (const ImportedSurface& each : lens.surfaces)
        largest = std::max(largest, each.semi_diameter_mm.value_or(0.0));
    constexpr double default_mm = 10.0;  // as Surface has it
    return largest > 0.0 ? largest : default_mm;
}

}  // namespace

void set_asphere(ImportedLens& lens, std::size_t row, const RadialSurface& asphere,
                 const Place& place) {
    Surface& surface = lens.lens.surfaces[row];
    const double clear_mm = bound_of_fit_mm(lens, row);
    const EvenAsphere even = even_asphere(asphere, clear_mm);
    const auto finite = [](double value) { return std::isfinite(value); };
    if (!std::ranges::all_of(even.aspheric, finite) || !finite(even.conic) ||
        !finite(curvature_per_mm(even.curve)) || !finite(even.sag_error_mm))
        place.refuse("not a usable asphere", "coefficients beyond use",
                     "terms whose sag is finite within the clear radius");
    surface.conic = even.conic;
    surface.aspheric = even.aspheric;
    if (even.exact) {
        note_read(lens.notes, place.where,
                  fmt::format("surface {}: asphere, conic {}, {} terms", row + 1, even.conic,
                              asphere.terms.size()));
        return;
    }
    surface.curve = even.curve;
    std::string powers;
    for (const auto& [power, term] : asphere.terms)
        if (term != 0.0 && (power % 2 != 0 || power < 4 || power > 42))
            powers += fmt::format("{}r^{}", powers.empty() ? "" : ", ", power);
    const bool matters = even.slope_error > harmless_slope;
    note_converted(
        lens.notes, place.where,
        fmt::format("surface {}: the terms in {} are replaced by an even polynomial to r^24 that "
                    "differs from them by at most {:.2g} nm in height and {:.2g} in slope within "
                    "{} mm of the axis",
                    row + 1, powers, even.sag_error_mm * 1e6, even.slope_error, clear_mm),
        matters, matters ? "expect this surface's ghosts to be off; compare with the source" : "");
}

}  // namespace ghostlight
