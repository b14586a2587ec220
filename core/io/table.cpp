#include "core/io/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"

namespace ghostlight {
namespace {

bool is_empty(const Cell& cell) {
    const double* number = std::get_if<double>(&cell);
    return std::holds_alternative<std::monostate>(cell) || (number && std::isnan(*number));
}

template <typename T>
std::string shortest(T value) {
    char buffer[32];  // the longest double has 24 characters
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    return {buffer, end};
}

std::string csv_field(const Cell& cell) {
    std::string text = exact_text(cell);
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

// Columns of a terminal that a UTF-8 text takes; good enough without wide characters.
std::size_t width(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }));
}

// Length of the valid UTF-8 sequence at the start of `text`, or 0.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xC2 ? 0
                               : lead < 0xE0 ? 2
                               : lead < 0xF0 ? 3
                               : lead < 0xF5 ? 4
                                             : 0;
    if (length == 0 || length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    if (length > 2) {  // overlong forms, surrogates, beyond U+10FFFF
        const unsigned char second = byte(1);
        if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
            (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F))
            return 0;
    }
    return length;
}

}  // namespace

Table select_columns(const Table& table, const std::vector<std::string>& names) {
    std::vector<std::size_t> places;
    for (const std::string& name : names) {
        const auto at = std::ranges::find(table.columns, name);
        if (at == table.columns.end())
            throw Error({.problem = "there is no such column",
                         .file = {},
                         .where = {},
                         .found = fmt::format("'{}'", name),
                         .expected = fmt::format("{}", fmt::join(table.columns, ", "))});
        places.push_back(static_cast<std::size_t>(at - table.columns.begin()));
    }
    Table selected{.columns = names, .rows = {}};
    for (const auto& row : table.rows) {
        std::vector<Cell>& cells = selected.rows.emplace_back();
        for (const std::size_t place : places) cells.push_back(row[place]);
    }
    return selected;
}

std::string exact_text(const Cell& cell) {
    if (is_empty(cell)) return {};
    if (const auto* number = std::get_if<double>(&cell)) return shortest(*number);
    if (const auto* count = std::get_if<std::int64_t>(&cell)) return shortest(*count);
    return std::get<std::string>(cell);
}

std::string readable_text(const Cell& cell) {
    if (is_empty(cell)) return "-";
    if (const auto* number = std::get_if<double>(&cell))
        return fmt::format("{:.6g}", *number == 0.0 ? 0.0 : *number);  // no "-0"
    return exact_text(cell);
}

std::string table_text(const Table& table) {
    const std::size_t columns = table.columns.size();
    std::vector<std::size_t> widths(columns);
    std::vector<bool> left(columns, false);
    for (std::size_t c = 0; c < columns; ++c) widths[c] = width(table.columns[c]);
    for (const auto& row : table.rows)
        for (std::size_t c = 0; c < columns; ++c) {
            widths[c] = std::max(widths[c], width(readable_text(row[c])));
            left[c] = left[c] || std::holds_alternative<std::string>(row[c]);
        }

    std::string text;
    const auto add = [&](std::size_t c, const std::string& entry) {
        const std::string padding(widths[c] - width(entry), ' ');
        if (c > 0) text += "  ";
        if (!left[c]) text += padding;
        text += entry;
        if (left[c] && c + 1 < columns) text += padding;
    };
    for (std::size_t c = 0; c < columns; ++c) add(c, table.columns[c]);
    text += '\n';
    for (const auto& row : table.rows) {
        for (std::size_t c = 0; c < columns; ++c) add(c, readable_text(row[c]));
        text += '\n';
    }
    return text;
}

std::string table_csv(const Table& table) {
    std::string text;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        if (c > 0) text += ',';
        text += csv_field(table.columns[c]);
    }
    text += '\n';
    for (const auto& row : table.rows) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            if (c > 0) text += ',';
            text += csv_field(row[c]);
        }
        text += '\n';
    }
    return text;
}

std::string table_json(const Table& table) {
    std::vector<std::string> names;
    for (const auto& column : table.columns) names.push_back(json_string(column));
    std::string text = "[";
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        text += r > 0 ? ",\n  {" : "\n  {";
        for (std::size_t c = 0; c < names.size(); ++c) {
            if (c > 0) text += ", ";
            text += names[c] + ": " + json_value(table.rows[r][c]);
        }
        text += '}';
    }
    return text + (table.rows.empty() ? "]" : "\n]");
}

std::string json_value(const Cell& cell) {
    const auto* number = std::get_if<double>(&cell);
    if (is_empty(cell) || (number && std::isinf(*number))) return "null";
    if (const auto* words = std::get_if<std::string>(&cell)) return json_string(*words);
    return exact_text(cell);
}

std::string json_string(std::string_view text) {
    std::string quoted = "\"";
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const char c = text.front();
        if (length == 0)
            quoted += "\uFFFD";  // not UTF-8: JSON could not hold it
        else if (c == '"' || c == '\\')
            (quoted += '\\') += c;
        else if (c == '\n')
            quoted += "\\n";
        else if (c == '\t')
            quoted += "\\t";
        else if (static_cast<unsigned char>(c) < 0x20)
            quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            quoted += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return quoted + '"';
}

}  // namespace ghostlight
