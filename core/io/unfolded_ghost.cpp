#include "core/io/unfolded_ghost.h"

#include <fmt/format.h>

#include "core/io/export_steps.h"
#include "core/io/import_notes.h"
#include "core/io/text_lines.h"
#include "core/io/zmx_text.h"
#include "core/optics/optical_system.h"
#include "core/units.h"

namespace ghostlight {

std::string unfolded_ghost(const Prescription& lens, const GhostPath& path, Notes& notes) {
    const OpticalSystem system = compile(lens, d_line_nm);
    const std::vector<PathEvent> way = events(path, lens.surfaces.size());
    Prescription titled = lens;
    titled.name = fmt::format("{}: ghost {}", lens.name, name(path));
    std::string text =
        zmx_header_text(titled, "FLOA", exported_half_field_deg(lens)) + zmx_object_text();
    bool stop_is_marked = false;
    for (std::size_t k = 0; k < way.size(); ++k) {
        const PathEvent& event = way[k];
        const bool at_stop = event.surface == system.stop;
        const double next_z = k + 1 < way.size() ? system.surfaces[way[k + 1].surface].vertex_z_mm
                                                 : system.sensor_z_mm;
        // Light that goes back leaves a surface towards what is in front of it.
        const Medium& medium = event.forward ? lens.surfaces[event.surface].medium_after
                                             : medium_before(lens, event.surface);
        const double rim_mm = at_stop ? system.stop_mask.semi_diameter_mm
                                      : lens.surfaces[event.surface].semi_diameter_mm;
        text +=
            zmx_surface_text(k + 1,
                             {.surface = &lens.surfaces[event.surface],
                              .thickness_mm = next_z - system.surfaces[event.surface].vertex_z_mm,
                              .mirror = event.reflects,
                              .medium = &medium,
                              .semi_diameter_mm = rim_mm,
                              .stop = at_stop && !stop_is_marked,
                              .comment = fmt::format("surface {}{}", event.surface + 1,
                                                     event.reflects  ? ", reflected"
                                                     : event.forward ? ""
                                                                     : ", backwards")},
                             notes);
        text += fmt::format("  CLAP 0 {} 0\n", exact(rim_mm));
        stop_is_marked = stop_is_marked || at_stop;
    }
    text += zmx_image_text(way.size() + 1, lens.sensor) + "MNUM 1 1\n";
    note_converted(notes, "ghost " + name(path),
                   fmt::format("{} meetings with {} surfaces, one after the other", way.size(),
                               lens.surfaces.size()));
    note_left_behind(lens, "Zemax", notes);
    return text;
}

std::string unfolded_ghost(const Prescription& lens, const std::string& ghost,
                           const std::filesystem::path& file, Notes& notes) {
    if (!is_same_name(file.extension().string(), ".zmx"))
        throw Error({.problem = "an unfolded ghost has mirrors, which only .zmx holds",
                     .file = file.string(),
                     .where = {},
                     .found = file.extension().string(),
                     .expected = "a file name that ends in .zmx"});
    const Prescription listed = configured(lens, {});
    return unfolded_ghost(listed, parse_ghost(ghost, compile(listed, d_line_nm)), notes);
}

}  // namespace ghostlight
