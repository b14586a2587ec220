#include "core/io/import_notes.h"

#include <fmt/format.h>

#include <utility>

#include "core/io/text_lines.h"

namespace ghostlight {
namespace {

/// Enough to see what kind of words they are.
constexpr std::size_t most_unused_words = 100;

void add(Notes& notes, Note::Fate fate, std::string where, std::string text, bool matters,
         std::string proposal) {
    Note note;
    note.severity = matters ? Note::Severity::warning : Note::Severity::info;
    note.where = std::move(where);
    note.text = std::move(text);
    note.fate = fate;
    note.matters_for_flare = matters;
    note.proposal = std::move(proposal);
    notes.push_back(std::move(note));
}

}  // namespace

void note_read(Notes& notes, std::string where, std::string text) {
    add(notes, Note::Fate::read, std::move(where), std::move(text), false, {});
}
void note_converted(Notes& notes, std::string where, std::string text, bool matters,
                    std::string proposal) {
    add(notes, Note::Fate::converted, std::move(where), std::move(text), matters,
        std::move(proposal));
}
void note_assumed(Notes& notes, std::string where, std::string text, bool matters,
                  std::string proposal) {
    add(notes, Note::Fate::assumed, std::move(where), std::move(text), matters,
        std::move(proposal));
}
void note_left_out(Notes& notes, std::string where, std::string text, bool matters,
                   std::string proposal) {
    add(notes, Note::Fate::left_out, std::move(where), std::move(text), matters,
        std::move(proposal));
}
void note_noticed(Notes& notes, std::string where, std::string text, bool matters,
                  std::string proposal) {
    add(notes, Note::Fate::noticed, std::move(where), std::move(text), matters,
        std::move(proposal));
}
void note_to_mend(Notes& notes, std::string where, std::string text, std::string proposal) {
    add(notes, Note::Fate::noticed, std::move(where), std::move(text), true, std::move(proposal));
    notes.back().severity = Note::Severity::error;
}

void UnusedWords::add(std::string_view word, const std::string& where) {
    std::string short_word = clipped(word, 60);
    if (const auto known = words_.find(short_word); known != words_.end()) {
        ++known->second.count;
    } else if (words_.size() < most_unused_words) {
        words_.emplace(std::move(short_word), Use{where, 1});
    } else {
        ++more_;
    }
}

void UnusedWords::report(Notes& notes) const {
    for (const auto& [word, use] : words_)
        note_left_out(notes, use.first,
                      fmt::format("{} is not used{}", in_quotes(word),
                                  use.count > 1 ? fmt::format(" ({} times)", use.count) : ""));
    if (more_ > 0) note_left_out(notes, {}, fmt::format("{} further words are not used", more_));
}

}  // namespace ghostlight
