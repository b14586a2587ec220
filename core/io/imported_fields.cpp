#include "core/io/imported_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/import_notes.h"
#include "core/io/import_steps.h"
#include "core/io/json_value.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double widest_field_deg = 89.0;

double entry(const std::vector<double>& all, std::size_t i) {
    return i < all.size() ? all[i] : 0.0;
}

/// Of a direction whose projections have these angles; beyond 90 degrees tangents say nothing.
double from_axis_deg(double x_deg, double y_deg) {
    const double slope = std::hypot(std::tan(rad_from_deg(x_deg)), std::tan(rad_from_deg(y_deg)));
    return std::max({deg_from_rad(std::atan(slope)), std::abs(x_deg), std::abs(y_deg)});
}

double angle_deg(double height_mm, double distance_mm) {
    const double angle = deg_from_rad(std::atan(std::abs(height_mm / distance_mm)));
    return std::isfinite(angle) ? angle : 0.0;
}

}  // namespace

std::optional<ImportedOrder> first_order_so_far(const ImportedLens& lens) {
    Prescription trial = lens.lens;
    if (lens.stop) trial.stop.surface = *lens.stop;
    for (std::size_t row = 0; row < trial.surfaces.size(); ++row)
        if (lens.surfaces[row].semi_diameter_mm)
            trial.surfaces[row].semi_diameter_mm = *lens.surfaces[row].semi_diameter_mm;
    if (!trial.surfaces.empty()) trial.surfaces.back().thickness_mm = 0.0;
    const auto order = first_order_of(trial);
    if (!order) return std::nullopt;
    return ImportedOrder{order->efl_mm, order->entrance_pupil_z_mm};
}

void set_fields(ImportedLens& lens, const ListedFields& listed,
                std::optional<double> object_distance_mm) {
    using Kind = ListedFields::Kind;
    const std::size_t count = std::max(listed.x.size(), listed.y.size());
    const auto order = first_order_so_far(lens);
    double largest = 0.0;
    bool any_vignetting = false;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = entry(listed.x, i), y = entry(listed.y, i);
        const double height_mm = std::hypot(x, y);
        ImportedField field;
        if (listed.kind == Kind::angle_deg)
            field.field_deg = from_axis_deg(x, y);
        else if (listed.kind == Kind::image_height_mm && order)
            field.field_deg = angle_deg(height_mm, order->efl_mm);
        else if (object_distance_mm && order)
            field.field_deg =
                angle_deg(height_mm, *object_distance_mm + order->entrance_pupil_z_mm);
        field.field_deg =
            std::isfinite(field.field_deg) ? std::min(field.field_deg, widest_field_deg) : 0.0;
        largest =
            std::max(largest, listed.kind == Kind::image_height_mm ? height_mm : field.field_deg);
        field.cut_upper = entry(listed.cut_upper, i);
        field.cut_lower = entry(listed.cut_lower, i);
        // A field below the axis is the mirror image of one above it.
        if (y < 0.0) std::swap(field.cut_upper, field.cut_lower);
        field.cut_sides = entry(listed.cut_sides, i);
        any_vignetting = any_vignetting || field.cut_upper != 0.0 || field.cut_lower != 0.0;
        lens.fields.push_back(field);
    }
    if (!(largest > 0.0)) return;
    if (listed.kind == Kind::image_height_mm) {
        lens.image_height_mm = largest;
        note_converted(lens.notes, listed.where,
                       fmt::format("fields by image height, up to {} mm", format_number(largest)));
    } else {
        lens.half_field_deg = largest;
        if (listed.kind == Kind::angle_deg)
            note_read(lens.notes, listed.where,
                      fmt::format("fields up to {:.6g} degrees", largest));
        else
            note_converted(lens.notes, listed.where,
                           fmt::format("fields by object height: up to {:.6g} degrees", largest));
    }
    if (any_vignetting)
        note_converted(lens.notes, listed.where,
                       "vignetting factors: used for sizing surfaces alone; rims cut the rays");
}

}  // namespace ghostlight
