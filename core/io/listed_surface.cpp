#include "core/io/listed_surface.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/import_notes.h"

namespace ghostlight {
namespace {

// The bounds of validate(), with the file's line in the message.
constexpr double largest_length_mm = 1e6;
constexpr double smallest_radius_mm = 1e-6;
constexpr std::size_t most_surfaces = 1000;

std::string medium_name(const Medium& medium) {
    if (is_air(medium)) return "air";
    if (!medium.name.empty()) return medium.name;
    if (const auto* model = std::get_if<ModelGlass>(&medium.dispersion))
        return fmt::format("nd {} Vd {}", model->nd, model->vd);
    if (const auto* constant = std::get_if<ConstantIndex>(&medium.dispersion))
        return fmt::format("n {}", constant->n);
    return "glass";
}

}  // namespace

void append_surface(ImportedLens& lens, const ListedSurface& listed) {
    const Place& place = listed.place;
    if (lens.lens.surfaces.size() >= most_surfaces)
        place.refuse("the lens has too many surfaces", "a further one", "at most 1000");
    Surface surface;
    const bool is_plane = listed.radius_mm == 0.0 || std::isinf(listed.radius_mm);
    if (std::isnan(listed.radius_mm) ||
        (!is_plane && std::abs(listed.radius_mm) < smallest_radius_mm))
        place.refuse("not a usable radius", fmt::format("{}", listed.radius_mm),
                     "a radius of at least 1e-6 mm, or a plane");
    if (!is_plane) surface.curve = Radius{listed.radius_mm};
    if (!(std::abs(listed.thickness_mm) <= largest_length_mm))
        place.refuse("not a usable thickness", fmt::format("{}", listed.thickness_mm),
                     "a length up to 1e6 mm");
    surface.thickness_mm = listed.thickness_mm;
    surface.medium_after = listed.medium_after;
    surface.coating = listed.coating;
    surface.comment = listed.comment;
    auto clear = listed.semi_diameter_mm;
    if (clear && !(*clear > 0.0 && *clear <= largest_length_mm)) {
        note_left_out(lens.notes, place.where,
                      fmt::format("a clear radius of {} mm means none here", *clear));
        clear.reset();
    }
    if (clear) surface.semi_diameter_mm = *clear;
    lens.lens.surfaces.push_back(std::move(surface));
    lens.surfaces.push_back({clear, place.where});
}

void note_surfaces(ImportedLens& lens) {
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const Surface& surface = lens.lens.surfaces[row];
        const ImportedSurface& said = lens.surfaces[row];
        const double c = curvature_per_mm(surface.curve);
        std::string shape = c == 0.0 ? "plane" : fmt::format("radius {:.7g} mm", 1.0 / c);
        if (const auto* radius = std::get_if<Radius>(&surface.curve))
            shape = fmt::format("radius {} mm", radius->mm);
        note_read(lens.notes, said.where,
                  fmt::format("surface {}: {}, {} mm of {}, {}", row + 1, shape,
                              surface.thickness_mm, medium_name(surface.medium_after),
                              said.semi_diameter_mm
                                  ? fmt::format("clear radius {} mm", *said.semi_diameter_mm)
                                  : "clear radius to be sized"));
    }
}

void place_sensor(ImportedLens& lens, std::optional<double> distance_mm, const std::string& file) {
    if (lens.lens.surfaces.empty())
        Place{file, {}}.refuse("the lens has no surfaces", "none", "at least one surface");
    lens.sensor_distance_mm = distance_mm;
    lens.lens.surfaces.back().thickness_mm = distance_mm.value_or(0.0);
}

}  // namespace ghostlight
