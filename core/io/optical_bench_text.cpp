#include "core/io/optical_bench_text.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/io/import_notes.h"

namespace ghostlight {
namespace {

constexpr std::size_t most_positions = 200;
constexpr std::string_view row_expected =
    "id, radius, thickness, nd, diameter, Vd between tabs, nd and Vd empty for air";

/// Cells between tabs, without the empty ones that trail.
std::vector<std::string_view> cells(std::string_view line) {
    std::vector<std::string_view> found;
    while (true) {
        const std::size_t tab = line.find('\t');
        found.push_back(trimmed(line.substr(0, tab)));
        if (tab == line.npos) break;
        line.remove_prefix(tab + 1);
    }
    while (!found.empty() && found.back().empty()) found.pop_back();
    return found;
}

std::string_view cell(const std::vector<std::string_view>& row, std::size_t i) {
    return i < row.size() ? row[i] : std::string_view{};
}

std::optional<double> optional_value(std::string_view word, const Place& place,
                                     std::string_view expected) {
    if (word.empty() || is_same_name(word, "undefined")) return std::nullopt;
    return place.number(word, expected);
}

/// Rows whose tabs were lost on the way: blanks separate, and the number of words tells.
std::vector<std::string_view> cells_of_words(const std::vector<std::string_view>& row) {
    if (row.size() == 4) return {row[0], row[1], row[2], {}, row[3]};
    return row;
}

struct Reader {
    const std::string& file;
    Notes& notes;
    BenchText text = {};
    UnusedWords unused = {};
    std::string section = {};
    bool disabled = false;

