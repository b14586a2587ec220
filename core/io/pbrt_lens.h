#pragma once

#include "core/io/formats.h"
#include "core/io/imported_lens.h"

namespace ghostlight {

/// A lens of pbrt's realistic camera (.dat): rows of radius, thickness, index, diameter in mm; also
/// with one number before them, the count of rows or the focal length.
bool is_pbrt_lens(std::string_view text);

/// Throws Error naming file and line.
ImportedLens import_pbrt_lens(const FormatSource& source);

}  // namespace ghostlight
