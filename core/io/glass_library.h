#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/catalogued_glass.h"

namespace ghostlight {

/// All catalogues at hand, in the order in which they are searched: the user's folders, then the
/// bundled ones by maker.
struct GlassLibrary {
    std::vector<GlassFile> catalogs;
    Notes notes;  ///< files that could not be read
};

/// Folders with AGF catalogues (and refractiveindex.info files) besides those that the
/// environment's GHOSTLIGHT_GLASS_PATH names, which come first. What is read from the next look-up
/// on.
void set_glass_folders(std::vector<std::filesystem::path> folders);

/// The library, read on first use and again when the folders change. From any thread; whoever holds
/// it keeps it alive.
std::shared_ptr<const GlassLibrary> glass_library();

/// Reads folders, in their order and each by file name; what is bundled follows.
GlassLibrary read_glass_library(std::span<const std::filesystem::path> folders);

/// A glass that was found, and what else goes by its name.
struct GlassMatch {
    CataloguedGlass glass;
    bool in_requested = true;  ///< false: none of the catalogues that were asked for has it
    /// Glasses of the same name in other catalogues, whose nd differs by more than
    /// `index_agreement`.
    std::vector<CataloguedGlass> homonyms;
};

/// The glass of that name: in the catalogues asked for, in their order, then in all others; as
/// written before without hyphens and blanks (N-BK7 = NBK7). A catalogue is asked for by the
/// beginning of its name ("SCHOTT" is SCHOTT_2019 too); NAME_CATALOG asks for it in the name.
std::optional<GlassMatch> find_glass(const GlassLibrary& library, std::string_view name,
                                     std::span<const std::string> catalogs);
std::optional<GlassMatch> find_glass(std::string_view name, std::span<const std::string> catalogs);

/// Names that may have been meant: BK7 → N-BK7, nbk7 → N-BK7. Best first.
std::vector<std::string> similar_glasses(const GlassLibrary& library, std::string_view name);
std::vector<std::string> similar_glasses(std::string_view name);

struct GlassNeighbour {
    CataloguedGlass glass;
    double distance = 0.0;  ///< sqrt(Δnd² + (0.01 ΔVd)²)
};

/// The nearest glasses by nd and Vd.
std::vector<GlassNeighbour> nearest_glasses(const GlassLibrary& library, double nd, double vd,
                                            std::size_t count);
std::vector<GlassNeighbour> nearest_glasses(double nd, double vd, std::size_t count);

/// What a six-digit code says: 517642, 517.642, 517-642, 517000.642000, and 517642.251 with a
/// density behind it. Codes below 100 mean nd of 2 and more.
std::optional<ModelGlass> glass_code(std::string_view text);

/// Glasses of that code; empty also for a text that is none.
std::vector<CataloguedGlass> glasses_by_code(const GlassLibrary& library, std::string_view code);
std::vector<CataloguedGlass> glasses_by_code(std::string_view code);

}  // namespace ghostlight
