#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/text_lines.h"

namespace ghostlight {

/// A line of a text and its words, which are separated by blanks. Refers to the text.
struct WordLine {
    std::size_t number = 0;  ///< from 1
    std::string_view text;   ///< without what surrounds it
    std::vector<std::string_view> words;

    /// "line 12"
    std::string where() const;
    /// From the given word to the end of the line, as it stands; empty when there are fewer words.
    std::string_view rest(std::size_t first_word) const;
};

/// Goes through the lines that have a word.
class WordLines {
   public:
    explicit WordLines(std::string_view text) : at_(text) {}
    /// The next one, or false at the end of the text.
    bool next(WordLine& line);

   private:
    TextLines::Iterator at_;
};

}  // namespace ghostlight
