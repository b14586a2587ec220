#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ghostlight {

/// One entry of a table: nothing (does not exist for this row), a number, a count, or words.
using Cell = std::variant<std::monostate, double, std::int64_t, std::string>;

/// A table as every command and export shows it. Units are in the columns' names.
struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<Cell>> rows;  ///< each as long as `columns`
};

/// The columns of those names, in that order. Throws Error naming the known ones.
Table select_columns(const Table& table, const std::vector<std::string>& names);

// The forms of a number do not depend on the locale. NaN means that a value does not exist, and is
// treated as an empty cell everywhere.

/// Shortest text that reads back to the same value; "inf" and "-inf"; empty for an empty cell.
std::string exact_text(const Cell& cell);

/// Six significant digits, for people; "-" for an empty cell.
std::string readable_text(const Cell& cell);

/// Columns aligned, numbers to the right, one line of names above.
std::string table_text(const Table& table);

/// One line of names, one line a row, LF endings, quotes where RFC 4180 needs them.
std::string table_csv(const Table& table);

/// An array of objects, one a line. JSON has no infinity: that and empty cells are null.
std::string table_json(const Table& table);

/// A cell or a text as JSON.
std::string json_value(const Cell& cell);
std::string json_string(std::string_view text);

}  // namespace ghostlight
