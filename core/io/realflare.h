#pragma once

#include "core/io/formats.h"
#include "core/io/imported_lens.h"

namespace ghostlight {

/// A lens of realflare (.json): lens_elements with radius, distance, refractive_index, abbe_nr,
/// height.
bool is_realflare(std::string_view text);

/// Throws Error naming file and field.
ImportedLens import_realflare(const FormatSource& source);

}  // namespace ghostlight
