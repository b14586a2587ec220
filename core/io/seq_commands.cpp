#include "core/io/seq_commands.h"

#include <fmt/format.h>

#include "core/io/text_lines.h"

namespace ghostlight {
namespace {

/// Collects the words of the current command, from line to line.
class Commands {
   public:
    explicit Commands(const std::function<void(const SeqCommand&)>& visit) : visit_(visit) {}

    /// The command that the text ends in.
    void end() {
        if (current_.empty()) return;
        SeqCommand command;
        command.where = fmt::format("line {}", number_);
        command.name = current_.front().quoted ? "'" + current_.front().text
                                               : upper_case(current_.front().text);
        command.words.assign(std::make_move_iterator(current_.begin() + 1),
                             std::make_move_iterator(current_.end()));
        if (current_.front().quoted) command.words.insert(command.words.begin(), current_.front());
        current_.clear();
        visit_(command);
    }

    void add(const TextLine& line) {
        if (current_.empty()) number_ = line.number;
        std::string_view text = line.text;
        bool continued = false;
        std::size_t i = 0;
        while (i < text.size()) {
            const char c = text[i];
            if (c == '!') break;
            if (c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == ',') {
                ++i;
            } else if (c == ';') {
                end();
                number_ = line.number;
                ++i;
            } else if (c == '&') {
                continued = true;
                ++i;
            } else if (c == '\'' || c == '"') {
                i = quoted(text, i);
            } else {
                std::size_t last = i;
                // L'A' and S'label' keep their quotes' text: one word.
                while (last < text.size() &&
                       std::string_view(" \t\v\f,;!&").find(text[last]) == std::string_view::npos) {
                    if (text[last] == '\'' || text[last] == '"') {
                        const std::size_t close = text.find(text[last], last + 1);
                        last = close == text.npos ? text.size() : close + 1;
                    } else {
                        ++last;
                    }
                }
                current_.push_back({std::string(text.substr(i, last - i)), false});
                i = last;
            }
        }
        if (!continued) end();
    }

   private:
    std::size_t quoted(std::string_view text, std::size_t begin) {
        const char quote = text[begin];
        std::size_t close = text.find(quote, begin + 1);
        // ""name"" and '"name"': quotes around quotes.
        if (close == begin + 1 && close + 1 < text.size() && text[close + 1] != ' ' &&
            text[close + 1] != ';') {
            const std::size_t inner = text.find(quote, close + 1);
            const std::size_t end_of_inner = inner == text.npos ? text.size() : inner;
            current_.push_back(
                {std::string(text.substr(close + 1, end_of_inner - close - 1)), true});
            std::size_t after = end_of_inner;
            while (after < text.size() && text[after] == quote) ++after;
            return after;
        }
        if (close == text.npos) close = text.size();
        std::string_view inside = text.substr(begin + 1, close - begin - 1);
        if (inside.size() >= 2 && (inside.front() == '"' || inside.front() == '\'') &&
            inside.front() == inside.back())
            inside = inside.substr(1, inside.size() - 2);
        current_.push_back({std::string(inside), true});
        return close + 1;
    }

    const std::function<void(const SeqCommand&)>& visit_;
    std::vector<SeqWord> current_;
    std::size_t number_ = 0;
};

}  // namespace

void for_each_seq_command(std::string_view text,
                          const std::function<void(const SeqCommand&)>& visit) {
    Commands commands(visit);
    for (const TextLine& line : text_lines(text)) commands.add(line);
    commands.end();
}

}  // namespace ghostlight
