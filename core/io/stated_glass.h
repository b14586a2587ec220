#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "core/io/text_lines.h"
#include "core/optics/glass.h"

namespace ghostlight {

/// What a file says of the medium behind a surface.
struct StatedGlass {
    std::string name = {};  ///< of a catalogue; empty when the file names none
    std::optional<double> nd = {};
    std::optional<double> vd = {};  ///< not given, 0 and less: unknown
};

/// The medium for that. The catalogue's glass when its nd agrees with the file's within 2e-4 or the
/// file gives none, else a ModelGlass of nd and Vd, else a constant index; nothing at all, or nd 1,
/// is air. A name that nobody knows, without an index, becomes an UnknownGlass. All but the plain
/// cases are noted. Throws Error for an index below 1 or above 10.
Medium medium_of(const StatedGlass& glass, const Place& place, Notes& notes);

}  // namespace ghostlight
