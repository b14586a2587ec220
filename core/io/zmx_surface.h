#pragma once

#include "core/io/imported_lens.h"
#include "core/io/text_lines.h"
#include "core/io/zmx_records.h"

namespace ghostlight {

/// Gives a row of the lens the shape of a Zemax surface: curve, conic, aspheric terms, in mm.
/// `bends_light_later` is true when glass follows it. Throws Error for a kind of surface that is
/// not of revolution, and for what has no surface at all (an ideal lens, a grating).
void set_zmx_shape(ImportedLens& lens, std::size_t row, const ZmxSurface& surface,
                   double mm_per_unit, bool bends_light_later, const std::string& file);

}  // namespace ghostlight
