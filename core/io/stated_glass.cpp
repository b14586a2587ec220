#include "core/io/stated_glass.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/import_notes.h"
#include "core/io/medium_json.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// Listings give nd to five decimals, melts of one glass differ by less: beyond it is another
/// glass.
constexpr double same_nd = 2e-4;

Medium from_index(const StatedGlass& glass, const Place& place, Notes& notes) {
    if (*glass.nd == 1.0) return {};
    if (glass.vd && *glass.vd > 0.0) return {glass.name, ModelGlass{*glass.nd, *glass.vd}};
    note_assumed(notes, place.where,
                 fmt::format("the dispersion of the glass with index {} is not in the file: the "
                             "index is taken for every wavelength",
                             *glass.nd),
                 true, "give the glass, or its Abbe number");
    return {glass.name, ConstantIndex{*glass.nd}};
}

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
    if (glass.vd && !std::isfinite(*glass.vd))
        place.refuse("not a usable Abbe number", fmt::format("{}", *glass.vd), "a finite number");
    if (glass.name.empty() || same_word(glass.name, "air"))
        return glass.nd ? from_index({{}, glass.nd, glass.vd}, place, notes) : Medium{};

    const Medium* known = find_glass(glass.name);
    const auto known_nd = known != nullptr ? index_at_d(*known) : std::nullopt;
    const std::string name = in_quotes(glass.name);
    if (!glass.nd) {
        if (known != nullptr) {
            note_read(notes, place.where, fmt::format("glass {} from the catalogue", name));
            return *known;
        }
        const std::string why = "not in the catalogue, and the file gives no index for it";
        note_to_mend(notes, place.where, fmt::format("glass {} is {}", name, why),
                     "choose the glass" + suggestion(glass.name));
        return {glass.name, UnknownGlass{why}};
    }
    if (known_nd && std::abs(*known_nd - *glass.nd) <= same_nd) {
        note_read(
            notes, place.where,
            fmt::format("glass {} from the catalogue, whose nd {:.5f} agrees with the file's {}",
                        name, *known_nd, *glass.nd));
        return *known;
    }
    if (known_nd) {
        note_converted(notes, place.where,
                       fmt::format("glass {} has nd {:.5f} in the catalogue, but {} in the file: "
                                   "the file's index is used",
                                   name, *known_nd, *glass.nd),
                       false, "choose the catalogue's glass if the name is what is right");
    } else {
        note_converted(
            notes, place.where,
            fmt::format("glass {} is not in the catalogue: the file's index is used", name));
    }
    return from_index(glass, place, notes);
}

}  // namespace ghostlight
