#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/error.h"
#include "core/optics/coating.h"

namespace ghostlight {

/// A material of a coating file.
struct CoatingMaterial {
    std::string name;
    SpectralTable n, k;  ///< k ≥ 0 absorbs, whatever the file's sign
};

/// A layer as a coating file lists it.
struct ListedLayer {
    std::string material;
    double thickness = 0.0;
    bool in_um = false;  ///< else in wavelengths of the lens's primary wavelength, in the layer
    int repeats = 0;     ///< neighbours with the same number above 0 repeat together that often
};

/// Layers from the air side: they become a coating once the lens's primary wavelength is known.
struct ListedLayers {
    std::vector<ListedLayer> layers;
};

struct ListedCoating {
    std::string name;
    std::string where;  ///< "line 12"
    std::variant<ListedLayers, Coating> definition;
};

/// A Zemax coating file and what its reader noticed.
struct CoatingFile {
    std::filesystem::path file;
    std::vector<CoatingMaterial> materials;
    std::vector<ListedCoating> coatings;
    Notes notes;
};

/// Reads COATING.DAT: MATE, COAT, TABLE, IDEAL, IDEAL2 (docs/formats-catalogues.md). A definition
/// that cannot be used is left out with a warning. Throws Error when there is none at all.
CoatingFile coating_file_from_text(std::string_view text, const std::filesystem::path& file);
CoatingFile read_coating_file(const std::filesystem::path& file);

/// The file's coating of that name on a lens with that primary wavelength; none when the file has
/// no such name. Throws Error for a layer whose material nobody knows.
std::optional<Coating> coating_of(const CoatingFile& file, std::string_view name,
                                  double primary_nm);

/// The coating file that belongs to a lens file: of the given name, in the lens file's folder or
/// in a folder COATINGS beside it, in any case of letters; none when there is none.
std::optional<std::filesystem::path> find_coating_file(const std::filesystem::path& lens_file,
                                                       std::string_view name = "COATING.DAT");

/// What a lens file's coating name means.
struct ResolvedCoating {
    Coating coating;
    std::string origin;  ///< the file it comes from, or "library", or "Zemax name"
    Notes notes;         ///< what was assumed
};

/// Looks the name up in the coating file (if there is one), in the library, and among the names
/// that Zemax brings: I.05 (transmits 0.05), AR, HEAR1, WAR. None when nobody knows it.
std::optional<ResolvedCoating> resolve_coating(std::string_view name, const CoatingFile* file,
                                               double primary_nm);

}  // namespace ghostlight
