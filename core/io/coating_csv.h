#pragma once

#include <filesystem>
#include <string_view>

#include "core/optics/coating.h"

namespace ghostlight {

/// Reads a table of reflectances: a line of names, then one line a wavelength and angle, separated
/// by commas, semicolons or tabs (docs/formats-catalogues.md). Columns: wavelength_nm or
/// wavelength_um; angle_deg (0 without it); r, or r_s and r_p; optionally t, or t_s and t_p. Shares
/// are from 0 to 1, or in percent where the name says so (r_percent, "R (%)"). Every angle has the
/// same wavelengths. The coating's name is the file's. Throws Error naming file and line.
MeasuredReflectance measured_from_csv(std::string_view text, const std::filesystem::path& file);
MeasuredReflectance read_measured_csv(const std::filesystem::path& file);

}  // namespace ghostlight
