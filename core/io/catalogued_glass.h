#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/optics/glass.h"

namespace ghostlight {

/// What a maker says of a glass's availability, as AGF numbers it.
enum class GlassStatus { standard, preferred, obsolete, special, melt };
std::string_view status_name(GlassStatus status);

/// A glass as a catalogue lists it.
struct CataloguedGlass {
    Medium medium;
    std::string catalog;  ///< "SCHOTT": the maker, or the file's name
    /// What the dispersion gives at d, and (nd − 1)/(nF − nC); none beyond its range.
    std::optional<double> nd, vd;
    /// What the catalogue says beside it; none where it says nothing (AGF's nd = 1).
    std::optional<double> listed_nd, listed_vd;
    std::optional<GlassStatus> status;
    SpectralTable extinction;  ///< k against wavelength, where the source gives it
    std::string comment;
    std::string where;  ///< "line 12" of its file
};

/// Fills in nd and vd.
void complete_glass(CataloguedGlass& glass);

/// The formula's nd where there is one, else the listed one; likewise for vd.
std::optional<double> known_nd(const CataloguedGlass& glass);
std::optional<double> known_vd(const CataloguedGlass& glass);

/// A catalogue of glasses and what its reader noticed.
struct GlassFile {
    std::string name;  ///< by which lens files ask for it: "SCHOTT"
    std::filesystem::path file;
    std::vector<CataloguedGlass> glasses;
    Notes notes;
};

/// A formula whose nd is off the listed one by more than this has wrong coefficients, or belongs to
/// another melt.
inline constexpr double index_agreement = 1e-4;

/// Adds a note, but to more than a thousand only that there are more: a broken file can have a note
/// on every line.
void add_note(Notes& notes, Note note);

/// Says that the glass's formula and its listed nd, both known, do not agree.
Note index_disagreement(const CataloguedGlass& glass);

}  // namespace ghostlight
