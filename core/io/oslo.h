#pragma once

#include "core/io/formats.h"
#include "core/io/imported_lens.h"

namespace ghostlight {

/// An OSLO lens (.len): LEN NEW, system data, blocks of surface data separated by NXT, END.
bool is_oslo(std::string_view text);

/// Throws Error naming file and line; also for mirrors, perfect lenses, tilts, toroids and
/// diffractive surfaces, whose ghosts would be wrong.
ImportedLens import_oslo(const FormatSource& source);

}  // namespace ghostlight
