#include "core/optics/paraxial.h"

#include <cmath>
#include <limits>

#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double ratio(double a, double b) { return b == 0.0 ? infinity : a / b; }

RayMatrix gap(double length_mm) { return {1.0, length_mm, 0.0, 1.0}; }

RayMatrix interaction(const SurfaceAt& surface, const PathEvent& event) {
    const double s = event.forward ? 1.0 : -1.0;
    const double n1 = event.forward ? surface.n_before : surface.n_after;
    const double n2 = event.forward ? surface.n_after : surface.n_before;
    const double cs = surface.curvature_per_mm * s;
    if (event.reflects) return {1.0, 0.0, 2.0 * cs, 1.0};
    return {1.0, 0.0, -cs * (n2 - n1) / n2, n1 / n2};
}

}  // namespace

RayMatrix operator*(const RayMatrix& m, const RayMatrix& e) {
    return {m.a * e.a + m.b * e.c, m.a * e.b + m.b * e.d, m.c * e.a + m.d * e.c,
            m.c * e.b + m.d * e.d};
}

FirstOrder first_order(const OpticalSystem& system) {
    RayMatrix whole, to_stop, from_stop;
    for (std::size_t i = 0; i < system.surfaces.size(); ++i) {
        const SurfaceAt& surface = system.surfaces[i];
        if (i > 0) {
            const RayMatrix step = gap(surface.vertex_z_mm - system.surfaces[i - 1].vertex_z_mm);
            whole = step * whole;
            from_stop = step * from_stop;
        }
        if (i == system.stop) {
            to_stop = whole;
            from_stop = {};
        }
        const RayMatrix step = interaction(surface, {i, false, true});
        whole = step * whole;
        from_stop = step * from_stop;
    }
    FirstOrder order;
    order.efl_mm = ratio(-1.0, whole.c);
    order.bfd_mm = ratio(-whole.a, whole.c);
    order.ffd_mm = ratio(whole.d, whole.c);
    order.entrance_pupil_z_mm = ratio(to_stop.b, to_stop.a);
    order.entrance_pupil_radius_mm = ratio(system.stop_mask.semi_diameter_mm, std::abs(to_stop.a));
    order.exit_pupil_z_mm = ratio(-from_stop.b, from_stop.d);
    const double determinant = from_stop.a * from_stop.d - from_stop.b * from_stop.c;
    order.exit_pupil_radius_mm =
        ratio(system.stop_mask.semi_diameter_mm * std::abs(determinant), std::abs(from_stop.d));
    order.f_number = ratio(std::abs(order.efl_mm), 2.0 * order.entrance_pupil_radius_mm);
    // Object space is air; f' belongs to the last medium, the front focal length is f'/n'.
    const double front_focal_mm = order.efl_mm / system.surfaces.back().n_after;
    order.front_principal_z_mm = order.ffd_mm + front_focal_mm;
    order.rear_principal_z_mm = order.bfd_mm - order.efl_mm;
    order.front_nodal_z_mm = order.ffd_mm + order.efl_mm;
    order.rear_nodal_z_mm = order.bfd_mm - front_focal_mm;
    order.pupil_magnification = ratio(to_stop.a * determinant, from_stop.d);
    for (const SurfaceAt& surface : system.surfaces)
        order.petzval_per_mm += surface.curvature_per_mm * (surface.n_after - surface.n_before) /
                                (surface.n_before * surface.n_after);
    order.total_track_mm = system.sensor_z_mm;
    order.sensor_distance_mm = system.sensor_z_mm - system.surfaces.back().vertex_z_mm;
    order.paraxial_defocus_mm = order.sensor_distance_mm - order.bfd_mm;
    return order;
}

std::vector<ParaxialMeeting> paraxial_meetings(const OpticalSystem& system, const GhostPath& path) {
    std::vector<ParaxialMeeting> meetings;
    RayMatrix whole;
    double z = 0.0;
    for (const PathEvent& event : events(path, system.surfaces.size())) {
        const SurfaceAt& surface = surface_at(system, event.surface);
        whole = gap(std::abs(surface.vertex_z_mm - z)) * whole;
        z = surface.vertex_z_mm;
        const bool at_stop = event.surface == system.stop;
        meetings.push_back({whole,
                            at_stop ? system.stop_mask.semi_diameter_mm : surface.semi_diameter_mm,
                            at_stop});
        whole = interaction(surface, event) * whole;
    }
    return meetings;
}

ParaxialGhost paraxial_ghost(const OpticalSystem& system, const GhostPath& path) {
    ParaxialGhost ghost;
    RayMatrix whole, from_stop, to_last_stop;
    double limit = infinity;
    double z = 0.0;
    for (const PathEvent& event : events(path, system.surfaces.size())) {
        const SurfaceAt& surface = surface_at(system, event.surface);
        const RayMatrix leg = gap(std::abs(surface.vertex_z_mm - z));
        z = surface.vertex_z_mm;
        whole = leg * whole;
        from_stop = leg * from_stop;
        const bool at_stop = event.surface == system.stop;
        if (at_stop) {
            if (ghost.stop_crossings++ == 0) ghost.to_stop = whole;
            to_last_stop = whole;
            from_stop = {};
        }
        const double clear = at_stop ? system.stop_mask.semi_diameter_mm : surface.semi_diameter_mm;
        limit = std::min(limit, ratio(clear, std::abs(whole.a)));
        const RayMatrix step = interaction(surface, event);
        whole = step * whole;
        from_stop = step * from_stop;
    }
    const RayMatrix to_sensor = gap(system.sensor_z_mm - z);
    ghost.to_sensor = to_sensor * whole;
    ghost.stop_to_sensor = to_sensor * from_stop;
    ghost.focus_from_sensor_mm = ratio(-ghost.to_sensor.a, ghost.to_sensor.c);
    ghost.magnification = ratio(ghost.to_sensor.a, ghost.to_stop.a);
    ghost.entrance_semi_diameter_mm = limit;
    ghost.diameter_mm = 2.0 * std::abs(ghost.to_sensor.a) * limit;
    const RayMatrix& after = ghost.stop_to_sensor;
    ghost.pupil_from_sensor_mm = ratio(-after.b, after.d);
    ghost.pupil_radius_mm =
        ratio(system.stop_mask.semi_diameter_mm * std::abs(after.a * after.d - after.b * after.c),
              std::abs(after.d));
    // M/B = A/B + κ with κ = u/y at the stop; λ is that of the stop's medium, as B is not reduced.
    const double a = system.stop_mask.semi_diameter_mm;
    const double wavelength_mm =
        mm_from_nm(system.wavelength_nm) / system.surfaces[system.stop].n_before;
    const RayMatrix& rest = ghost.stop_to_sensor;
    const double magnified = rest.a * to_last_stop.a + rest.b * to_last_stop.c;
    ghost.fresnel_number =
        ratio(a * a * std::abs(magnified), wavelength_mm * std::abs(rest.b * to_last_stop.a));
    return ghost;
}

}  // namespace ghostlight
