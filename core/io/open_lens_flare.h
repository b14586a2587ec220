#pragma once

#include "core/io/formats.h"
#include "core/io/imported_lens.h"

namespace ghostlight {

/// A lens of OpenLensFlare (.xml): opticalSystem with elements/element.
bool is_open_lens_flare(std::string_view text);

/// Throws Error naming file and line; also for kinds of elements that cannot be traced.
ImportedLens import_open_lens_flare(const FormatSource& source);

}  // namespace ghostlight
