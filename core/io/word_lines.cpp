#include "core/io/word_lines.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace ghostlight {
namespace {

constexpr std::string_view blanks = " \t\r\f\v";

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    for (auto begin = line.find_first_not_of(blanks); begin != line.npos;) {
        const auto end = std::min(line.find_first_of(blanks, begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        begin = line.find_first_not_of(blanks, end);
    }
    return words;
}

}  // namespace

std::string WordLine::where() const { return fmt::format("line {}", number); }

std::string_view WordLine::rest(std::size_t first_word) const {
    if (first_word >= words.size()) return {};
    return text.substr(static_cast<std::size_t>(words[first_word].data() - text.data()));
}

bool WordLines::next(WordLine& line) {
    while (!rest_.empty()) {
        const auto end = std::min(rest_.find('\n'), rest_.size());
        line = {++number_, {}, words_of(rest_.substr(0, end))};
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        if (line.words.empty()) continue;
        const char* first = line.words.front().data();
        const char* last = line.words.back().data() + line.words.back().size();
        line.text = {first, static_cast<std::size_t>(last - first)};
        return true;
    }
    return false;
}

std::optional<double> real_number(std::string_view word) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (problem != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

}  // namespace ghostlight
