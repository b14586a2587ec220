#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/same_name.h"

namespace ghostlight {

/// One line of a text, without its ending. Lines count from 1.
struct TextLine {
    std::size_t number = 0;
    std::string_view text;
};

/// The lines of a text that ends them by "\n", "\r\n" or "\r", one after the other.
class TextLines {
   public:
    class Iterator {
       public:
        explicit Iterator(std::string_view rest) : rest_(rest) { advance(); }
        const TextLine& operator*() const { return line_; }
        Iterator& operator++() {
            advance();
            return *this;
        }
        bool operator==(std::default_sentinel_t) const { return ended_; }

       private:
        void advance();

        std::string_view rest_;
        TextLine line_;
        bool ended_ = false;
    };

    explicit TextLines(std::string_view text) : text_(text) {}
    Iterator begin() const { return Iterator(text_); }
    std::default_sentinel_t end() const { return {}; }

   private:
    std::string_view text_;
};
inline TextLines text_lines(std::string_view text) { return TextLines(text); }

/// What blanks and tabs separate.
std::vector<std::string_view> words(std::string_view text);

std::string_view trimmed(std::string_view text);

/// At most so many bytes of a UTF-8 text, whole characters only.
std::string clipped(std::string_view text, std::size_t bytes);

/// A finite decimal number in the C locale, whatever the program's; a leading "+" and an exponent
/// written with D are taken. Nothing for anything else, numbers out of range included.
std::optional<double> parse_number(std::string_view word);

/// Where something stands, for errors and notes.
struct Place {
    std::string file;
    std::string where;  ///< "line 12"

    [[noreturn]] void refuse(std::string_view problem, std::string found,
                             std::string_view expected) const;
    /// The number that a word is; Error with the word and what was expected otherwise.
    double number(std::string_view word, std::string_view expected) const;
};

/// A piece of a file for a message: in quotes, cut to a readable length, valid UTF-8.
std::string in_quotes(std::string_view text);

}  // namespace ghostlight
