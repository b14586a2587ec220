#include "core/io/text_lines.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/io/json_value.h"

namespace ghostlight {
namespace {

constexpr std::string_view blanks = " \t\v\f";

}  // namespace

void TextLines::Iterator::advance() {
    if (rest_.empty()) {
        ended_ = true;
        return;
    }
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line_ = {line_.number + 1, rest_.substr(0, end)};
    const bool two = rest_.substr(end, 2) == "\r\n";
    rest_.remove_prefix(std::min(end + (two ? 2 : 1), rest_.size()));
}

std::vector<std::string_view> words(std::string_view text) {
    std::vector<std::string_view> found;
    for (std::size_t begin = text.find_first_not_of(blanks); begin != text.npos;
         begin = text.find_first_not_of(blanks, begin)) {
        const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
        found.push_back(text.substr(begin, end - begin));
        begin = end;
    }
    return found;
}

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string clipped(std::string_view text, std::size_t bytes) {
    if (text.size() > bytes) {
        // A character's later bytes are 10xxxxxx.
        while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xc0) == 0x80) --bytes;
        text = text.substr(0, bytes);
    }
    return std::string(text);
}

std::optional<double> parse_number(std::string_view word) {
    constexpr std::size_t longest = 64;
    if (word.starts_with('+')) {
        word.remove_prefix(1);
        if (word.starts_with('-')) return std::nullopt;
    }
    if (word.empty() || word.size() > longest) return std::nullopt;
    char digits[longest];
    std::ranges::transform(word, digits, [](char c) { return c == 'D' || c == 'd' ? 'e' : c; });
    double value = 0.0;
    const auto [end, status] = std::from_chars(digits, digits + word.size(), value);
    if (status != std::errc{} || end != digits + word.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

void Place::refuse(std::string_view problem, std::string found, std::string_view expected) const {
    throw Error({.problem = std::string(problem),
                 .file = file,
                 .where = where,
                 .found = std::move(found),
                 .expected = std::string(expected)});
}

double Place::number(std::string_view word, std::string_view expected) const {
    const auto value = parse_number(word);
    if (!value) refuse("not a number", word.empty() ? "nothing" : in_quotes(word), expected);
    return *value;
}

std::string in_quotes(std::string_view text) { return excerpt(Json(clipped(text, 200))); }

}  // namespace ghostlight
