#pragma once

#include "core/io/formats.h"
#include "core/io/imported_lens.h"

namespace ghostlight {

/// A Zemax .zmx, sequential: records of SURF blocks among system data.
bool is_zmx(std::string_view text);

/// Throws Error naming file and line; also for mirrors, tilts and surfaces that are not of
/// revolution, whose ghosts would be wrong.
ImportedLens import_zmx(const FormatSource& source);

/// The lens as a .zmx of the current position of its rows, configurations beside it. What Zemax
/// has no word for goes to the notes.
std::string write_zmx(const Prescription& lens, Notes& notes);

}  // namespace ghostlight
