#include "core/io/glass_library.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <system_error>

#include "core/io/agf.h"
#include "core/io/lens_file.h"
#include "core/io/refractive_index_yaml.h"
#include "core/io/same_name.h"

namespace ghostlight {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 2000;  // in one folder: more is not a folder of catalogues

struct Shared {
    std::mutex mutex;
    std::vector<fs::path> folders;
    std::shared_ptr<const GlassLibrary> library;
};
Shared& shared() {
    static Shared state;
    return state;
}

std::vector<fs::path> folders_of_environment() {
    std::vector<fs::path> folders;
    const char* named = std::getenv("GHOSTLIGHT_GLASS_PATH");
    std::string_view rest = named != nullptr ? named : "";
    while (!rest.empty()) {
        const std::size_t colon = std::min(rest.find(':'), rest.size());
        if (colon > 0) folders.emplace_back(rest.substr(0, colon));
        rest.remove_prefix(std::min(colon + 1, rest.size()));
    }
    return folders;
}

void read_folder(const fs::path& folder, GlassLibrary& library) {
    auto warn = [&](const std::string& where, const std::string& text) {
        library.notes.push_back(
            {Note::Severity::warning, where, text, Note::Fate::left_out, true, {}});
    };
    std::error_code status;
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, status))
        files.push_back(entry.path());
    if (status) return warn(folder.string(), "the folder cannot be read: " + status.message());
    std::ranges::sort(files);
    if (files.size() > most_files) {
        warn(folder.string(), "too many files; those after the first 2000 are not read");
        files.resize(most_files);
    }
    for (const fs::path& file : files) {
        const std::string extension = upper_case(file.extension().string());
        const bool is_agf = extension == ".AGF";
        if (!is_agf && extension != ".YML" && extension != ".YAML") continue;
        try {
            library.catalogs.push_back(is_agf ? read_agf(file) : read_material_yaml(file));
        } catch (const Error& error) {
            // One bad catalogue must not hide the others.
            warn(file.string(), error.what());
        }
    }
}

/// Capitals and digits alone.
std::string key_of(std::string_view name) {
    std::string key = upper_case(name);
    std::erase_if(key, [](char c) { return c == '-' || c == '_' || c == ' ' || c == '.'; });
    return key;
}

bool is_asked_for(const GlassFile& catalog, std::string_view wanted) {
    return !wanted.empty() && upper_case(catalog.name).starts_with(upper_case(wanted));
}

const CataloguedGlass* in_catalog(const GlassFile& catalog, std::string_view name, bool loosely) {
    const std::string key = key_of(name);
    for (const CataloguedGlass& glass : catalog.glasses) {
        const std::string& own = glass.medium.name;
        if (loosely ? key_of(own) == key : is_same_name(own, name)) return &glass;
    }
    return nullptr;
}

const CataloguedGlass* in_requested(const GlassLibrary& library, std::string_view name,
                                    std::span<const std::string> catalogs, bool loosely) {
    for (const std::string& wanted : catalogs)
        for (const GlassFile& catalog : library.catalogs)
            if (is_asked_for(catalog, wanted))
                if (const auto* found = in_catalog(catalog, name, loosely)) return found;
    return nullptr;
}

std::vector<CataloguedGlass> homonyms_of(const GlassLibrary& library,
                                         const CataloguedGlass& chosen) {
    std::vector<CataloguedGlass> others;
    const auto nd = known_nd(chosen);
    for (const GlassFile& catalog : library.catalogs) {
        const auto* other = in_catalog(catalog, chosen.medium.name, true);
        if (other == nullptr || other == &chosen) continue;
        const auto other_nd = known_nd(*other);
        if (nd && other_nd && std::abs(*nd - *other_nd) > index_agreement) others.push_back(*other);
    }
    return others;
}

}  // namespace

void set_glass_folders(std::vector<fs::path> folders) {
    const std::lock_guard lock(shared().mutex);
    shared().folders = std::move(folders);
    shared().library.reset();
}

std::shared_ptr<const GlassLibrary> glass_library() {
    const std::lock_guard lock(shared().mutex);
    if (!shared().library) {
        std::vector<fs::path> folders = folders_of_environment();
        folders.insert(folders.end(), shared().folders.begin(), shared().folders.end());
        shared().library = std::make_shared<const GlassLibrary>(read_glass_library(folders));
    }
    return shared().library;
}

GlassLibrary read_glass_library(std::span<const fs::path> folders) {
    GlassLibrary library;
    for (const fs::path& folder : folders) read_folder(folder, library);
    const std::vector<GlassFile>& bundled = bundled_catalogs();
    library.catalogs.insert(library.catalogs.end(), bundled.begin(), bundled.end());
    return library;
}

std::optional<GlassMatch> find_glass(const GlassLibrary& library, std::string_view name,
                                     std::span<const std::string> catalogs) {
    if (key_of(name).empty()) return std::nullopt;
    auto match = [&](const CataloguedGlass* found, bool requested) {
        return GlassMatch{*found, requested, homonyms_of(library, *found)};
    };
    for (const bool loosely : {false, true})
        if (const auto* found = in_requested(library, name, catalogs, loosely))
            return match(found, true);
    for (const bool loosely : {false, true})
        for (const GlassFile& catalog : library.catalogs)
            if (const auto* found = in_catalog(catalog, name, loosely))
                return match(found, catalogs.empty());
    // NBK7_SCHOTT: the catalogue stands behind the name.
    const auto bar = name.rfind('_');
    if (bar == name.npos || bar == 0) return std::nullopt;
    const std::string wanted[]{std::string(name.substr(bar + 1))};
    for (const bool loosely : {false, true})
        if (const auto* found = in_requested(library, name.substr(0, bar), wanted, loosely))
            return match(found, true);
    return std::nullopt;
}

