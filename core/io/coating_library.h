#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/optics/coating.h"

namespace ghostlight {

/// A coating that goes by a name, with its source.
struct LibraryCoating {
    std::string name;
    std::string title;   ///< one line for people
    std::string source;  ///< where the design comes from
    std::string notes;
    double design_nm = 0.0;        ///< centre wavelength; 0 where there is none
    double substrate_index = 0.0;  ///< of the glass it was designed for; 0 where there is none
    Coating coating;
    std::filesystem::path file;
};

/// The coatings of lenses/coatings, by name, read once. Throws Error naming a file that is wrong.
const std::vector<LibraryCoating>& coating_library();

/// The library's coating of that name (in any case of letters), or null.
const Coating* find_coating(std::string_view name);

std::vector<std::string> coating_names();

/// One file of the library; docs/formats-catalogues.md. Throws Error.
LibraryCoating library_coating_from_json(std::string_view text, const std::filesystem::path& file);

}  // namespace ghostlight
