#pragma once

#include "core/io/imported_lens.h"
#include "core/io/text_lines.h"
#include "core/optics/even_asphere.h"

namespace ghostlight {

/// Gives a row of the lens the asphere's shape, and says in the report what was fitted and how
/// well. The row's semi-diameter, or else the largest of the lens, bounds the fit. Throws Error for
/// numbers beyond use.
void set_asphere(ImportedLens& lens, std::size_t row, const RadialSurface& asphere,
                 const Place& place);

}  // namespace ghostlight
