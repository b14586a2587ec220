#pragma once

#include <filesystem>
#include <string_view>

#include "core/io/catalogued_glass.h"

namespace ghostlight {

/// Reads an AGF glass catalogue (Zemax; docs/formats-catalogues.md). A glass that cannot be used is
/// left out with a warning, and one whose formula disagrees with its own nd by more than
/// `index_agreement` gets one too. Throws Error naming file and line when this is no catalogue.
GlassFile agf_from_text(std::string_view text, const std::filesystem::path& file);

/// The same from a file, in UTF-8, UTF-16 or Latin-1.
GlassFile read_agf(const std::filesystem::path& file);

}  // namespace ghostlight
