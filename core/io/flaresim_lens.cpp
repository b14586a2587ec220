#include "core/io/flaresim_lens.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/flaresim_write.h"
#include "core/io/import_notes.h"
#include "core/io/listed_surface.h"
#include "core/io/stated_glass.h"
#include "core/io/stated_heights.h"
#include "core/io/text_lines.h"

namespace ghostlight {
namespace {

constexpr std::string_view row_expected =
    "radius thickness index abbe semi-aperture [coating [type [second radius]]]";

std::optional<std::string_view> value_of(std::string_view line, std::string_view key) {
    if (line.size() <= key.size() || line[key.size()] != ':' ||
        !is_same_name(line.substr(0, key.size()), key))
        return std::nullopt;
    return trimmed(line.substr(key.size() + 1));
}

/// A count of layers, and nothing of what they are.
Coating coating_of(double layers, const Place& place, Notes& notes) {
    if (layers == 0.0) return Uncoated{};
    if (!(layers > 0.0))
        place.refuse("not a usable coating", fmt::format("{}", layers),
                     "a count of layers, 0 for none");
    if (layers != 1.0)
        note_assumed(notes, place.where,
                     fmt::format("the coating has {} layers, but the file does not say which: one "
                                 "quarter-wave layer of MgF2 is taken",
                                 layers),
                     true, "choose the coating");
    return QuarterWave{};
}

void refuse_type(std::string_view type, const Place& place) {
    for (const std::string_view known : {"sph", "spherical"})
        if (is_same_name(type, known)) return;
    const bool is_cylinder = upper_case(type).starts_with("CYL");
    place.refuse(is_cylinder ? "a cylinder: its ghosts would be wrong here, where "
                               "every surface is one of revolution"
                 : is_same_name(type, "toric") ? "a toroid: its ghosts would be wrong here, where "
                                                 "every surface is one of revolution"
                                               : "not a known type of surface",
                 in_quotes(type), "sph");
}

void read_row(std::span<const std::string_view> row, const Place& place, ImportedLens& result,
              bool& any_coating) {
    if (row.size() < 5)
        place.refuse("the row is too short", fmt::format("{} words", row.size()), row_expected);
    if (row.size() > 6) refuse_type(row[6], place);
    ListedSurface listed;
    listed.place = place;
    const bool is_stop = is_same_name(row[0], "stop");
    if (!is_stop && !is_same_name(row[0], "inf") && !is_same_name(row[0], "infinity"))
        listed.radius_mm = place.number(row[0], "a radius in mm, 0 or inf for flat, or stop");
    listed.thickness_mm = place.number(row[1], "a thickness in mm");
    const double index = place.number(row[2], "an index");
    const double abbe = place.number(row[3], "an Abbe number, 0 for air");
    listed.semi_diameter_mm = place.number(row[4], "a semi-aperture in mm");
    if (row.size() > 5) {
        listed.coating =
            coating_of(place.number(row[5], "a count of coating layers"), place, result.notes);
        any_coating = any_coating || !std::holds_alternative<Uncoated>(listed.coating);
    }
    listed.medium_after = medium_of({.nd = index, .vd = abbe}, place, result.notes);
    if (is_stop && !result.stop) {
        result.stop = result.lens.surfaces.size();
        listed.comment = "stop";
    } else if (is_stop) {
        note_noticed(result.notes, place.where,
                     "a second stop: the first is the aperture stop, this one an opening", true,
                     "check which row is the stop");
    }
    append_surface(result, listed);
}

}  // namespace

bool is_flaresim_lens(std::string_view text) {
    for (const TextLine& line : text_lines(text.substr(0, 65536)))
        if (is_same_name(trimmed(line.text.substr(0, line.text.find('#'))), "surfaces:"))
            return true;
    return false;
}

ImportedLens import_flaresim_lens(const FormatSource& source) {
    const std::string file = source.file.string();
    ImportedLens result;
    UnusedWords unused;
    std::string remarks;
    bool in_surfaces = false;
    bool any_coating = false;
    bool are_radii = false;
    std::size_t surfaces_line = 0;
    for (const TextLine& each : text_lines(source.text)) {
        const Place place{file, fmt::format("line {}", each.number)};
        const std::size_t hash = each.text.find('#');
        const std::string_view line = trimmed(each.text.substr(0, hash));
        if (line.empty()) {
            constexpr std::size_t longest = 2000;
            const std::string remark =
                hash == each.text.npos ? "" : clipped(trimmed(each.text.substr(hash + 1)), 200);
            if (remark == flaresim_radii_remark)
                are_radii = true;
            else if (!in_surfaces && !remark.empty() && remarks.size() < longest)
                remarks += (remarks.empty() ? "" : "; ") + remark;
        } else if (!in_surfaces) {
            if (is_same_name(line, "surfaces:")) {
                in_surfaces = true;
                surfaces_line = each.number;
            } else if (const auto name = value_of(line, "name")) {
                result.lens.name = clipped(*name, 200);
            } else if (const auto focal = value_of(line, "focal_length")) {
                const double efl = place.number(*focal, "a focal length in mm");
                note_read(result.notes, place.where, fmt::format("focal length {} mm", efl));
                if (efl > 0.0) result.stated_efl_mm = result.lens.published.efl_mm = efl;
            } else {
                unused.add(line.substr(0, line.find(':')), place.where);
            }
        } else {
            read_row(words(line), place, result, any_coating);
        }
    }
    if (!in_surfaces)
        Place{file, {}}.refuse("not a FlareSim lens", "no line surfaces:", "surfaces:");
    if (result.lens.surfaces.empty())
        Place{file, fmt::format("line {}", surfaces_line)}.refuse(
            "the lens has no surfaces", "nothing after surfaces:", std::string(row_expected));
    result.lens.source = remarks;
    unused.report(result.notes);
    if (any_coating)
        note_converted(result.notes, {},
                       "a coating of one layer is taken as a quarter wave of MgF2 at 550 nm, which "
                       "the file means without saying it",
                       true, "choose the coating if it is known");
    if (result.stop) result.lens.stop.surface = *result.stop;
    const double last_mm = result.lens.surfaces.back().thickness_mm;
    place_sensor(result, last_mm > 0.0 ? std::optional(last_mm) : std::nullopt, file);

    if (are_radii) return result;
    auto f_number = f_number_in(result.lens.name);
    if (!f_number) f_number = f_number_in(remarks);
    if (f_number) {
        result.f_number = result.lens.published.f_number = f_number;
        note_read(result.notes, {}, fmt::format("f/{} from the lens's name", *f_number));
    }
    settle_heights(result, f_number, remarks.find("onverted from photonstophotos") != remarks.npos);
    note_surfaces(result);
    return result;
}

}  // namespace ghostlight
