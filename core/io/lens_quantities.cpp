#include "core/io/lens_quantities.h"

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/ghosts/incoherent_stack.h"
#include "core/optics/paraxial.h"
#include "core/optics/real_rays.h"
#include "core/units.h"

namespace ghostlight {
namespace {

Cell cell_of(const std::optional<double>& value) { return value ? Cell(*value) : Cell(); }

}  // namespace

std::vector<LensQuantity> lens_quantities(const OpticalSystem& system) {
    const FirstOrder first = first_order(system);
    const auto ghosts = static_cast<std::int64_t>(two_reflection_ghosts(system).size());
    const auto aperture = real_aperture(system);
    const double height = 0.5 * std::hypot(system.sensor_width_mm, system.sensor_height_mm);
    const double paraxial_field = std::atan(height / std::abs(first.efl_mm));
    return {
        {"efl_mm", first.efl_mm, "effective focal length", "Focal length", "mm",
         "Effective focal length: image height over the tangent of the field angle, to first "
         "order."},
        {"bfd_mm", first.bfd_mm, "last vertex to rear focus", "Back focal distance", "mm",
         "From the last surface's vertex to the rear focus; positive towards the sensor."},
        {"ffd_mm", first.ffd_mm, "first vertex to front focus, signed", "Front focal distance",
         "mm",
         "From the first surface's vertex to the front focus; negative when it lies before the "
         "lens."},
        {"f_number", first.f_number, "with the stop as it stands", "F-number", "",
         "Focal length over the entrance pupil's diameter, with the stop as it stands."},
        {"entrance_pupil_z_mm", first.entrance_pupil_z_mm, "from the first vertex",
         "Entrance pupil, place", "mm",
         "The stop's image through the surfaces before it, from the first surface's vertex; "
         "positive towards the sensor."},
        {"entrance_pupil_radius_mm", first.entrance_pupil_radius_mm, "", "Entrance pupil, radius",
         "mm", "Radius of the stop's image through the surfaces before it."},
        {"exit_pupil_z_mm", first.exit_pupil_z_mm, "from the last vertex", "Exit pupil, place",
         "mm",
         "The stop's image through the surfaces behind it, from the last surface's vertex; "
         "positive towards the sensor."},
        {"exit_pupil_radius_mm", first.exit_pupil_radius_mm, "", "Exit pupil, radius", "mm",
         "Radius of the stop's image through the surfaces behind it."},
        {"sensor_distance_mm", first.sensor_distance_mm, "last vertex to sensor", "Sensor distance",
         "mm", "From the last surface's vertex to the sensor."},
        {"paraxial_defocus_mm", first.paraxial_defocus_mm, "sensor - focus", "Defocus", "mm",
         "Sensor distance less back focal distance; positive when the sensor is behind the "
         "paraxial focus."},
        {"ghosts", ghosts, "pairs of two reflections", "Ghosts", "",
         "Ghosts of two reflections: pairs of surfaces that reflect."},
        {"front_principal_z_mm", first.front_principal_z_mm, "from the first vertex",
         "Front principal point", "mm",
         "From the first surface's vertex; positive towards the sensor."},
        {"rear_principal_z_mm", first.rear_principal_z_mm, "from the last vertex",
         "Rear principal point", "mm",
         "From the last surface's vertex; positive towards the sensor."},
        {"front_nodal_z_mm", first.front_nodal_z_mm, "from the first vertex", "Front nodal point",
         "mm", "From the first surface's vertex; in air it is the principal point."},
        {"rear_nodal_z_mm", first.rear_nodal_z_mm, "from the last vertex", "Rear nodal point", "mm",
         "From the last surface's vertex; in air it is the principal point."},
        {"pupil_magnification", first.pupil_magnification, "exit over entrance pupil",
         "Pupil magnification", "", "Exit pupil over entrance pupil, signed."},
        {"working_f_number", aperture ? Cell(aperture->working_f_number) : Cell(),
         "1 / (2 NA), by the real ray through the stop's edge", "Working f-number", "",
         "1 / (2 NA), by the real ray through the stop's edge."},
        {"numerical_aperture", aperture ? Cell(aperture->numerical_aperture) : Cell(),
         "n' sin u' of that ray", "Numerical aperture", "",
         "n' sin u' at the sensor of the real ray through the stop's edge."},
        {"image_height_mm", height, "half the sensor's diagonal", "Image height", "mm",
         "Half of the sensor's diagonal."},
        {"half_field_deg", cell_of(field_at_height_deg(system, height)),
         "whose real chief ray meets the sensor's corner", "Half field, to the corner", "°",
         "Field angle whose real chief ray meets the sensor's corner."},
        {"paraxial_half_field_deg", deg_from_rad(paraxial_field),
         "atan of image height over focal length", "Half field, to first order", "°",
         "Arc tangent of image height over focal length: without distortion."},
        {"half_field_x_deg", cell_of(field_at_height_deg(system, 0.5 * system.sensor_width_mm)),
         "to the middle of the sensor's side", "Half field, horizontal", "°",
         "Field angle whose real chief ray meets the middle of the sensor's side."},
        {"half_field_y_deg", cell_of(field_at_height_deg(system, 0.5 * system.sensor_height_mm)),
         "to the middle of its upper edge", "Half field, vertical", "°",
         "Field angle whose real chief ray meets the middle of the sensor's upper edge."},
        {"total_track_mm", first.total_track_mm, "first vertex to sensor", "Total track", "mm",
         "From the first surface's vertex to the sensor."},
        {"petzval_per_mm", first.petzval_per_mm, "sum of c (n' - n) / (n n')", "Petzval sum",
         "1/mm", "Sum over the surfaces of c (n' - n) / (n n'): minus the image's curvature."},
        {"higher_order_share", higher_order_share(system),
         "light of 4 and more reflections over that of 2, 1-D", "Higher reflections", "",
         "Light of four and more reflections over that of two, for a stack of plates in place of "
         "the lens: how much the ghosts of two reflections leave out."},
    };
}

}  // namespace ghostlight
