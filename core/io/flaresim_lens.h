#pragma once

#include "core/io/formats.h"
#include "core/io/imported_lens.h"

namespace ghostlight {

/// A FlareSim .lens: `name:`, `focal_length:`, then `surfaces:` and rows of radius, thickness,
/// index, Abbe number, semi-aperture, coating.
bool is_flaresim_lens(std::string_view text);

/// Throws Error naming file and line; also for cylinders and toroids, which cannot be traced.
ImportedLens import_flaresim_lens(const FormatSource& source);

}  // namespace ghostlight
