#pragma once

#include "core/io/json_value.h"
#include "core/optics/coating.h"

namespace ghostlight {

/// Reads "none", the name of a library coating (also {"library": "name"}), {"quarter_wave": …},
/// {"layers": …}, {"measured": …} or {"constant": …}. Throws Error.
Coating read_coating(const JsonAt& value, UnknownFields& unknown);

/// The same without the library, which is read with it.
Coating read_described_coating(const JsonAt& value, UnknownFields& unknown);

/// The reverse; "none" for a bare surface, and for a coating that the library holds its name.
Json write_coating(const Coating& coating);

/// The reverse of read_described_coating.
Json describe_coating(const Coating& coating);

/// Reads an array of layers. Fields that are not known go to `unknown`, below `below`. Throws
/// Error.
LayerStack read_layers(const JsonAt& array, UnknownFields& unknown, const std::string& below);

}  // namespace ghostlight
