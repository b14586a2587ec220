#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/io/glass_library.h"

namespace ghostlight {

/// A glass on the nd–Vd map.
struct MappedGlass {
    CataloguedGlass glass;
    double nd = 0.0, vd = 0.0;
    /// Relative partial dispersion (ng − nF)/(nF − nC); none where its formula does not reach g.
    std::optional<double> p_gf;
    /// P_gF − (0.6438 − 0.001682 Vd): off Schott's normal line through K7 and F2.
    std::optional<double> delta_p_gf;
};

/// Every glass of the library that has an nd and an Vd, once for each name and catalogue.
std::vector<MappedGlass> mapped_glasses(const GlassLibrary& library);

/// Places in `glasses` of what a text asks for, best first: part of a name ("bk7"), a six-digit
/// code ("517642"), or the nearest to "1.62 / 36.4"; an empty text asks for all, by name. A text
/// that is none of these finds nothing.
std::vector<std::size_t> find_glasses(const std::vector<MappedGlass>& glasses,
                                      std::string_view text);

}  // namespace ghostlight
