#pragma once

#include <optional>
#include <string_view>

#include "core/io/imported_lens.h"

namespace ghostlight {

/// Finds out whether the heights that a file calls semi-diameters are that, and sets them right:
/// halved when they are diameters, tenfold when they are centimetres. The evidence is a surface
/// that is smaller than its own clear radius (no sphere reaches beyond |R|) and the stop against
/// the height of the marginal ray of `f_number` (none: not looked at). Always noted, with what was
/// found; `diameters_expected` decides where there is no evidence.
void settle_heights(ImportedLens& lens, std::optional<double> f_number, bool diameters_expected);

/// The f-number that a text names as "f/2.8", "F2.8"; nothing for none or an unlikely one.
std::optional<double> f_number_in(std::string_view text);

}  // namespace ghostlight
