#pragma once

#include "core/io/formats.h"
#include "core/io/imported_lens.h"

namespace ghostlight {

/// A CODE V .seq: the commands that build a lens.
bool is_seq(std::string_view text);

/// Throws Error naming file and line; also for mirrors, tilts, diffraction and surfaces that are
/// not of revolution, whose ghosts would be wrong.
ImportedLens import_seq(const FormatSource& source);

/// The lens as a .seq in radius mode, zoom positions beside it. What CODE V has no word for goes to
/// the notes.
std::string write_seq(const Prescription& lens, Notes& notes);

}  // namespace ghostlight
