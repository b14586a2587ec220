#include "app/cli/lens_data.h"

#include <cmath>

#include "core/ghosts/field_curves.h"
#include "core/optics/paraxial.h"
#include "core/optics/paraxial_rays.h"
#include "core/optics/real_rays.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

double half_diagonal_mm(const OpticalSystem& system) {
    return 0.5 * std::hypot(system.sensor_width_mm, system.sensor_height_mm);
}

double field_tangent(const OpticalSystem& system, const FirstOrder& first) {
    return half_diagonal_mm(system) / std::abs(first.efl_mm);
}

}  // namespace

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
