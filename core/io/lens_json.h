#pragma once

#include "core/io/json_value.h"
#include "core/io/lens_file.h"

namespace ghostlight {

/// The newest version of our own schema, the value of its first field "ghostlight_lens".
inline constexpr long lens_schema_version = 1;

/// Reads our own schema (docs/lens-format.md). Throws Error.
LensFile lens_from_own_json(const JsonAt& root);

/// Reads a listing: `surfaces` with radius, thickness, nd, vd, semi_diameter each. Throws Error.
LensFile lens_from_listing(const JsonAt& root);

/// validate(), with the file's name in the Error.
void validate_in_file(const Prescription& lens, const std::string& file);

/// What is odd but can be traced: a clear radius beyond the edge of its sphere.
Notes findings(const Prescription& lens);

}  // namespace ghostlight
