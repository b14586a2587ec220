#include "app/cli/lens_data.h"

#include <cmath>

#include "core/ghosts/field_curves.h"
#include "core/ghosts/incoherent_stack.h"
#include "core/optics/paraxial.h"
#include "core/optics/paraxial_rays.h"
#include "core/optics/real_rays.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

double half_diagonal_mm(const OpticalSystem& system) {
    return 0.5 * std::hypot(system.sensor_width_mm, system.sensor_height_mm);
}

Cell cell_of(const std::optional<double>& value) { return value ? Cell(*value) : Cell(); }

double field_tangent(const OpticalSystem& system, const FirstOrder& first) {
    return half_diagonal_mm(system) / std::abs(first.efl_mm);
}

}  // namespace

std::vector<LensQuantity> lens_quantities(const OpticalSystem& system) {
    const FirstOrder first = first_order(system);
    const auto ghosts = static_cast<std::int64_t>(two_reflection_ghosts(system).size());
    const auto aperture = real_aperture(system);
    const double height = half_diagonal_mm(system);
    return {
        {"efl_mm", first.efl_mm, "effective focal length"},
        {"bfd_mm", first.bfd_mm, "last vertex to rear focus"},
        {"ffd_mm", first.ffd_mm, "first vertex to front focus, signed"},
        {"f_number", first.f_number, "with the stop as it stands"},
        {"entrance_pupil_z_mm", first.entrance_pupil_z_mm, "from the first vertex"},
        {"entrance_pupil_radius_mm", first.entrance_pupil_radius_mm, ""},
        {"exit_pupil_z_mm", first.exit_pupil_z_mm, "from the last vertex"},
        {"exit_pupil_radius_mm", first.exit_pupil_radius_mm, ""},
        {"sensor_distance_mm", first.sensor_distance_mm, "last vertex to sensor"},
        {"paraxial_defocus_mm", first.paraxial_defocus_mm, "sensor - focus"},
        {"ghosts", ghosts, "pairs of two reflections"},
        {"front_principal_z_mm", first.front_principal_z_mm, "from the first vertex"},
        {"rear_principal_z_mm", first.rear_principal_z_mm, "from the last vertex"},
        {"front_nodal_z_mm", first.front_nodal_z_mm, "from the first vertex"},
        {"rear_nodal_z_mm", first.rear_nodal_z_mm, "from the last vertex"},
        {"pupil_magnification", first.pupil_magnification, "exit over entrance pupil"},
        {"working_f_number", aperture ? Cell(aperture->working_f_number) : Cell(),
         "1 / (2 NA), by the real ray through the stop's edge"},
        {"numerical_aperture", aperture ? Cell(aperture->numerical_aperture) : Cell(),
         "n' sin u' of that ray"},
        {"image_height_mm", height, "half the sensor's diagonal"},
        {"half_field_deg", cell_of(field_at_height_deg(system, height)),
         "whose real chief ray meets the sensor's corner"},
        {"paraxial_half_field_deg", deg_from_rad(std::atan(field_tangent(system, first))),
         "atan of image height over focal length"},
        {"half_field_x_deg", cell_of(field_at_height_deg(system, 0.5 * system.sensor_width_mm)),
         "to the middle of the sensor's side"},
        {"half_field_y_deg", cell_of(field_at_height_deg(system, 0.5 * system.sensor_height_mm)),
         "to the middle of its upper edge"},
        {"total_track_mm", first.total_track_mm, "first vertex to sensor"},
        {"petzval_per_mm", first.petzval_per_mm, "sum of c (n' - n) / (n n')"},
        {"higher_order_share", higher_order_share(system),
         "light of 4 and more reflections over that of 2, 1-D"},
    };
}

Table paraxial_ray_rows(const OpticalSystem& system) {
    Table table;
    table.columns = {"surface",    "z_mm",       "n_after", "marginal_y_mm", "marginal_u",
                     "marginal_i", "chief_y_mm", "chief_u", "chief_i",       "lagrange_mm"};
    const auto rays = paraxial_rays(system, field_tangent(system, first_order(system)));
    for (std::size_t row = 0; row < rays.size(); ++row) {
        const bool sensor = row == system.surfaces.size();
        const ParaxialRaysAt& at = rays[row];
        table.rows.push_back({sensor ? Cell("sensor") : Cell(std::to_string(row + 1)),
                              sensor ? system.sensor_z_mm : system.surfaces[row].vertex_z_mm,
                              sensor ? Cell() : Cell(system.surfaces[row].n_after),
                              at.marginal.y_mm, at.marginal.u, at.marginal.incidence, at.chief.y_mm,
                              at.chief.u, at.chief.incidence, at.lagrange_mm});
    }
    return table;
}

Table field_curve_rows(const OpticalSystem& system, int points) {
    const auto corner = field_at_height_deg(system, half_diagonal_mm(system));
    const double last = corner ? *corner : widest_field_deg(system);
    Table table;
    table.columns = {"field_deg",     "image_height_mm",      "paraxial_height_mm",
                     "distortion",    "pupil_area_mm2",       "vignetting",
                     "transmittance", "relative_illumination"};
    for (const FieldPoint& at : field_curves(system, last, points))
        table.rows.push_back({at.field_deg, at.image_height_mm, at.paraxial_height_mm,
                              at.distortion, at.pupil_area_mm2, at.vignetting, at.transmittance,
                              at.relative_illumination});
    return table;
}

}  // namespace ghostlight::cli
