#include "core/optics/optical_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight {
namespace {

struct FaceOf {
    double wavelength_nm;
    SurfaceAt& face;

    void operator()(const UniformReflectance& uniform) const {
        face.uniform_reflectance = uniform.share;
    }
    void operator()(const ReflectanceTable& table) const {
        const auto& entries = table.entries;
        const auto after =
            std::ranges::upper_bound(entries, wavelength_nm, {}, &ReflectanceAt::wavelength_nm);
        if (after == entries.begin()) {
            face.uniform_reflectance = entries.front().share;
        } else if (after == entries.end()) {
            face.uniform_reflectance = entries.back().share;
        } else {
            const ReflectanceAt& before = *(after - 1);
            const double t = (wavelength_nm - before.wavelength_nm) /
                             (after->wavelength_nm - before.wavelength_nm);
            face.uniform_reflectance = std::lerp(before.share, after->share, t);
        }
    }
    void operator()(const SensorFilms& films) const {
        Medium before;  // by index: the last row's medium is already compiled
        before.dispersion = ConstantIndex{face.n_before};
        face.film = film_at(films.stack, before, films.substrate, wavelength_nm);
    }
};

/// Whatever the wavelength, so that a lens has the same ghosts at all of them.
bool reflects_somewhere(const SensorReflectance& reflectance) {
    if (const auto* uniform = std::get_if<UniformReflectance>(&reflectance))
        return uniform->share > 0.0;
    if (const auto* table = std::get_if<ReflectanceTable>(&reflectance))
        return std::ranges::any_of(table->entries,
                                   [](const ReflectanceAt& at) { return at.share > 0.0; });
    return false;  // films: by what they are
}

/// The sensor's face at the end of the rows, or nothing where it sends nothing back.
std::optional<SurfaceAt> face_of(const Sensor& sensor, double n_before, double wavelength_nm) {
    if (!sensor.reflectance) return std::nullopt;
    SurfaceAt face;
    face.n_before = n_before;
    face.film = {.n_in = n_before, .layers = {}, .n_out = n_before, .wavelength_nm = wavelength_nm};
    std::visit(FaceOf{wavelength_nm, face}, *sensor.reflectance);
    face.n_after = face.film.n_out;
    face.semi_diameter_mm = 0.5 * std::hypot(sensor.width_mm, sensor.height_mm);
    face.reflects = reflects_somewhere(*sensor.reflectance) || !is_invisible(face.film);
    if (!face.reflects) return std::nullopt;
    return face;
}

OpticalSystem as_listed(const Prescription& lens, double wavelength_nm) {
    OpticalSystem system;
    system.wavelength_nm = wavelength_nm;
    system.stop = lens.stop.surface;
    double z = 0.0;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const Surface& surface = lens.surfaces[row];
        SurfaceAt at;
        at.curvature_per_mm = curvature_per_mm(surface.curve);
        at.conic = surface.conic;
        at.aspheric = surface.aspheric;
        while (!at.aspheric.empty() && at.aspheric.back() == 0.0) at.aspheric.pop_back();
        at.vertex_z_mm = z;
        at.semi_diameter_mm = surface.semi_diameter_mm;
        at.film =
            film_at(surface.coating, medium_before(lens, row), surface.medium_after, wavelength_nm);
        at.n_before = at.film.n_in;
        at.n_after = at.film.n_out;
        at.reflects = !is_invisible(at.film);
        if (lens.internal_transmittance) {
            at.absorption_before_per_mm =
                absorption_per_mm(medium_before(lens, row), wavelength_nm);
            at.absorption_after_per_mm = absorption_per_mm(surface.medium_after, wavelength_nm);
        }
        system.surfaces.push_back(std::move(at));
        z += surface.thickness_mm;
    }
    system.sensor_z_mm = z;
    system.sensor_width_mm = lens.sensor.width_mm;
    system.sensor_height_mm = lens.sensor.height_mm;
    system.sensor_face = face_of(lens.sensor, system.surfaces.back().n_after, wavelength_nm);
    if (system.sensor_face) {
        system.sensor_face->vertex_z_mm = z;
        system.sensor_face->absorption_before_per_mm =
            system.surfaces.back().absorption_after_per_mm;
    }
    const double listed = lens.surfaces[lens.stop.surface].semi_diameter_mm;
    system.stop_mask.semi_diameter_mm =
        std::min(listed, lens.stop.semi_diameter_mm.value_or(listed));
    system.stop_mask.blades = lens.stop.blades;
    system.stop_mask.rotation_rad = rad_from_deg(lens.stop.rotation_deg);
    system.stop_mask.blade_curvature = lens.stop.blade_curvature;
    if (lens.stop.image) system.stop_mask.picture = lens.stop.image->picture;
    return system;
}

/// Height at the stop of the collimated beam that fills EFL/N.
double stop_semi_diameter_mm(const OpticalSystem& at_d, double f_number) {
    const FirstOrder order = first_order(at_d);
    if (!std::isfinite(order.efl_mm))
        throw Error({.problem = "an f-number needs a focal length, and this lens has none",
                     .file = {},
                     .where = "stop.f_number",
                     .found = fmt::format("f/{}", f_number),
                     .expected = "a stop semi-diameter in mm instead"});
    const double entrance_radius = std::abs(order.efl_mm) / (2.0 * f_number);
    return at_d.stop_mask.semi_diameter_mm * entrance_radius / order.entrance_pupil_radius_mm;
}

}  // namespace

const SurfaceAt& surface_at(const OpticalSystem& system, std::size_t row) {
    return row < system.surfaces.size() ? system.surfaces[row] : system.sensor_face.value();
}

std::size_t turning_count(const OpticalSystem& system) {
    return system.surfaces.size() + (system.sensor_face ? 1 : 0);
}

OpticalSystem compile(const Prescription& lens, double wavelength_nm,
                      std::string_view configuration) {
    validate(lens);
    const Prescription position = configured(lens, configuration);
    OpticalSystem system = as_listed(position, wavelength_nm);
    const bool needs_first_order = position.sensor.at_paraxial_focus || position.stop.f_number;
    if (!needs_first_order) return system;

    OpticalSystem at_d = as_listed(position, d_line_nm);
    if (position.stop.f_number) {
        const std::size_t stop = position.stop.surface;
        const double listed = position.surfaces[stop].semi_diameter_mm;
        at_d.stop_mask.semi_diameter_mm = listed;
        system.stop_mask.semi_diameter_mm =
            std::min(listed, stop_semi_diameter_mm(at_d, *position.stop.f_number));
    }
    if (position.sensor.at_paraxial_focus) {
        const double bfd = first_order(at_d).bfd_mm;
        if (!std::isfinite(bfd) || bfd <= 0.0)
            throw Error({.problem = "the sensor cannot stand at the paraxial focus: there is no "
                                    "real one behind the lens",
                         .file = {},
                         .where = "sensor.distance_mm",
                         .found = fmt::format("focus at {} mm", bfd),
                         .expected = "a distance in mm"});
        system.sensor_z_mm = system.surfaces.back().vertex_z_mm + bfd;
        if (system.sensor_face) system.sensor_face->vertex_z_mm = system.sensor_z_mm;
    }
    return system;
}

}  // namespace ghostlight
