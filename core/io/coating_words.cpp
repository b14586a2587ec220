#include "core/io/coating_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/io/coating_library.h"

namespace ghostlight {
namespace {

std::optional<double> above_zero(std::string_view text) {
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(value) ||
        value <= 0.0)
        return std::nullopt;
    return value;
}

/// Words between commas, without the blanks about them.
std::vector<std::string_view> listed(std::string_view text) {
    std::vector<std::string_view> words;
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        std::string_view word = text.substr(0, comma);
        text.remove_prefix(std::min(comma + 1, text.size()));
        while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
        while (!word.empty() && word.back() == ' ') word.remove_suffix(1);
        if (!word.empty()) words.push_back(word);
    }
    return words;
}

}  // namespace

std::optional<Coating> coating_in_words(std::string_view text) {
    if (text == "none") return Uncoated{};
    if (text.starts_with("qw:")) {
        const std::string_view numbers = text.substr(3);
        const std::size_t colon = numbers.find(':');
        const auto center = above_zero(numbers.substr(0, colon));
        if (!center) return std::nullopt;
        QuarterWave film;
        film.center_nm = *center;
        if (colon != std::string_view::npos) {
            const auto index = above_zero(numbers.substr(colon + 1));
            if (!index) return std::nullopt;
            film.layer = Medium{{}, ConstantIndex{*index}};
        }
        return film;
    }
    if (const Coating* known = find_coating(text)) return *known;
    return std::nullopt;
}

std::string coating_words() {
    return fmt::format(
        "none, qw:NM or qw:NM:INDEX, such as qw:550 (MgF2) or qw:550:1.38, or one of {}",
        fmt::join(coating_names(), ", "));
}

std::vector<CoatingKind> parse_kinds(std::string_view text) {
    std::vector<CoatingKind> kinds;
    for (const std::string_view word : listed(text)) {
        const auto coating = coating_in_words(word);
        if (!coating)
            throw Error({.problem = "a kind of coating cannot be read",
                         .file = {},
                         .where = {},
                         .found = fmt::format("'{}'", word),
                         .expected = coating_words()});
        kinds.push_back({std::string(word), *coating});
    }
    return kinds;
}

std::vector<std::size_t> parse_kind_rows(std::string_view text, std::size_t count) {
    std::vector<std::size_t> rows;
    for (const std::string_view word : listed(text)) {
        const auto number = above_zero(word);
        if (!number || *number != std::floor(*number) || *number > static_cast<double>(count))
            throw Error({.problem = "a surface whose kind of coating is to be chosen is not there",
                         .file = {},
                         .where = {},
                         .found = fmt::format("'{}'", word),
                         .expected = fmt::format("surfaces 1 to {}, separated by commas", count)});
        rows.push_back(static_cast<std::size_t>(*number) - 1);
    }
    return rows;
}

}  // namespace ghostlight
