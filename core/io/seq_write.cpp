#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/io/export_steps.h"
#include "core/io/import_notes.h"
#include "core/io/seq.h"
#include "core/io/text_lines.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr std::string_view coefficient_letters = "ABCDEFGHJ";  ///< r⁴ to r²⁰; there is no I
/// Where private glasses are tabulated, nm: h, g, F, e, d, C, r.
constexpr std::array table_nm = {404.6561, 435.8343, 486.1327, 546.0740,
                                 587.5618, 656.2725, 706.5188};

/// Glasses that the program does not know by name or number, as tables at the head of the file.
class PrivateTable {
   public:
    /// The name by which a surface refers to it.
    std::string name_of(const Medium& medium, std::size_t number, Notes& notes) {
        for (const auto& [name, known] : glasses_)
            if (known == medium) return "'" + name + "'";
        std::string name = "GL" + std::to_string(number);
        if (!medium.name.empty()) name = one_word(medium.name).substr(0, 12);
        while (std::ranges::any_of(glasses_, [&](const auto& each) { return each.first == name; }))
            name += "X";
        glasses_.emplace_back(name, medium);
        note_converted(notes, fmt::format("surface {}", number),
                       fmt::format("its glass is written as a table of indices, {}", name));
        return "'" + name + "'";
    }

    std::string text(Notes& notes) const {
        if (glasses_.empty()) return {};
        std::string out = "PRV\nPWL";
        for (const double nm : table_nm) out += " " + exact(nm);
        out += "\n";
        for (const auto& [name, medium] : glasses_) {
            out += "'" + name + "'";
            for (const double nm : table_nm) {
                double n = 1.0;
                try {
                    n = refractive_index(medium, nm);
                } catch (const Error& error) {
                    note_noticed(notes, "glass " + name, error.parts().problem, true,
                                 "its index there is written as 1");
                }
                out += " " + exact(n);
            }
            out += "\n";
        }
        return out + "END\n";
    }

   private:
    std::vector<std::pair<std::string, Medium>> glasses_;
};

/// Digits of a decimal number behind its point, at least `least`; nothing for one with an exponent.
std::optional<std::string> decimals(double value, std::size_t least) {
    std::string text = exact(value);
    if (text.find_first_of("eE") != text.npos) return std::nullopt;
    const std::size_t point = text.find('.');
    std::string digits = point == text.npos ? "" : text.substr(point + 1);
    while (digits.size() < least) digits += '0';
    return digits;
}

/// "516800.641700" for a model glass; nothing where the code cannot hold it.
std::optional<std::string> code_of(const ModelGlass& glass) {
    // A code below 100 means an nd of 2 and more.
    if (!(glass.nd >= 1.1 && glass.nd < 2.0) || !(glass.vd >= 10.0 && glass.vd < 100.0))
        return std::nullopt;
    const auto index = decimals(glass.nd, 3), abbe = decimals(glass.vd, 1);
    if (!index || !abbe) return std::nullopt;
    return *index + "." + std::to_string(static_cast<int>(glass.vd)) + *abbe;
}

std::string letters_and_digits(std::string_view name) {
    std::string plain;
    for (const char c : upper_case(name))
        if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) plain += c;
    return plain;
}

std::string glass_word(const Medium& medium, std::size_t number, PrivateTable& table,
                       Notes& notes) {
    if (is_air(medium)) return {};
    const ExportedGlass glass = exported_glass(medium);
    if (glass.catalogued && !glass.model) {
        const std::string name = letters_and_digits(medium.name);
        return glass.catalog.empty() ? name : name + "_" + letters_and_digits(glass.catalog);
    }
    if (const auto* model = std::get_if<ModelGlass>(&medium.dispersion))
        if (const auto code = code_of(*model)) {
            if (!medium.name.empty())
                note_converted(
                    notes, fmt::format("surface {}", number),
                    fmt::format("glass {}: by the code of its nd and Vd", in_quotes(medium.name)));
            return *code;
        }
    if (std::holds_alternative<UnknownGlass>(medium.dispersion)) {
        note_left_out(
            notes, fmt::format("surface {}", number),
            fmt::format("glass {} has no index that could be written", in_quotes(medium.name)),
            true, "name a glass");
        return letters_and_digits(medium.name);
    }
    return table.name_of(medium, number, notes);
}

std::string shape_text(const Surface& surface, std::size_t number, Notes& notes) {
    if (surface.aspheric.empty())
        return surface.conic == 0.0 ? "" : "  CON\n  K " + exact(surface.conic) + "\n";
    std::string text = "  ASP\n  K " + exact(surface.conic) + "\n";
    for (std::size_t i = 0; i < std::min(surface.aspheric.size(), coefficient_letters.size()); ++i)
        text += fmt::format("  {} {}\n", coefficient_letters[i], exact(surface.aspheric[i]));
    if (surface.aspheric.size() > coefficient_letters.size())
        note_left_out(notes, fmt::format("surface {}", number),
                      "aspheric terms beyond r^20, which ASP does not have", true,
                      "expect another shape towards the rim");
    return text;
}

