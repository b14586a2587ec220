#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <system_error>

#include "core/error.h"
#include "core/io/json_value.h"
#include "core/io/lens_file.h"
#include "core/io/medium_json.h"
#include "core/io/read_text.h"
#include "core/io/same_name.h"
#include "core/units.h"

namespace ghostlight {
namespace {

namespace fs = std::filesystem;

bool holds_data(const fs::path& folder) {
    std::error_code status;
    return fs::is_regular_file(folder / "glasses" / "glasses.json", status);
}

CataloguedGlass read_catalogued(const JsonAt& entry) {
    entry.require_object();
    FormulaGlass formula = read_formula(entry, "formula");
    constexpr std::string_view expected = "[shortest, longest] wavelength in µm";
    const JsonAt range = entry.at("wavelength_range_um", expected);
    range.require_array(expected);
    if (range.size() != 2) range.refuse("not a range", expected);
    formula.min_nm = nm_from_um(range[0].number());
    formula.max_nm = nm_from_um(range[1].number());
    CataloguedGlass glass;
    glass.medium = {entry.at("name", "the glass's name").text(), std::move(formula)};
    // "crystal (Malitson 1963)" → CRYSTAL
    const std::string vendor = optional_text(entry, "vendor");
    glass.catalog = upper_case(vendor.substr(0, vendor.find(" (")));
    if (glass.catalog.find_first_of(" ,") != std::string::npos) glass.catalog = "OTHER";
    glass.comment = optional_text(entry, "source");
    glass.where = entry.path();
    complete_glass(glass);
    return glass;
}

/// In the file's order; a catalogue for each maker.
std::vector<GlassFile> read_catalogs(const fs::path& file) {
    const std::string name = file.string();
    const Json json = parse_json(read_text(file), name);
    const JsonAt root(json, name);
    root.require_object("a glass catalogue {…}");
    const JsonAt entries = root.at("glasses", "an array of glasses");
    entries.require_array();
    std::vector<GlassFile> catalogs;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        CataloguedGlass glass = read_catalogued(entries[i]);
        auto own = std::ranges::find(catalogs, glass.catalog, &GlassFile::name);
        if (own == catalogs.end())
            own = catalogs.insert(catalogs.end(), GlassFile{glass.catalog, file, {}, {}});
        own->glasses.push_back(std::move(glass));
    }
    return catalogs;
}

}  // namespace

fs::path data_directory() {
    if (const char* named = std::getenv("GHOSTLIGHT_DATA"); named != nullptr && *named != '\0') {
        if (!holds_data(named))
            throw Error({.problem = "GHOSTLIGHT_DATA names a folder without glasses/glasses.json",
                         .file = {},
                         .where = {},
                         .found = named,
                         .expected = "the folder with the bundled lenses"});
        return named;
    }
    std::error_code status;
    const fs::path program = fs::read_symlink("/proc/self/exe", status);
    const fs::path installed =
        program.parent_path().parent_path() / "share" / "ghostlight" / "lenses";
    if (!status && holds_data(installed)) return installed;
    if (holds_data(GHOSTLIGHT_SOURCE_DATA_DIR)) return GHOSTLIGHT_SOURCE_DATA_DIR;
    throw Error({.problem = "the bundled lenses and glasses are not found",
                 .file = {},
                 .where = {},
                 .found = {},
                 .expected = fmt::format("them in {}, or in the folder that GHOSTLIGHT_DATA names",
                                         installed.string())});
}

const std::vector<GlassFile>& bundled_catalogs() {
    static const std::vector<GlassFile> catalogs =
        read_catalogs(data_directory() / "glasses" / "glasses.json");
    return catalogs;
}

const GlassCatalog& bundled_glasses() {
    static const GlassCatalog catalog = [] {
        // The default coating material goes by its common name.
        GlassCatalog all{{magnesium_fluoride()}};
        for (const GlassFile& maker : bundled_catalogs())
            for (const CataloguedGlass& glass : maker.glasses) all.glasses.push_back(glass.medium);
        return all;
    }();
    return catalog;
}

std::vector<BundledLens> bundled_lenses() {
    std::vector<BundledLens> lenses;
    for (const fs::directory_entry& entry : fs::directory_iterator(data_directory()))
        if (entry.path().extension() == ".json")
            lenses.push_back({read_lens(entry.path()).lens.name, entry.path()});
    std::ranges::sort(lenses, [](const BundledLens& a, const BundledLens& b) {
        return std::tie(a.name, a.file) < std::tie(b.name, b.file);
    });
    return lenses;
}

}  // namespace ghostlight