std::vector<std::string> similar_glasses(const GlassLibrary& library, std::string_view name) {
    constexpr std::size_t shortest = 2;
    const std::string wanted = upper_case(name), key = key_of(name);
    std::vector<std::string> names;
    if (wanted.size() < shortest) return names;
    auto collect = [&](auto matches) {
        for (const GlassFile& catalog : library.catalogs)
            for (const CataloguedGlass& glass : catalog.glasses)
                if (matches(upper_case(glass.medium.name)) &&
                    std::ranges::find(names, glass.medium.name) == names.end())
                    names.push_back(glass.medium.name);
    };
    collect([&](const std::string& own) { return key_of(own) == key; });
    // The lead-free and arsenic-free successors have a letter and a hyphen before the old name.
    collect([&](const std::string& own) {
        return own.ends_with("-" + wanted) ||
               (own.size() >= shortest && wanted.ends_with("-" + own));
    });
    return names;
}

std::vector<GlassNeighbour> nearest_glasses(const GlassLibrary& library, double nd, double vd,
                                            std::size_t count) {
    // In most catalogues 0.01 in nd and 1 in Vd are about one step of the glass map.
    constexpr double nd_per_vd = 0.01;
    std::vector<GlassNeighbour> all;
    for (const GlassFile& catalog : library.catalogs)
        for (const CataloguedGlass& glass : catalog.glasses) {
            const auto own_nd = known_nd(glass), own_vd = known_vd(glass);
            if (own_nd && own_vd)
                all.push_back({glass, std::hypot(*own_nd - nd, nd_per_vd * (*own_vd - vd))});
        }
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(count, all.size()));
    std::ranges::partial_sort(all, end, [](const GlassNeighbour& a, const GlassNeighbour& b) {
        return a.distance < b.distance ||
               (a.distance == b.distance && a.glass.medium.name < b.glass.medium.name);
    });
    all.erase(end, all.end());
    return all;
}

std::optional<ModelGlass> glass_code(std::string_view text) {
    auto digits = [](std::string_view part) {
        return !part.empty() &&
               std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; });
    };
    const auto split = text.find_first_of(".-/: ");
    std::string_view first = text.substr(0, split);
    std::string_view second = split == text.npos ? std::string_view{} : text.substr(split + 1);
    if (!digits(first) || (split != text.npos && !digits(second))) return std::nullopt;
    if (first.size() == 6 &&
        !(text[std::min(split, text.size() - 1)] == '.' && second.size() == 6)) {
        second = first.substr(3);  // what follows the code is a density
        first = first.substr(0, 3);
    }
    const bool fits =
        (first.size() == 3 && second.size() == 3) || (first.size() == 6 && second.size() == 6);
    if (!fits) return std::nullopt;
    const double scale = first.size() == 3 ? 1e3 : 1e6;
    auto value = [](std::string_view part) {
        double number = 0.0;
        for (const char c : part) number = 10.0 * number + (c - '0');
        return number;
    };
    const double fraction = value(first) / scale;
    const double vd = value(second) / (scale / 100.0);
    if (!(vd > 0.0)) return std::nullopt;
    return ModelGlass{fraction < 0.1 ? 2.0 + fraction : 1.0 + fraction, vd};
}

std::vector<CataloguedGlass> glasses_by_code(const GlassLibrary& library, std::string_view code) {
    std::vector<CataloguedGlass> found;
    const auto wanted = glass_code(code);
    if (!wanted) return found;
    // Half of a code's last digits, and a little for how halves are rounded.
    constexpr double nd_half = 0.5e-3 * 1.001, vd_half = 0.05 * 1.001;
    for (const GlassFile& catalog : library.catalogs)
        for (const CataloguedGlass& glass : catalog.glasses) {
            // Codes are made from what the maker lists.
            const auto nd = glass.listed_nd ? glass.listed_nd : glass.nd;
            const auto vd = glass.listed_vd ? glass.listed_vd : glass.vd;
            if (nd && vd && std::abs(*nd - wanted->nd) <= nd_half &&
                std::abs(*vd - wanted->vd) <= vd_half)
                found.push_back(glass);
        }
    return found;
}

std::optional<GlassMatch> find_glass(std::string_view name, std::span<const std::string> catalogs) {
    return find_glass(*glass_library(), name, catalogs);
}
std::vector<std::string> similar_glasses(std::string_view name) {
    return similar_glasses(*glass_library(), name);
}
std::vector<GlassNeighbour> nearest_glasses(double nd, double vd, std::size_t count) {
    return nearest_glasses(*glass_library(), nd, vd, count);
}
std::vector<CataloguedGlass> glasses_by_code(std::string_view code) {
    return glasses_by_code(*glass_library(), code);
}

}  // namespace ghostlight