    void enter(std::string_view line, const Place& place);
    void read(std::string_view line, const Place& place);
    void read_constant(const std::vector<std::string_view>& row, const Place& place);
    void read_variable(const std::vector<std::string_view>& row, const Place& place);
    void read_surface(std::string_view line, const Place& place);
    void read_asphere(std::string_view line, const Place& place);
};

void Reader::enter(std::string_view line, const Place& place) {
    line = line.substr(1, line.find(']') - 1);
    disabled = line.starts_with('!');
    if (disabled) line.remove_prefix(1);
    section = upper_case(trimmed(line));
    const bool optical = section == "LENS DATA" || section == "ASPHERICAL DATA" ||
                         section == "VARIABLE DISTANCES" || section == "CONSTANTS";
    if (disabled)
        note_left_out(notes, place.where,
                      fmt::format("the section {} is disabled in the file (!)", in_quotes(section)),
                      optical);
    else if (!optical && section != "DESCRIPTIVE DATA" && section != "FIGURE" &&
             section != "NOTES" && section != "METADATA" && section != "PATENT INFO" &&
             section != "REPORT DATA" && section != "GROUP DATA")
        note_left_out(notes, place.where,
                      fmt::format("the section {} is not known", in_quotes(section)));
}

void Reader::read_constant(const std::vector<std::string_view>& row, const Place& place) {
    if (is_same_name(row[0], "AsphericalOddCount")) {
        constexpr std::string_view expected = "a count of odd terms, 0 to 20";
        const double count = place.number(cell(row, 1), expected);
        if (!(count >= 0.0 && count <= 20.0) || count != std::floor(count))
            place.refuse("not a usable count", fmt::format("{}", count), expected);
        text.odd_terms = static_cast<int>(count);
    } else if (is_same_name(row[0], "AsphericalA2")) {
        text.has_square_term = true;
    } else if (is_same_name(row[0], "Scaled")) {
        note_noticed(notes, place.where,
                     fmt::format("the listing is scaled from its source by {} {}", cell(row, 1),
                                 cell(row, 2)));
    } else {
        unused.add(row[0], place.where);
    }
}

void Reader::read_variable(const std::vector<std::string_view>& row, const Place& place) {
    if (text.variables.size() >= 2000)
        place.refuse("too many variable distances", "a further row", "at most 2000");
    BenchVariable variable{place, {}};
    if (row.size() > most_positions)
        place.refuse("too many positions", fmt::format("{}", row.size() - 1), "at most 200");
    for (std::size_t i = 1; i < row.size(); ++i) {
        std::optional<double> value;
        if (is_same_name(row[i], "Infinity"))
            value = std::numeric_limits<double>::infinity();
        else if (is_same_name(row[i], "-Infinity"))
            value = -std::numeric_limits<double>::infinity();
        else if (const auto other = text.variables.find(std::string(row[i]));
                 other != text.variables.end() && i - 1 < other->second.values.size())
            value = other->second.values[i - 1];
        else
            value = optional_value(row[i], place, "a number, Infinity or undefined");
        variable.values.push_back(value);
    }
    text.variables[std::string(row[0])] = std::move(variable);
}

void Reader::read_surface(std::string_view line, const Place& place) {
    auto row = cells(line);
    if (row.size() < 3) row = cells_of_words(words(line));
    if (row.size() < 3)
        place.refuse("the row is too short", fmt::format("{} cells", row.size()), row_expected);
    if (text.surfaces.size() >= 1000)
        place.refuse("the lens has too many surfaces", "a further row", "at most 1000");
    BenchSurface surface;
    surface.place = place;
    surface.id = row[0];
    surface.radius = row[1];
    surface.thickness = row[2];
    surface.nd = optional_value(cell(row, 3), place, "an index, or nothing for air");
    surface.diameter_mm = optional_value(cell(row, 4), place, "a diameter in mm");
    const std::string_view sixth = cell(row, 5);
    // Some rows have the glass's name where Vd belongs.
    if (sixth.empty() || parse_number(sixth) || is_same_name(sixth, "undefined"))
        surface.vd = optional_value(sixth, place, "an Abbe number");
    else
        surface.glass = clipped(sixth, 60);
    if (!cell(row, 6).empty()) surface.glass = clipped(row[6], 60);
    text.surfaces.push_back(std::move(surface));
}

void Reader::read_asphere(std::string_view line, const Place& place) {
    auto row = cells(line);
    if (row.size() < 2) row = words(line);
    constexpr std::string_view expected = "id, radius, k and coefficients between tabs";
    if (row.size() < 2)
        place.refuse("the row is too short", fmt::format("{} cells", row.size()), expected);
    if (text.aspheres.size() >= 1000)
        place.refuse("too many aspheres", "a further row", "at most one for each surface");
    BenchAsphere asphere;
    asphere.place = place;
    asphere.id = row[0];
    if (!is_same_name(row[1], "Infinity") && !is_same_name(row[1], "-Infinity"))
        asphere.radius_mm = optional_value(row[1], place, "a radius");
    asphere.conic = optional_value(cell(row, 2), place, "a conic constant").value_or(0.0);
    for (std::size_t i = 3; i < row.size(); ++i)
        asphere.terms.push_back(optional_value(row[i], place, "a coefficient").value_or(0.0));
    text.aspheres.push_back(std::move(asphere));
}

void Reader::read(std::string_view line, const Place& place) {
    const std::string_view plain = trimmed(line);
    if (plain.empty() || plain.starts_with('#')) return;
    if (plain.starts_with('[')) return enter(plain, place);
    if (disabled) return;
    const auto row = cells(line);
    if (section == "DESCRIPTIVE DATA") {
        if (is_same_name(row[0], "title"))
            text.title = clipped(cell(row, 1), 300);
        else
            unused.add(row[0], place.where);
    } else if (section == "CONSTANTS") {
        read_constant(row, place);
    } else if (section == "VARIABLE DISTANCES") {
        read_variable(row, place);
    } else if (section == "LENS DATA") {
        read_surface(line, place);
    } else if (section == "ASPHERICAL DATA") {
        read_asphere(line, place);
    } else if (section == "NOTES" || section == "METADATA" || section == "PATENT INFO") {
        constexpr std::size_t longest = 4000;
        if (text.remarks.size() < longest)
            text.remarks += (text.remarks.empty() ? "" : "\n") + clipped(plain, 500);
    }
}

}  // namespace

const BenchVariable* BenchText::variable(std::string_view name) const {
    if (const auto exact = variables.find(std::string(name)); exact != variables.end())
        return &exact->second;
    for (const auto& [full, row] : variables)
        if (full.size() > name.size() &&
            is_same_name(std::string_view(full).substr(0, name.size()), name) &&
            trimmed(std::string_view(full).substr(name.size())).starts_with('('))
            return &row;
    return nullptr;
}

std::optional<double> value_in(const BenchVariable* variable, std::size_t position) {
    if (variable == nullptr || variable->values.empty()) return std::nullopt;
    if (variable->values.size() == 1) return variable->values[0];
    return position < variable->values.size() ? variable->values[position] : std::nullopt;
}

BenchText read_bench_text(std::string_view text, const std::string& file, Notes& notes) {
    Reader reader{file, notes};
    for (const TextLine& line : text_lines(text))
        reader.read(line.text, {file, fmt::format("line {}", line.number)});
    reader.unused.report(notes);
    if (reader.text.surfaces.empty())
        Place{file, {}}.refuse("the lens has no surfaces", "no rows in [lens data]",
                               std::string(row_expected));
    return std::move(reader.text);
}

}  // namespace ghostlight
