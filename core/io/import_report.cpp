#include "core/io/import_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "core/io/text_lines.h"

namespace ghostlight {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// The number behind a word, counted from 1 in files and from 0 here.
std::optional<std::size_t> number_behind(std::string_view text, std::string_view word) {
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
        if (at > 0 && is_letter(text[at - 1])) continue;
        const char* begin = text.data() + at + word.size();
        std::size_t number = 0;
        const auto [end, failure] = std::from_chars(begin, text.data() + text.size(), number);
        if (failure == std::errc{} && end != begin && number > 0) return number - 1;
    }
    return std::nullopt;
}

std::optional<std::size_t> named_surface(const Note& note) {
    for (const std::string_view word : {"SURF ", "surfaces[", "lens_elements[", "surface "})
        if (const auto row = number_behind(note.where, word)) return row;
    return number_behind(note.text, "surface ");
}

/// "line 12" of "line 12", "SURF 5 (line 12)" and "line 12, column 3".
std::string line_of(const Note& note) {
    const auto number = number_behind(note.where, "line ");
    return number ? fmt::format("line {}", *number + 1) : std::string();
}

}  // namespace

std::string_view fate_name(Note::Fate fate) {
    switch (fate) {
        case Note::Fate::noticed:
            return "noticed";
        case Note::Fate::read:
            return "read";
        case Note::Fate::converted:
            return "converted";
        case Note::Fate::assumed:
            return "assumed";
        case Note::Fate::left_out:
            return "left out";
    }
    return {};
}

std::string_view severity_name(Note::Severity severity) {
    switch (severity) {
        case Note::Severity::info:
            return "note";
        case Note::Severity::warning:
            return "warning";
        case Note::Severity::error:
            return "error";
    }
    return {};
}

std::string notes_text(const Notes& notes) {
    std::string text;
    for (const Note& note : notes) {
        const char mark = note.severity == Note::Severity::error ? '!'
                          : note.matters_for_flare               ? '*'
                                                                 : ' ';
        text += fmt::format("{} {}{}{}: {}\n", mark, note.where, note.where.empty() ? "" : ": ",
                            fate_name(note.fate), note.text);
        if (!note.proposal.empty()) text += fmt::format("      -> {}\n", note.proposal);
    }
    return text;
}

std::optional<std::size_t> surface_of(const Note& note, const Notes& notes,
                                      const Prescription& lens) {
    const auto in_lens = [&](std::optional<std::size_t> row) {
        return row && *row < lens.surfaces.size() ? row : std::nullopt;
    };
    if (const auto row = in_lens(named_surface(note))) return row;
    if (note.severity == Note::Severity::error)
        for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
            const Medium& medium = lens.surfaces[row].medium_after;
            if (std::holds_alternative<UnknownGlass>(medium.dispersion) && !medium.name.empty() &&
                note.text.find(in_quotes(medium.name)) != std::string::npos)
                return row;
        }
    const std::string line = line_of(note);
    if (line.empty()) return std::nullopt;
    const auto beside = std::ranges::find_if(
        notes, [&](const Note& other) { return line_of(other) == line && named_surface(other); });
    return beside == notes.end() ? std::nullopt : in_lens(named_surface(*beside));
}

}  // namespace ghostlight
