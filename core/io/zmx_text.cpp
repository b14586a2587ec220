#include "core/io/zmx_text.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/export_steps.h"
#include "core/io/import_notes.h"
#include "core/io/text_lines.h"

namespace ghostlight {
namespace {

constexpr std::size_t terms_of_an_even_asphere = 7;  ///< r⁴ to r¹⁶; PARM 1 is r²

std::string glass_line(std::size_t number, const ZmxRow& row, Notes& notes) {
    if (row.mirror) return "  GLAS MIRROR 0 0 1.5 40 0 0 0 0 0 0\n";
    if (row.medium == nullptr || is_air(*row.medium)) return {};
    const ExportedGlass glass = exported_glass(*row.medium);
    const std::string where = fmt::format("surface {}", number);
    const std::string name = row.medium->name.empty() ? "___BLANK" : one_word(row.medium->name);
    if (!glass.nd)
        note_left_out(
            notes, where,
            fmt::format("glass {} has no index that could be written", in_quotes(row.medium->name)),
            true, "name a glass");
    else if (!glass.catalogued && !glass.model)
        note_converted(notes, where,
                       fmt::format("glass {}: its formula does not fit into the format; written by "
                                   "name with nd and Vd",
                                   in_quotes(row.medium->name)),
                       true, "give the other program the glass's catalogue");
    // 1: a model glass of these numbers; 0: the catalogue's, the numbers are for who lacks it.
    const int kind = glass.model && !glass.catalogued ? 1 : 0;
    return fmt::format("  GLAS {} {} 0 {} {} 0 0 0 0 0 0\n", name, kind,
                       exact(glass.nd.value_or(0.0)), exact(glass.vd.value_or(0.0)));
}

std::string terms_text(const std::vector<double>& terms) {
    std::string text;
    if (terms.size() <= terms_of_an_even_asphere) {
        text += "  PARM 1 0\n";
        for (std::size_t i = 0; i < terms.size(); ++i)
            text += fmt::format("  PARM {} {}\n", i + 2, exact(terms[i]));
        return text;
    }
    // Extended asphere: how many, the normalising radius, then r², r⁴, ….
    text += fmt::format("  XDAT 1 {}\n  XDAT 2 1\n  XDAT 3 0\n", terms.size() + 1);
    for (std::size_t i = 0; i < terms.size(); ++i)
        text += fmt::format("  XDAT {} {}\n", i + 4, exact(terms[i]));
    return text;
}

}  // namespace

std::string zmx_surface_text(std::size_t number, const ZmxRow& row, Notes& notes) {
    static const Surface plane;
    const Surface& surface = row.surface != nullptr ? *row.surface : plane;
    std::string text = fmt::format("SURF {}\n", number);
    if (row.stop) text += "  STOP\n";
    text += fmt::format("  TYPE {}\n", surface.aspheric.empty() ? "STANDARD"
                                       : surface.aspheric.size() <= terms_of_an_even_asphere
                                           ? "EVENASPH"
                                           : "XASPHERE");
    text += fmt::format("  CURV {} 0 0 0 0 \"\"\n", exact(curvature_per_mm(surface.curve)));
    if (!row.comment.empty()) text += "  COMM " + one_line(row.comment) + "\n";
    if (!surface.aspheric.empty()) text += terms_text(surface.aspheric);
    text += "  DISZ " + exact(row.thickness_mm) + "\n";
    if (surface.conic != 0.0) text += "  CONI " + exact(surface.conic) + "\n";
    text += glass_line(number, row, notes);
    text +=
        fmt::format("  DIAM {} {} 0 0 1 \"\"\n", exact(row.semi_diameter_mm), row.sized ? 0 : 1);
    return text;
}

std::string zmx_header_text(const Prescription& lens, std::string_view aperture_line,
                            double half_field_deg) {
    std::string text = "VERS 140730 0 0\nMODE SEQ\nNAME " + one_line(lens.name) + "\n";
    for (const std::string* remark : {&lens.source, &lens.notes})
        for (const TextLine& line : text_lines(*remark))
            if (!line.text.empty()) text += "NOTE 0 " + std::string(line.text) + "\n";
    text += fmt::format(
        "UNIT MM X W X CM MR CPMM\n{}\nENVD 20 1 0\nGCAT SCHOTT OHARA HOYA CDGM HIKARI SUMITA\n"
        "FTYP 0 0 3 3 0 0 0\nXFLN 0 0 0\nYFLN 0 {} {}\nFWGN 1 1 1\n",
        aperture_line, exact(0.7 * half_field_deg), exact(half_field_deg));
    return text + "WAVM 1 0.4861327 1\nWAVM 2 0.5875618 1\nWAVM 3 0.6562725 1\nPWAV 2\n";
}

std::string zmx_object_text() {
    return "SURF 0\n  TYPE STANDARD\n  CURV 0 0 0 0 0 \"\"\n  DISZ INFINITY\n"
           "  DIAM 0 0 0 0 1 \"\"\n";
}

std::string zmx_image_text(std::size_t number, const Sensor& sensor) {
    return fmt::format(
        "SURF {}\n  TYPE STANDARD\n  CURV 0 0 0 0 0 \"\"\n  DISZ 0\n  DIAM {} 1 0 0 1 \"\"\n"
        "  SQAP {} {} 0 0 0 0 0\n",
        number, exact(0.5 * std::hypot(sensor.width_mm, sensor.height_mm)),
        exact(0.5 * sensor.width_mm), exact(0.5 * sensor.height_mm));
}

}  // namespace ghostlight
