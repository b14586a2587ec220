#pragma once

#include <filesystem>
#include <string_view>

#include "core/flare/spectrum.h"

namespace ghostlight {

/// Reads a table of spectral power: one line a wavelength, wavelength in nm and power in any unit,
/// separated by a comma, semicolon, tab or blanks; lines that begin with a letter, # or ! are
/// passed over. The light's name is the file's. Throws Error naming file and line.
TabulatedLight spectrum_from_csv(std::string_view text, const std::filesystem::path& file);
TabulatedLight read_spectrum_csv(const std::filesystem::path& file);

/// A spectrum by its name (parse_spectrum), or by the name of a .csv file.
Spectrum spectrum_by_name(std::string_view text);

}  // namespace ghostlight
