#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/optics/glass.h"

namespace ghostlight {

/// A glass as a lens file names it.
struct NamedGlass {
    std::string name;
    std::vector<std::string> catalogs = {};  ///< where the file says to look, in this order
    std::optional<double> nd = {}, vd = {};  ///< that the file holds beside the name
    std::string where = {};
};

/// The glass of the catalogue, whatever hyphens and blanks its name has here ("NBK7" is N-BK7);
/// else a model glass from nd and Vd, if they are real (neither 0 nor the placeholder 1.5/40);
/// else an UnknownGlass, with an error note that offers the nearest glasses.
Medium resolve_glass(const NamedGlass& named, Notes& notes);

/// A glass given by numbers alone; without an Abbe number its index is constant, and a note says
/// so. An index of 1 is air.
Medium numbered_glass(const std::string& label, double nd, std::optional<double> vd,
                      const std::string& where, Notes& notes);

/// Glasses of all catalogues whose names are spelt most like a name, best first, each once.
std::vector<std::string> nearest_names(std::string_view name, std::size_t count);

/// Real numbers, not what programs write where they know none: 0/0, 1/0, 1.5/40.
bool is_real_glass(std::optional<double> nd, std::optional<double> vd);

/// A glass code of any number of digits: "517642", "517.642", "516800.641700"; six digits as
/// glass_code() takes them. Nothing for other text.
std::optional<ModelGlass> coded_glass(std::string_view text);

}  // namespace ghostlight
