#pragma once

#include <string_view>

#include "core/io/json_value.h"
#include "core/optics/coating.h"
#include "core/optics/glass.h"

namespace ghostlight {

/// A glass of the bundled catalogue, by name, or null. "MgF2" is magnesium_fluoride().
const Medium* find_glass(std::string_view name);

/// " (did you mean N-BK7?)", or nothing.
std::string suggestion(std::string_view unknown_glass);

/// Reads the medium that an object's fields `glass`, `model`, `index`, `formula` describe; air when
/// it has none of them. Fields that are not known go to `unknown`, below `below`. Throws Error.
Medium read_medium(const JsonAt& object, UnknownFields& unknown, const std::string& below = {});

/// The closed form in {number_key, coefficients}: its number, coefficients and range. Throws Error
/// for a formula that is not known or the wrong number of coefficients.
FormulaGlass read_formula(const JsonAt& object, std::string_view number_key);

/// Writes those fields; nothing for air. A glass of the catalogue is written by its name alone.
void write_medium(Json& object, const Medium& medium);

/// Reads "none", {"quarter_wave": …} or {"layers": […]}. Throws Error.
Coating read_coating(const JsonAt& value, UnknownFields& unknown);

/// The reverse; "none" for a bare surface.
Json write_coating(const Coating& coating);

/// Reads an array of layers, from the incoming side. Fields that are not known go to `unknown`,
/// below `below`. Throws Error.
LayerStack read_layers(const JsonAt& array, UnknownFields& unknown, const std::string& below);

}  // namespace ghostlight
