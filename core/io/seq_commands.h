#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ghostlight {

/// A word of a command; what was in quotes keeps its blanks and is marked.
struct SeqWord {
    std::string text;
    bool quoted = false;
};

/// One command of a .seq: continued lines are joined, those that share a line are apart.
struct SeqCommand {
    std::string name;  ///< in capitals
    std::vector<SeqWord> words;
    std::string where;  ///< "line 12"
};

/// One after the other: a file of megabytes is never held as words.
void for_each_seq_command(std::string_view text,
                          const std::function<void(const SeqCommand&)>& visit);

}  // namespace ghostlight
