#include "app/cli/ray_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "app/cli/options.h"
#include "core/error.h"

namespace ghostlight::cli {
namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    for (;;) {
        const auto comma = line.find(',');
        fields.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return fields;
        line.remove_prefix(comma + 1);
    }
}

struct Columns {
    std::size_t px = 0, py = 0;
};

std::optional<Columns> columns_of(const std::vector<std::string_view>& names) {
    const auto px = std::find(names.begin(), names.end(), "px_mm");
    const auto py = std::find(names.begin(), names.end(), "py_mm");
    if (px == names.end() || py == names.end()) return std::nullopt;
    return Columns{static_cast<std::size_t>(px - names.begin()),
                   static_cast<std::size_t>(py - names.begin())};
}

// A line of someone's file in a message: not all of it if it is endless.
std::string quoted(std::string_view text) {
    constexpr std::size_t most = 60;
    return text.size() <= most ? fmt::format("'{}'", text)
                               : fmt::format("'{}...'", text.substr(0, most));
}

}  // namespace

std::vector<glm::dvec2> rays_from_csv(std::string_view text, const std::string& file) {
    constexpr std::string_view header = "a header line with px_mm,py_mm";
    const auto fail = [&](std::size_t line, std::string problem, std::string_view found,
                          std::string_view expected) {
        return Error({.problem = std::move(problem),
                      .file = file,
                      .where = fmt::format("line {}", line),
                      .found = quoted(found),
                      .expected = std::string(expected)});
    };
    if (text.starts_with("\xEF\xBB\xBF"))  // spreadsheets write a byte order mark
        text.remove_prefix(3);

    std::optional<Columns> columns;
    std::vector<glm::dvec2> rays;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const auto end = text.find('\n');
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (line.empty() || line.starts_with('#')) continue;
        const auto fields = fields_of(line);
        if (!columns) {
            columns = columns_of(fields);
            if (!columns) throw fail(number, "not a list of rays", line, header);
            continue;
        }
        const auto value = [&](std::size_t column, std::string_view name) {
            if (column >= fields.size())
                throw fail(number, fmt::format("{} is missing", name), line, "a number in mm");
            const auto parsed = parse_number(fields[column]);
            if (!parsed)
                throw fail(number, fmt::format("{} is not a number", name), fields[column],
                           "a number in mm");
            return *parsed;
        };
        if (rays.size() == max_rays)
            throw fail(number, "too many rays", line, fmt::format("at most {}", max_rays));
        const double px = value(columns->px, "px_mm"), py = value(columns->py, "py_mm");
        rays.emplace_back(px, py);
    }
    if (!columns)
        throw Error({.problem = "no rays",
                     .file = file,
                     .where = {},
                     .found = "nothing",
                     .expected = std::string(header)});
    return rays;
}

}  // namespace ghostlight::cli
