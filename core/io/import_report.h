#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/optics/prescription.h"

namespace ghostlight {

// How the notes of an import or an export read.

/// "read", "converted", "assumed", "left out", "noticed".
std::string_view fate_name(Note::Fate fate);

/// "note", "warning" or "error".
std::string_view severity_name(Note::Severity severity);

/// Two lines at most for each note: "*" marks what matters for flare, "!" what has to be mended
/// before the lens can be traced.
std::string notes_text(const Notes& notes);

/// The row, from 0, of the surface that a note is about: by its place ("SURF 5",
/// "surfaces[3].nd"), by the words "surface 5", by the glass that nobody knows, or by another note
/// on the same line. Nothing for notes about several surfaces or none.
std::optional<std::size_t> surface_of(const Note& note, const Notes& notes,
                                      const Prescription& lens);

}  // namespace ghostlight