std::string zoom_text(const Prescription& lens, Notes& notes) {
    const std::size_t count = lens.configurations.size();
    if (count == 0) return {};
    std::string text = fmt::format("ZOO {}\nZOO TIT\n", count);
    for (std::size_t i = 0; i < count; ++i)
        text += fmt::format("TIT Z{} '{}'\n", i + 1, one_line(lens.configurations[i].name));
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const auto own = [&](const Configuration& each) { return each.thickness_mm.find(row); };
        if (std::ranges::none_of(lens.configurations, [&](const Configuration& each) {
                return each.thickness_mm.contains(row);
            }))
            continue;
        text += fmt::format("ZOO THI S{}", row + 1);
        for (const Configuration& each : lens.configurations)
            text +=
                " " + exact(own(each) != each.thickness_mm.end() ? own(each)->second
                                                                 : lens.surfaces[row].thickness_mm);
        text += "\n";
    }
    const bool any_f_number = std::ranges::any_of(
        lens.configurations, [](const Configuration& each) { return each.f_number.has_value(); });
    if (by_entrance_pupils(lens)) {
        text += "ZOO EPD";
        for (const Configuration& each : lens.configurations)
            text +=
                " " + exact(entrance_pupil_diameter_mm(configured(lens, each.name)).value_or(0.0));
        text += "\n";
    } else if (any_f_number && lens.stop.f_number) {
        text += "ZOO FNO";
        for (const Configuration& each : lens.configurations)
            text += " " + exact(each.f_number.value_or(*lens.stop.f_number));
        text += "\n";
    } else if (any_f_number) {
        note_left_out(notes, "configurations", "their f-numbers: the lens as listed has none",
                      true);
    }
    note_converted(notes, "configurations",
                   "the rows hold the lens as listed; the other program shows its first zoom "
                   "position instead");
    return text;
}

}  // namespace

std::string write_seq(const Prescription& lens, Notes& notes) {
    PrivateTable table;
    std::string rows;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const Surface& surface = lens.surfaces[row];
        const double curvature = curvature_per_mm(surface.curve);
        const bool is_last = row + 1 == lens.surfaces.size();
        const std::string glass = glass_word(surface.medium_after, row + 1, table, notes);
        rows += fmt::format("S {} {}{}{}\n", curvature == 0.0 ? "0" : exact(1.0 / curvature),
                            exact(is_last ? sensor_distance_mm(lens) : surface.thickness_mm),
                            glass.empty() ? "" : " ", glass);
        if (!surface.comment.empty()) rows += "  SLB \"" + one_line(surface.comment) + "\"\n";
        rows += shape_text(surface, row + 1, notes);
        if (row == lens.stop.surface) rows += "  STO\n";
        // A size that is the program's own is not an aperture of the file.
        if (!surface.semi_diameter_sized) rows += "  CIR " + exact(surface.semi_diameter_mm) + "\n";
        if (is_last && lens.sensor.at_paraxial_focus) rows += "  PIM\n";
    }
    std::string text = "RDM;LEN\n";
    for (const std::string* remark : {&lens.source, &lens.notes})
        for (const TextLine& line : text_lines(*remark))
            if (!line.text.empty()) text += "! " + std::string(line.text) + "\n";
    text += "TITLE '" + one_line(lens.name) + "'\n";
    const auto pupil = entrance_pupil_diameter_mm(lens);
    if (lens.stop.f_number)
        text += "FNO " + exact(*lens.stop.f_number) + "\n";
    else if (pupil)
        text += "EPD " + exact(*pupil) + "\n";
    else
        note_left_out(notes, "stop", "the aperture: the lens has no entrance pupil", true);
    if (!lens.stop.f_number && pupil)
        note_converted(
            notes, "stop",
            fmt::format("its radius is written as an entrance pupil {} mm wide", exact(*pupil)));
    const double field = exported_half_field_deg(lens);
    text += fmt::format(
        "DIM M\nWL 656.2725 587.5618 486.1327\nREF 2\nWTW 1 1 1\nXAN 0 0 0\n"
        "YAN 0 {} {}\n",
        exact(0.7 * field), exact(field));
    text +=
        table.text(notes) + "SO 0 0.1e14\n" + rows + "SI 0 0\n" + zoom_text(lens, notes) + "GO\n";
    note_left_behind(lens, "CODE V", notes);
    note_converted(notes, "sensor", "its size, as the field up to its corner");
    return text;
}

}  // namespace ghostlight
