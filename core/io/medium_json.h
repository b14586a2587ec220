#pragma once

#include <string_view>

#include "core/io/json_value.h"
#include "core/optics/glass.h"

namespace ghostlight {

/// A glass of the bundled catalogue, by name, or null. "MgF2" is magnesium_fluoride().
const Medium* find_glass(std::string_view name);

/// " (did you mean N-BK7?)", or nothing.
std::string suggestion(std::string_view unknown_glass);

/// Reads the medium that an object's fields `glass`, `model`, `index`, `formula`, `agf`, `table`
/// and `transmittance` describe; air when it has none of them. Fields that are not known go to
/// `unknown`, below `below`. Throws Error.
Medium read_medium(const JsonAt& object, UnknownFields& unknown, const std::string& below = {});

/// The closed form in {number_key, coefficients}: its number, coefficients and range. Throws Error
/// for a formula that is not known or the wrong number of coefficients.
FormulaGlass read_formula(const JsonAt& object, std::string_view number_key);

/// Writes those fields; nothing for air. A glass of the catalogue is written by its name alone.
void write_medium(Json& object, const Medium& medium);

/// The medium of that name: "air", or a glass of the bundled or the user's catalogues. Throws
/// Error.
Medium named_glass(const JsonAt& name);

/// Reads {"nm": […], value_key: […]}: as many values as wavelengths, which rise. Throws Error.
SpectralTable read_spectral_table(const JsonAt& object, std::string_view value_key);

/// The reverse.
Json write_spectral_table(const SpectralTable& table, std::string_view value_key);

}  // namespace ghostlight
