#include "core/io/spectrum_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/io/read_text.h"
#include "core/io/same_name.h"
#include "core/io/word_lines.h"

namespace ghostlight {
namespace {

constexpr std::size_t most_entries = 100'000;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& where,
                         std::string problem, std::string found, std::string expected) {
    throw Error({.problem = std::move(problem),
                 .file = file.string(),
                 .where = where,
                 .found = std::move(found),
                 .expected = std::move(expected)});
}

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '"'; }

}  // namespace

TabulatedLight spectrum_from_csv(std::string_view text, const std::filesystem::path& file) {
    std::string plain(text);
    std::ranges::replace_if(
        plain, [](char c) { return c == ',' || c == ';'; }, ' ');
    SpectralTable table;
    std::vector<std::string> places;
    WordLines lines(plain);
    for (WordLine line; lines.next(line);) {
        const char first = line.text.front();
        if (first == '#' || first == '!' || is_letter(first)) continue;
        if (line.words.size() < 2)
            refuse(file, line.where(), "a line with one value",
                   std::string(line.text.substr(0, 40)), "a wavelength in nm and a power");
        const auto nm = parse_number(line.words[0]), power = parse_number(line.words[1]);
        if (!nm || !power)
            refuse(file, line.where(), "not a number",
                   std::string(line.words[nm ? 1 : 0].substr(0, 40)),
                   "a number with a decimal point");
        table.push_back({*nm, *power});
        places.push_back(line.where());
        if (table.size() > most_entries)
            refuse(file, line.where(), "the table is too long", {},
                   fmt::format("at most {} wavelengths", most_entries));
    }
    try {
        return tabulated_light(file.filename().string(), std::move(table));
    } catch (const Error& error) {
        Error::Parts parts = error.parts();
        parts.file = file.string();
        // "entry 3" is of no use in a file with comments.
        if (parts.where.starts_with("entry ")) {
            const auto entry = std::stoul(parts.where.substr(6));
            if (entry >= 1 && entry <= places.size()) parts.where = places[entry - 1];
        }
        throw Error(std::move(parts));
    }
}

TabulatedLight read_spectrum_csv(const std::filesystem::path& file) {
    return spectrum_from_csv(utf8_text(read_text(file)), file);
}

Spectrum spectrum_by_name(std::string_view text) {
    const std::filesystem::path file(text);
    if (is_same_name(file.extension().string(), ".csv")) return read_spectrum_csv(file);
    return parse_spectrum(text);
}

}  // namespace ghostlight
