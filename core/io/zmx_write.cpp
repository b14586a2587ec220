#include <fmt/format.h>

#include "core/io/export_steps.h"
#include "core/io/import_notes.h"
#include "core/io/zmx.h"
#include "core/io/zmx_text.h"

namespace ghostlight {
namespace {

/// FNUM, ENPD, or by the stop's own size where nothing closes it.
std::string aperture_line(const Prescription& lens, Notes& notes) {
    if (lens.stop.f_number) return "FNUM " + exact(*lens.stop.f_number) + " 0";
    if (!lens.stop.semi_diameter_mm && !by_entrance_pupils(lens)) return "FLOA";
    if (const auto diameter = entrance_pupil_diameter_mm(lens)) {
        note_converted(notes, "stop",
                       fmt::format("its radius of {} mm is written as an entrance pupil {} mm wide",
                                   exact(working_stop_radius_mm(lens)), exact(*diameter)));
        return "ENPD " + exact(*diameter);
    }
    note_left_out(notes, "stop", "its working radius: it is written wide open", true);
    return "FLOA";
}

std::string configurations_text(const Prescription& lens, Notes& notes) {
    const std::size_t count = lens.configurations.size();
    if (count == 0) return "MNUM 1 1\n";
    std::string text = fmt::format("MNUM {} 1\n", count);
    const auto operand = [&](std::string_view word, std::size_t target, std::size_t number,
                             const std::string& value) {
        text +=
            fmt::format("{}   {}   {} {} 0 0 0 1 1 1 0 0 \"\" 0\n", word, target, number, value);
    };
    for (std::size_t i = 0; i < count; ++i)
        operand("LTTL", 0, i + 1, "\"" + one_line(lens.configurations[i].name) + "\"");
    // By operand, then by configuration: the other order is read as zeros.
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        bool varies = false;
        for (const Configuration& each : lens.configurations)
            varies = varies || each.thickness_mm.contains(row);
        if (!varies) continue;
        for (std::size_t i = 0; i < count; ++i) {
            const auto& thickness = lens.configurations[i].thickness_mm;
            const auto own = thickness.find(row);
            operand("THIC", row + 1, i + 1,
                    exact(own != thickness.end() ? own->second : lens.surfaces[row].thickness_mm));
        }
    }
    bool any_f_number = false;
    for (const Configuration& each : lens.configurations)
        any_f_number = any_f_number || each.f_number;
    if (by_entrance_pupils(lens)) {
        for (std::size_t i = 0; i < count; ++i)
            operand("APER", 0, i + 1,
                    exact(entrance_pupil_diameter_mm(configured(lens, lens.configurations[i].name))
                              .value_or(0.0)));
    } else if (any_f_number && lens.stop.f_number) {
        for (std::size_t i = 0; i < count; ++i)
            operand("APER", 0, i + 1,
                    exact(lens.configurations[i].f_number.value_or(*lens.stop.f_number)));
    } else if (any_f_number) {
        note_left_out(
            notes, "configurations",
            "their f-numbers: the lens as listed has none, and the format has one kind of "
            "aperture for all",
            true);
    }
    note_converted(notes, "configurations",
                   "the rows hold the lens as listed; the other program shows its first "
                   "configuration instead");
    return text;
}

}  // namespace

std::string write_zmx(const Prescription& lens, Notes& notes) {
    std::string text =
        zmx_header_text(lens, aperture_line(lens, notes), exported_half_field_deg(lens)) +
        zmx_object_text();
    const std::size_t count = lens.surfaces.size();
    for (std::size_t row = 0; row < count; ++row) {
        const Surface& surface = lens.surfaces[row];
        const bool is_last = row + 1 == count;
        text += zmx_surface_text(
            row + 1,
            {.surface = &surface,
             .thickness_mm = is_last ? sensor_distance_mm(lens) : surface.thickness_mm,
             .medium = &surface.medium_after,
             .semi_diameter_mm = surface.semi_diameter_mm,
             .sized = surface.semi_diameter_sized,
             .stop = row == lens.stop.surface,
             .comment = surface.comment},
            notes);
        // Kept at the paraxial focus by the solve for a marginal ray of height 0.
        if (is_last && lens.sensor.at_paraxial_focus) text += "  MAZH 0 0\n";
    }
    text += zmx_image_text(count + 1, lens.sensor) + configurations_text(lens, notes);
    note_left_behind(lens, "Zemax", notes);
    return text;
}

}  // namespace ghostlight
