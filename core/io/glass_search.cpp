#include "core/io/glass_search.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <string>

#include "core/error.h"
#include "core/io/same_name.h"
#include "core/units.h"

namespace ghostlight {

namespace {

constexpr double g_line_nm = 435.8343;  // mercury

/// Catalogues write a name with hyphens and blanks or without.
std::string bare(std::string_view name) {
    std::string plain = upper_case(name);
    std::erase_if(plain, [](char c) { return c == '-' || c == ' ' || c == '_'; });
    return plain;
}

std::optional<double> number_of(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || read.ec != std::errc{} || read.ptr != text.data() + text.size())
        return std::nullopt;
    return value;
}

/// "1.62 / 36.4", "1.62 36.4".
std::optional<ModelGlass> index_and_abbe(std::string_view text) {
    auto between = text.find('/');
    if (between == std::string_view::npos) between = text.find(' ');
    if (between == std::string_view::npos) return std::nullopt;
    const auto nd = number_of(text.substr(0, between));
    const auto vd = number_of(text.substr(between + 1));
    if (!nd || !vd || *nd < 1.0 || *vd <= 0.0) return std::nullopt;
    return ModelGlass{*nd, *vd};
}

/// As nearest_glasses() measures it.
double distance(const MappedGlass& glass, const ModelGlass& from) {
    return std::hypot(glass.nd - from.nd, 0.01 * (glass.vd - from.vd));
}

}  // namespace

std::vector<MappedGlass> mapped_glasses(const GlassLibrary& library) {
    std::vector<MappedGlass> mapped;
    std::set<std::pair<std::string, std::string>> seen;
    for (const GlassFile& catalog : library.catalogs) {
        for (const CataloguedGlass& glass : catalog.glasses) {
            const auto nd = known_nd(glass);
            const auto vd = known_vd(glass);
            const bool on_the_map = nd && vd && std::isfinite(*nd) && std::isfinite(*vd);
            if (!on_the_map || !seen.emplace(glass.catalog, glass.medium.name).second) continue;
            MappedGlass entry{glass, *nd, *vd, {}, {}};
            try {
                const double n_f = refractive_index(glass.medium, f_line_nm);
                const double n_c = refractive_index(glass.medium, c_line_nm);
                const double n_g = refractive_index(glass.medium, g_line_nm);
                if (n_f > n_c) {
                    entry.p_gf = (n_g - n_f) / (n_f - n_c);
                    entry.delta_p_gf = *entry.p_gf - (0.6438 - 0.001682 * entry.vd);
                }
            } catch (const Error&) {
                // No index so far in the blue.
            }
            mapped.push_back(std::move(entry));
        }
    }
    return mapped;
}

std::vector<std::size_t> find_glasses(const std::vector<MappedGlass>& glasses,
                                      std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    std::vector<std::size_t> found(glasses.size());
    for (std::size_t k = 0; k < found.size(); ++k) found[k] = k;
    const auto by_distance = [&](const ModelGlass& from) {
        std::ranges::stable_sort(found, {},
                                 [&](std::size_t k) { return distance(glasses[k], from); });
    };
    if (const auto code = glass_code(text)) {
        // A code is rounded: nd to 0.001, Vd to 0.1.
        std::erase_if(found, [&](std::size_t k) {
            return std::abs(glasses[k].nd - code->nd) > 0.00051 ||
                   std::abs(glasses[k].vd - code->vd) > 0.051;
        });
        by_distance(*code);
        return found;
    }
    if (const auto near = index_and_abbe(text)) {
        by_distance(*near);
        return found;
    }
    const std::string wanted = bare(text);
    std::erase_if(found, [&](std::size_t k) {
        return bare(glasses[k].glass.medium.name).find(wanted) == std::string::npos;
    });
    // The name itself, then what begins with it, then the rest, each by its name.
    std::ranges::stable_sort(found, {}, [&](std::size_t k) {
        const std::string name = bare(glasses[k].glass.medium.name);
        const int rank = name == wanted ? 0 : name.starts_with(wanted) ? 1 : 2;
        return std::pair(wanted.empty() ? 0 : rank, name);
    });
    return found;
}

}  // namespace ghostlight
