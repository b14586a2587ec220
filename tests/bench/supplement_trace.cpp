#include "tests/bench/supplement_trace.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

#include "core/optics/hullin_2011.h"

namespace ghostlight::bench {
namespace {

struct Meeting {
    glm::dvec3 position, normal;
    double theta_rad;
    bool hit;
};

Meeting meet_plane(const SupplementInterface& at, const glm::dvec3& position,
                   const glm::dvec3& direction) {
    const double t = (at.center_z_mm - position.z) / direction.z;
    const glm::dvec3 normal(0.0, 0.0, direction.z > 0.0 ? -1.0 : 1.0);
    return {position + t * direction, normal, std::acos(glm::dot(-direction, normal)), true};
}

Meeting meet_sphere(const SupplementInterface& at, const glm::dvec3& position,
                    const glm::dvec3& direction) {
    const glm::dvec3 from_center = position - glm::dvec3(0.0, 0.0, at.center_z_mm);
    const double b = glm::dot(from_center, direction);
    const double c = glm::dot(from_center, from_center) - at.radius_mm * at.radius_mm;
    const double root = b * b - c;
    if (root < 0.0) return {position, {}, 0.0, false};
    const double side = at.radius_mm * direction.z > 0.0 ? 1.0 : -1.0;
    // The centre lies behind a surface of positive radius: the nearer crossing is the vertex's.
    const double t = -b - side * std::sqrt(root);
    const glm::dvec3 there = position + t * direction;
    glm::dvec3 normal = glm::normalize(there - glm::dvec3(0.0, 0.0, at.center_z_mm));
    if (glm::dot(normal, direction) > 0.0) normal = -normal;
    return {there, normal, std::acos(std::min(1.0, glm::dot(-direction, normal))), true};
}

}  // namespace

SupplementPath supplement_path(const OpticalSystem& system, const GhostPath& ghost) {
    SupplementPath path;
    path.sensor_z_mm = system.sensor_z_mm;
    path.wavelength_nm = system.wavelength_nm;
    for (const PathEvent& event : events(ghost, system.surfaces.size())) {
        const SurfaceAt& surface = system.surfaces[event.surface];
        const Film film = event.forward ? surface.film : reversed(surface.film);
        const double radius =
            surface.curvature_per_mm == 0.0 ? 0.0 : 1.0 / surface.curvature_per_mm;
        const bool coated = !film.layers.empty();
        path.interfaces.push_back({surface.vertex_z_mm + radius, radius, surface.semi_diameter_mm,
                                   film.n_in, coated ? film.layers.front().n : 1.38, film.n_out,
                                   coated ? film.layers.front().thickness_nm : 0.0,
                                   event.reflects});
    }
    return path;
}

void trace_supplement(const SupplementPath& path, const BeamFrame& frame, Bundle<double>& bundle) {
    for (std::size_t i = 0; i < bundle.size(); ++i) {
        glm::dvec3 position = bundle.u_mm[i] * frame.e1 + bundle.v_mm[i] * frame.e2;
        glm::dvec3 direction = frame.direction;
        double r_rel = 0.0, intensity = 1.0;
        bool hit = true;
        for (const SupplementInterface& at : path.interfaces) {
            const Meeting meeting = at.radius_mm == 0.0 ? meet_plane(at, position, direction)
                                                        : meet_sphere(at, position, direction);
            if (!meeting.hit) {
                hit = false;
                break;
            }
            position = meeting.position;
            r_rel = std::max(r_rel, std::hypot(position.x, position.y) / at.clear_radius_mm);
            if (at.reflects) {
                direction = glm::reflect(direction, meeting.normal);
                intensity *=
                    hullin_2011_reflectance(std::cos(meeting.theta_rad), path.wavelength_nm,
                                            at.thickness_nm, at.n0, at.n1, at.n2);
            } else if (at.n0 != at.n2) {
                direction = glm::refract(direction, meeting.normal, at.n0 / at.n2);
                if (direction == glm::dvec3(0.0)) {
                    hit = false;
                    break;
                }
            }
        }
        const double t = (path.sensor_z_mm - position.z) / direction.z;
        bundle.x_mm[i] = position.x + t * direction.x;
        bundle.y_mm[i] = position.y + t * direction.y;
        bundle.weight[i] = intensity;
        bundle.r_rel[i] = r_rel;
        bundle.margin[i] = hit ? 1.0 : -1.0;
    }
}

}  // namespace ghostlight::bench
