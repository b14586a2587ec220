#include "core/io/flaresim_write.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/export_steps.h"
#include "core/io/import_notes.h"
#include "core/io/import_steps.h"
#include "core/io/text_lines.h"

namespace ghostlight {
namespace {

/// A count of layers is all that the format says of a coating.
struct LayerCount {
    std::size_t operator()(const Uncoated&) const { return 0; }
    std::size_t operator()(const QuarterWave&) const { return 1; }
    std::size_t operator()(const LayerStack& stack) const { return stack.layers.size(); }
    template <class Other>
    std::size_t operator()(const Other&) const {
        return 1;
    }
};

std::string row_text(std::string_view curve, double thickness_mm, const ExportedGlass& glass,
                     double semi_mm, std::size_t layers) {
    return fmt::format("{} {} {} {} {} {}\n", curve, exact(thickness_mm),
                       exact(glass.nd.value_or(1.0)), exact(glass.vd.value_or(0.0)), exact(semi_mm),
                       layers);
}

void note_row(const Surface& surface, std::size_t number, const ExportedGlass& glass,
              std::size_t layers, Notes& notes) {
    const std::string where = fmt::format("surface {}", number);
    if (surface.conic != 0.0 || !surface.aspheric.empty())
        note_left_out(notes, where,
                      "its conic and aspheric terms: FlareSim has spheres and planes alone", true,
                      "expect other aberrations there");
    if (!glass.nd)
        note_left_out(notes, where,
                      fmt::format("glass {} has no index: written as air",
                                  in_quotes(surface.medium_after.name)),
                      true, "name a glass");
    else if (!surface.medium_after.name.empty())
        note_converted(notes, where,
                       fmt::format("glass {}: by nd and Vd", in_quotes(surface.medium_after.name)));
    if (layers > 0 && !(surface.coating == Coating{QuarterWave{}}))
        note_converted(notes, where,
                       fmt::format("its coating ({}) is written as a count of layers",
                                   describe(surface.coating)),
                       true);
}

}  // namespace

std::string write_flaresim_lens(const Prescription& lens, Notes& notes) {
    std::string text;
    for (const std::string* remark : {&lens.source, &lens.notes})
        for (const TextLine& line : text_lines(*remark))
            if (!line.text.empty()) text += "# " + std::string(line.text) + "\n";
    text += "name: " + one_line(lens.name) + "\n";
    if (const auto order = first_order_of(lens); order && std::isfinite(order->efl_mm))
        text += "focal_length: " + exact(order->efl_mm) + "\n";
    text += fmt::format("# {}\n", flaresim_radii_remark);
    text += "\nsurfaces:\n# radius thickness index abbe semi_aperture coating\n";
    const double stop_mm = working_stop_radius_mm(lens);
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const Surface& surface = lens.surfaces[row];
        const ExportedGlass glass = exported_glass(surface.medium_after);
        const std::size_t layers = std::visit(LayerCount{}, surface.coating);
        const double curvature = curvature_per_mm(surface.curve);
        const double thickness =
            row + 1 == lens.surfaces.size() ? sensor_distance_mm(lens) : surface.thickness_mm;
        if (row == lens.stop.surface) {
            if (is_dummy(lens, row) && curvature == 0.0) {
                text += row_text("stop", thickness, glass, stop_mm, 0);
                continue;
            }
            const ExportedGlass before = exported_glass(medium_before(lens, row));
            text += row_text("stop", 0.0, before, stop_mm, 0);
            note_converted(notes, fmt::format("surface {}", row + 1),
                           "the stop is on a surface of glass: written as a row of its own in "
                           "front of it",
                           true);
        }
        note_row(surface, row + 1, glass, layers, notes);
        text += row_text(curvature == 0.0 ? "0" : exact(1.0 / curvature), thickness, glass,
                         surface.semi_diameter_mm, layers);
    }
    Prescription uncoated = lens;
    for (Surface& surface : uncoated.surfaces) surface.coating = Uncoated{};
    note_left_behind(uncoated, "FlareSim", notes);
    if (!lens.configurations.empty())
        note_left_out(notes, "configurations", "the format holds one position of a lens", true,
                      "write each with --config");
    note_left_out(notes, "sensor", "the sensor's size");
    if (lens.stop.f_number || lens.stop.semi_diameter_mm)
        note_converted(notes, "stop", fmt::format("its working radius, {} mm", exact(stop_mm)));
    return text;
}

}  // namespace ghostlight
