#include "core/io/export_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/io/glass_library.h"
#include "core/io/import_notes.h"
#include "core/io/import_steps.h"
#include "core/io/json_value.h"
#include "core/optics/optical_system.h"
#include "core/units.h"

namespace ghostlight {
namespace {

std::optional<OpticalSystem> compiled(Prescription lens) {
    for (Surface& surface : lens.surfaces) {
        surface.coating = Uncoated{};
        if (std::holds_alternative<UnknownGlass>(surface.medium_after.dispersion))
            surface.medium_after.dispersion = ConstantIndex{stand_in_index};
    }
    try {
        return compile(lens, d_line_nm);
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace

ExportedGlass exported_glass(const Medium& medium) {
    ExportedGlass glass;
    try {
        const auto known = medium.name.empty() ? std::nullopt : find_glass(medium.name, {});
        glass.catalogued = known && known->glass.medium == medium;
        if (glass.catalogued) glass.catalog = known->glass.catalog;
    } catch (const Error&) {
        // Without a catalogue at hand the numbers have to do.
    }
    if (const auto* model = std::get_if<ModelGlass>(&medium.dispersion))
        return {glass.catalogued, true, model->nd, model->vd, glass.catalog};
    if (const auto* constant = std::get_if<ConstantIndex>(&medium.dispersion))
        return {glass.catalogued, true, constant->n, std::nullopt, glass.catalog};
    try {
        glass.nd = refractive_index(medium, d_line_nm);
        const double vd = abbe_number(medium);
        if (std::isfinite(vd)) glass.vd = vd;
    } catch (const Error&) {
        // Not a glass for visible light, or one that nobody knows.
    }
    return glass;
}

std::string one_word(std::string_view name) {
    std::string word(name);
    std::ranges::replace_if(
        word, [](char c) { return static_cast<unsigned char>(c) <= ' ' || c == '"' || c == '\''; },
        '_');
    return word;
}

std::string one_line(std::string_view text) {
    std::string line(text);
    std::ranges::replace_if(
        line, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '"' || c == '\''; },
        ' ');
    return line;
}

std::string exact(double value) { return format_number(value); }

void note_left_behind(const Prescription& lens, std::string_view format, Notes& notes) {
    std::map<std::string, std::string> coatings;
    std::size_t unknown = lens.unknown.size() + lens.stop.unknown.size() +
                          lens.sensor.unknown.size() + lens.published.unknown.size();
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const Surface& surface = lens.surfaces[row];
        unknown += surface.unknown.size();
        if (std::holds_alternative<Uncoated>(surface.coating)) continue;
        std::string& rows = coatings[describe(surface.coating)];
        rows += fmt::format("{}{}", rows.empty() ? "" : ", ", row + 1);
    }
    for (const auto& [coating, rows] : coatings)
        note_left_out(notes, "surfaces " + rows,
                      fmt::format("the coating {} is not written: {} has no place for stacks",
                                  coating, format),
                      true, "choose it again in the other program");
    if (lens.stop.blades != 0)
        note_left_out(notes, "stop",
                      fmt::format("the {} blades of the iris: the opening is round in {}",
                                  lens.stop.blades, format),
                      true);
    if (lens.published != Published{})
        note_left_out(notes, "published", "what the source states of the lens");
    for (const Configuration& each : lens.configurations) {
        unknown += each.unknown.size() + each.published.unknown.size();
        if (each.published != Published{})
            note_left_out(notes, fmt::format("configurations['{}']", each.name),
                          "what the source states of this position");
        if (each.stop_semi_diameter_mm && !by_entrance_pupils(lens))
            note_left_out(notes, fmt::format("configurations['{}']", each.name),
                          "the stop's width in this position", true);
    }
    if (unknown > 0)
        note_left_out(
            notes, {},
            fmt::format("{} fields that other programs or later versions added", unknown));
}

double exported_half_field_deg(const Prescription& lens) {
    const auto order = first_order_of(lens);
    const double half = 0.5 * std::hypot(lens.sensor.width_mm, lens.sensor.height_mm);
    if (order && std::isfinite(order->efl_mm))
        return deg_from_rad(std::atan(half / std::abs(order->efl_mm)));
    return lens.published.half_field_deg.value_or(0.0);
}

std::optional<double> entrance_pupil_diameter_mm(const Prescription& lens) {
    const auto system = compiled(lens);
    if (!system) return std::nullopt;
    const double radius = first_order(*system).entrance_pupil_radius_mm;
    if (!std::isfinite(radius)) return std::nullopt;
    return 2.0 * radius;
}

double working_stop_radius_mm(const Prescription& lens) {
    const auto system = compiled(lens);
    return system ? system->stop_mask.semi_diameter_mm
                  : lens.surfaces[lens.stop.surface].semi_diameter_mm;
}

bool by_entrance_pupils(const Prescription& lens) {
    bool any = false;
    for (const Configuration& each : lens.configurations) {
        if (each.f_number) return false;
        any = any || each.stop_semi_diameter_mm;
    }
    return any && !lens.stop.f_number && entrance_pupil_diameter_mm(lens);
}

double sensor_distance_mm(const Prescription& lens) {
    if (!lens.sensor.at_paraxial_focus) return lens.surfaces.back().thickness_mm;
    const auto system = compiled(lens);
    return system ? system->sensor_z_mm - system->surfaces.back().vertex_z_mm
                  : lens.surfaces.back().thickness_mm;
}

}  // namespace ghostlight
