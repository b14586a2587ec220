#include "core/io/stated_glass.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/import_notes.h"
#include "core/io/imported_glass.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// Listings give nd to five decimals, melts of one glass differ by less: beyond it is another
/// glass.
constexpr double same_nd = 2e-4;

std::optional<double> index_at_d(const Medium& medium) {
    try {
        return refractive_index(medium, d_line_nm);
    } catch (const Error&) {
        return std::nullopt;  // a glass for the infrared, say
    }
}

}  // namespace

Medium medium_of(const StatedGlass& glass, const Place& place, Notes& notes) {
    if (glass.nd && !(*glass.nd >= 1.0 && *glass.nd <= 10.0))
        place.refuse("not a usable index", fmt::format("{}", *glass.nd), "an index from 1 to 10");
    // Below 1 the index would change by more than itself across the spectrum.
    if (glass.vd && !(*glass.vd <= 0.0 || (*glass.vd >= 1.0 && *glass.vd <= 1e6)))
        place.refuse("not a usable Abbe number", fmt::format("{}", *glass.vd),
                     "1 or more, 0 for none");
    if (glass.name.empty() || is_same_name(glass.name, "air"))
        return glass.nd ? numbered_glass({}, *glass.nd, glass.vd, place.where, notes) : Medium{};
    const NamedGlass named{glass.name, {}, glass.nd, glass.vd, place.where};
    if (!glass.nd) return resolve_glass(named, notes);

    Notes of_name;
    const Medium known = resolve_glass(named, of_name);
    const auto known_nd = index_at_d(known);
    if (known_nd && std::abs(*known_nd - *glass.nd) <= same_nd) {
        notes.insert(notes.end(), of_name.begin(), of_name.end());
        return known;
    }
    const std::string name = in_quotes(glass.name);
    note_converted(
        notes, place.where,
        known_nd ? fmt::format("glass {} has nd {:.5f} in the catalogue, but {} in the "
                               "file: the file's nd and Vd are used",
                               name, *known_nd, *glass.nd)
                 : fmt::format("glass {} is not in the catalogue: the file's nd is used", name),
        false, known_nd ? "choose the catalogue's glass if the name is right" : "");
    return numbered_glass(glass.name, *glass.nd, glass.vd, place.where, notes);
}

}  // namespace ghostlight
