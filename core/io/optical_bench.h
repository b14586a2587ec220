#pragma once

#include "core/io/formats.h"
#include "core/io/imported_lens.h"

namespace ghostlight {

/// A lens of the PhotonsToPhotos Optical Bench (.txt): sections in brackets, values between tabs,
/// full diameters, one column for each zoom and focus position.
bool is_optical_bench(std::string_view text);

/// Every position becomes a configuration. Throws Error naming file and line.
ImportedLens import_optical_bench(const FormatSource& source);

}  // namespace ghostlight
