#include "core/io/catalogued_glass.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "core/units.h"

namespace ghostlight {

std::string_view status_name(GlassStatus status) {
    constexpr std::array<std::string_view, 5> names{"standard", "preferred", "obsolete", "special",
                                                    "melt"};
    return names[static_cast<std::size_t>(status)];
}

void complete_glass(CataloguedGlass& glass) {
    auto value = [](auto compute) -> std::optional<double> {
        try {
            const double found = compute();
            return std::isfinite(found) ? std::optional(found) : std::nullopt;
        } catch (const Error&) {
            // Infrared and ultraviolet glasses have no visible lines: nothing to report.
            return std::nullopt;
        }
    };
    glass.nd = value([&] { return refractive_index(glass.medium, d_line_nm); });
    glass.vd = value([&] { return abbe_number(glass.medium); });
}

std::optional<double> known_nd(const CataloguedGlass& glass) {
    return glass.nd ? glass.nd : glass.listed_nd;
}

std::optional<double> known_vd(const CataloguedGlass& glass) {
    return glass.vd ? glass.vd : glass.listed_vd;
}

void add_note(Notes& notes, Note note) {
    constexpr std::size_t most = 1000;
    if (notes.size() < most)
        notes.push_back(std::move(note));
    else if (notes.size() == most)
        notes.push_back({note.severity,
                         note.where,
                         "more notes follow, which are not kept",
                         Note::Fate::left_out,
                         note.matters_for_flare,
                         {}});
}

Note index_disagreement(const CataloguedGlass& glass) {
    return {Note::Severity::warning,
            glass.where,
            fmt::format("{}: the formula gives nd {:.6f}, the catalogue lists {}",
                        glass.medium.name, glass.nd.value(), glass.listed_nd.value()),
            Note::Fate::noticed,
            true,
            "compare with the maker's data sheet: the formula is used"};
}

}  // namespace ghostlight
