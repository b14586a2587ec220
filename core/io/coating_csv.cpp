#include "core/io/coating_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/io/read_text.h"
#include "core/io/same_name.h"
#include "core/io/word_lines.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr std::size_t most_rows = 200'000;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view around = " \t\r\"";
    const auto first = text.find_first_not_of(around);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(around) - first + 1);
}

std::vector<std::string_view> cells(std::string_view line, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const auto end = line.find(separator);
        parts.push_back(trimmed(line.substr(0, end)));
        if (end == line.npos) return parts;
        line.remove_prefix(end + 1);
    }
}

/// Which column holds what, and by what to multiply it.
struct Column {
    enum class Kind { wavelength, angle, r, r_s, r_p, t, t_s, t_p, ignored };
    Kind kind = Kind::ignored;
    double scale = 1.0;
};

/// Letters and digits of a column's name alone, in capitals, without its unit.
std::string plain_name(std::string_view name) {
    std::string plain = upper_case(name.substr(0, name.find_first_of("([%")));
    std::erase_if(plain,
                  [](char c) { return !((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')); });
    if (plain.ends_with("PERCENT")) plain.resize(plain.size() - 7);
    return plain;
}

Column column_of(std::string_view name) {
    const std::string upper = upper_case(name);
    const std::string plain = plain_name(name);
    const bool percent = upper.find('%') != upper.npos || upper.find("PERCENT") != upper.npos;
    const double share = percent ? 0.01 : 1.0;
    using Kind = Column::Kind;
    if (plain.starts_with("WAVELENGTH") || plain == "NM" || plain == "UM") {
        const bool um = upper.find("UM") != upper.npos || upper.find("µM") != upper.npos ||
                        upper.find("MICRO") != upper.npos;
        return {Kind::wavelength, um ? nm_from_um(1.0) : 1.0};
    }
    if (plain.starts_with("ANGLE") || plain.starts_with("AOI")) return {Kind::angle, 1.0};
    static const std::map<std::string, Kind> names{
        {"R", Kind::r},    {"REFLECTANCE", Kind::r},
        {"RS", Kind::r_s}, {"REFLECTANCES", Kind::r_s},
        {"RP", Kind::r_p}, {"REFLECTANCEP", Kind::r_p},
        {"T", Kind::t},    {"TRANSMITTANCE", Kind::t},
        {"TS", Kind::t_s}, {"TRANSMITTANCES", Kind::t_s},
        {"TP", Kind::t_p}, {"TRANSMITTANCEP", Kind::t_p}};
    const auto found = names.find(plain);
    return found == names.end() ? Column{} : Column{found->second, share};
}

class Reader {
   public:
    explicit Reader(const std::filesystem::path& file) : file_(file.string()) {
        table_.name = file.stem().string();
    }

    MeasuredReflectance read(std::string_view text) {
        WordLines lines(text);
        for (WordLine line; lines.next(line);) {
            if (line.text.starts_with('#') || line.text.starts_with('!')) continue;
            if (columns_.empty())
                header(line);
            else
                row(line);
        }
        if (columns_.empty()) refuse({}, "the file is empty", {}, "a line of column names");
        return grid();
    }

   private:
    [[noreturn]] void refuse(const std::string& where, std::string problem, std::string found,
                             std::string expected) const {
        throw Error({.problem = std::move(problem),
                     .file = file_,
                     .where = where,
                     .found = std::move(found),
                     .expected = std::move(expected)});
    }

    bool has(Column::Kind kind) const {
        return std::ranges::any_of(columns_, [&](const Column& c) { return c.kind == kind; });
    }

    void header(const WordLine& line) {
        for (const char candidate : {'\t', ';', ','})
            if (line.text.find(candidate) != line.text.npos) separator_ = candidate;
        for (const std::string_view name : cells(line.text, separator_))
            columns_.push_back(column_of(name));
        using Kind = Column::Kind;
        const bool reflects = has(Kind::r) || (has(Kind::r_s) && has(Kind::r_p));
        if (!has(Kind::wavelength) || !reflects)
            refuse(line.where(), "a column is missing", std::string(line.text.substr(0, 60)),
                   "wavelength_nm, and r or both r_s and r_p");
        if (has(Kind::t_s) != has(Kind::t_p))
            refuse(line.where(), "a column is missing", has(Kind::t_s) ? "t_s" : "t_p",
                   "both t_s and t_p, or t");
    }

    void row(const WordLine& line) {
        const auto parts = cells(line.text, separator_);
        if (parts.size() < columns_.size())
            refuse(line.where(), "too few values", fmt::format("{}", parts.size()),
                   fmt::format("{}", columns_.size()));
        double nm = 0.0, angle_deg = 0.0;
        MeasuredShares shares;
        std::optional<double> t, t_s, t_p;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const Column& column = columns_[i];
            if (column.kind == Column::Kind::ignored) continue;
            const auto number = parse_number(parts[i]);
            if (!number)
                refuse(line.where(), "not a number", std::string(parts[i].substr(0, 40)),
                       "a number with a decimal point");
            const double value = *number * column.scale;
            switch (column.kind) {
                case Column::Kind::wavelength:
                    nm = value;
                    break;
                case Column::Kind::angle:
                    angle_deg = value;
                    break;
                case Column::Kind::r:
                    shares.r_s = shares.r_p = value;
                    break;
                case Column::Kind::r_s:
                    shares.r_s = value;
                    break;
                case Column::Kind::r_p:
                    shares.r_p = value;
                    break;
                case Column::Kind::t:
                    t = value;
                    break;
                case Column::Kind::t_s:
                    t_s = value;
                    break;
                case Column::Kind::t_p:
                    t_p = value;
                    break;
                case Column::Kind::ignored:
                    break;
            }
        }
        shares.t_s = t_s.value_or(t.value_or(1.0 - shares.r_s));
        shares.t_p = t_p.value_or(t.value_or(1.0 - shares.r_p));
        check(line, nm, angle_deg, shares);
        if (!rows_.emplace(std::pair(nm, angle_deg), shares).second)
            refuse(line.where(), "a wavelength and angle are there twice",
                   fmt::format("{} nm, {} degrees", nm, angle_deg), "each once");
        if (rows_.size() > most_rows)
            refuse(line.where(), "the table is too long", {},
                   fmt::format("at most {} rows", most_rows));
    }

    void check(const WordLine& line, double nm, double angle_deg,
               const MeasuredShares& shares) const {
        if (!(nm > 0.0))
            refuse(line.where(), "not a wavelength", fmt::format("{}", nm), "a number above 0");
        if (!(angle_deg >= 0.0 && angle_deg <= 90.0))
            refuse(line.where(), "not an angle", fmt::format("{}", angle_deg), "0 to 90 degrees");
        constexpr double most = 1.0 + 1e-6;  // as printed
        for (const auto& [r, t] :
             {std::pair(shares.r_s, shares.t_s), std::pair(shares.r_p, shares.t_p)})
            if (!(r >= 0.0 && t >= 0.0 && r + t <= most))
                refuse(line.where(), "not a reflectance and transmittance",
                       fmt::format("R {}, T {}", r, t),
                       "shares with R + T ≤ 1 (name the column r_percent if they are percents)");
    }

    MeasuredReflectance grid() {
        if (rows_.empty()) refuse({}, "the table has no rows", {}, "at least one");
        for (const auto& [place, shares] : rows_) {
            if (table_.wavelengths_nm.empty() || table_.wavelengths_nm.back() < place.first)
                table_.wavelengths_nm.push_back(place.first);
            table_.angles_deg.push_back(place.second);
        }
        std::ranges::sort(table_.angles_deg);
        const auto again = std::ranges::unique(table_.angles_deg);
        table_.angles_deg.erase(again.begin(), again.end());
        for (const double nm : table_.wavelengths_nm)
            for (const double angle_deg : table_.angles_deg) {
                const auto found = rows_.find({nm, angle_deg});
                if (found == rows_.end())
                    refuse({}, "the table has a gap",
                           fmt::format("nothing at {} nm and {} degrees", nm, angle_deg),
                           "every angle at every wavelength");
                table_.shares.push_back(found->second);
            }
        return std::move(table_);
    }

    std::string file_;
    MeasuredReflectance table_;
    std::vector<Column> columns_;
    char separator_ = ',';
    std::map<std::pair<double, double>, MeasuredShares> rows_;
};

}  // namespace

MeasuredReflectance measured_from_csv(std::string_view text, const std::filesystem::path& file) {
    return Reader(file).read(text);
}

MeasuredReflectance read_measured_csv(const std::filesystem::path& file) {
    return measured_from_csv(utf8_text(read_text(file)), file);
}

}  // namespace ghostlight
