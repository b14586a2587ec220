#include "core/io/imported_glass.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/io/glass_library.h"
#include "core/io/import_notes.h"
#include "core/io/json_value.h"
#include "core/io/text_lines.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// Indices that files give beside a name are those of a melt, of another temperature or are
/// rounded to three decimals; what differs by more is another glass.
constexpr double same_nd = 2e-3;
constexpr double least_nd = 1.1, most_nd = 6.0, most_vd = 200.0;
constexpr double placeholder_nd = 1.5, placeholder_vd = 40.0;
constexpr std::size_t offered = 3;

std::string letters_and_digits(std::string_view name) {
    std::string plain;
    for (const char c : upper_case(name))
        if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) plain += c;
    return plain;
}

/// How many single letters have to change, come or go.
std::size_t edits_between(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, changed});
        }
    }
    return row.back();
}

/// That it was found, where, and what speaks against it.
void note_match(const GlassMatch& match, const NamedGlass& named, bool real, Notes& notes) {
    const std::string label = match.glass.medium.name + " (" + match.glass.catalog + ")";
    const auto nd = known_nd(match.glass);
    if (real && nd && std::abs(*nd - *named.nd) > same_nd)
        note_noticed(notes, named.where,
                     fmt::format("{} has nd {:.6g} in the catalogue, but {} in the file", label,
                                 *nd, format_number(*named.nd)),
                     true, "check which glass is meant; the catalogue's is used");
    else
        note_read(notes, named.where, "glass " + label);
    for (const CataloguedGlass& other : match.homonyms)
        note_noticed(notes, named.where,
                     fmt::format("{} has a glass {} too, with nd {:.6g}", other.catalog,
                                 other.medium.name, known_nd(other).value_or(0.0)),
                     true, "check which catalogue is meant");
    if (match.glass.nd && match.glass.listed_nd &&
        std::abs(*match.glass.nd - *match.glass.listed_nd) > index_agreement)
        note_noticed(notes, named.where,
                     fmt::format("the formula of {} gives nd {:.6g}, its catalogue lists {:.6g}",
                                 label, *match.glass.nd, *match.glass.listed_nd),
                     true, "check the catalogue's coefficients");
}

}  // namespace

std::vector<std::string> nearest_names(std::string_view name, std::size_t count) {
    constexpr std::size_t longest = 40;
    const std::string wanted = letters_and_digits(name.substr(0, longest));
    std::vector<std::pair<std::size_t, std::string>> found;
    const auto library = glass_library();
    for (const GlassFile& catalog : library->catalogs)
        for (const CataloguedGlass& glass : catalog.glasses)
            found.emplace_back(edits_between(wanted, letters_and_digits(glass.medium.name)),
                               glass.medium.name);
    std::ranges::stable_sort(found, {}, &std::pair<std::size_t, std::string>::first);
    std::vector<std::string> names;
    for (const auto& [edits, each] : found) {
        if (names.size() == count) break;
        if (std::ranges::find(names, each) == names.end()) names.push_back(each);
    }
    return names;
}

bool is_real_glass(std::optional<double> nd, std::optional<double> vd) {
    if (!nd || !(*nd >= least_nd && *nd <= most_nd)) return false;
    if (!vd || !(*vd > 0.0 && *vd <= most_vd)) return false;
    return !(*nd == placeholder_nd && *vd == placeholder_vd);
}

Medium numbered_glass(const std::string& label, double nd, std::optional<double> vd,
                      const std::string& where, Notes& notes) {
    if (nd == 1.0) return {};
    if (vd && *vd > 0.0) return {label, ModelGlass{nd, *vd}};
    note_assumed(notes, where,
                 fmt::format("no Abbe number: index {} at every wavelength", format_number(nd)));
    return {label, ConstantIndex{nd}};
}

Medium resolve_glass(const NamedGlass& named, Notes& notes) {
    const bool real = is_real_glass(named.nd, named.vd);
    if (const auto match = find_glass(named.name, named.catalogs)) {
        note_match(*match, named, real, notes);
        return match->glass.medium;
    }
    std::string where_looked = "the catalogues at hand";
    if (!named.catalogs.empty()) {
        where_looked += " (the file names";
        for (const std::string& catalog : named.catalogs) where_looked += " " + catalog;
        where_looked += ")";
    }
    if (real) {
        note_converted(
            notes, named.where,
            fmt::format("glass {} is not in {}: a model glass from the file's nd {} and Vd {}",
                        in_quotes(named.name), where_looked, format_number(*named.nd),
                        format_number(*named.vd)));
        return {named.name, ModelGlass{*named.nd, *named.vd}};
    }
    const std::string why =
        fmt::format("not in {}, and the file gives no real nd and Vd", where_looked);
    note_to_mend(notes, named.where, fmt::format("glass {} is {}", in_quotes(named.name), why),
                 fmt::format("name a glass of the catalogue (similar names: {}), or give nd and Vd",
                             fmt::join(nearest_names(named.name, offered), ", ")));
    return {named.name, UnknownGlass{why}};
}

std::optional<ModelGlass> coded_glass(std::string_view text) {
    if (const auto code = glass_code(text)) return code;
    const auto digits = [](std::string_view part) {
        return part.size() >= 3 && part.size() <= 16 &&
               std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; });
    };
    const std::size_t point = text.find('.');
    if (point == text.npos) return std::nullopt;
    const std::string_view index = text.substr(0, point), abbe = text.substr(point + 1);
    if (!digits(index) || !digits(abbe)) return std::nullopt;
    const auto nd = parse_number("1." + std::string(index));
    const auto vd =
        parse_number(std::string(abbe.substr(0, 2)) + "." + std::string(abbe.substr(2)));
    if (!nd || !vd || !(*vd > 0.0)) return std::nullopt;
    return ModelGlass{*nd, *vd};
}

}  // namespace ghostlight
