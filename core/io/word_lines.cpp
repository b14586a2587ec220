#include "core/io/word_lines.h"

#include <fmt/format.h>

#include <iterator>

namespace ghostlight {

std::string WordLine::where() const { return fmt::format("line {}", number); }

std::string_view WordLine::rest(std::size_t first_word) const {
    if (first_word >= words.size()) return {};
    return text.substr(static_cast<std::size_t>(words[first_word].data() - text.data()));
}

bool WordLines::next(WordLine& line) {
    for (; at_ != std::default_sentinel; ++at_) {
        line = {(*at_).number, trimmed((*at_).text), words((*at_).text)};
        if (line.words.empty()) continue;
        ++at_;
        return true;
    }
    return false;
}

}  // namespace ghostlight
