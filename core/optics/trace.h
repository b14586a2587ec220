#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// A collimated light: field angle from the axis and azimuth, degrees. It travels along
/// d = (sinθ cosφ, sinθ sinφ, cosθ).
struct LightDirection {
    double field_deg = 0.0;
    double azimuth_deg = 90.0;
    bool operator==(const LightDirection&) const = default;
};

/// The beam's frame: d, and two unit vectors across it. e1 is perpendicular to the plane of the
/// axis and d (s polarisation), e2 = d × e1 (p). Points of a bundle are u e1 + v e2, mm.
struct BeamFrame {
    glm::dvec3 direction, e1, e2;
};
BeamFrame beam_frame(const LightDirection& light);

/// Origin in mm (z = 0 at the first vertex) and unit direction.
struct Ray {
    glm::dvec3 origin, direction;
};

enum class RayFate { ok, miss, tir, turned, clipped, stop };

/// What became of a ray, and at which surface (from 0; the count of surfaces for the sensor).
struct RayStatus {
    RayFate fate = RayFate::ok;
    std::size_t surface = 0;
    bool reaches_sensor() const { return fate == RayFate::ok || is_clipped(); }
    bool is_clipped() const { return fate == RayFate::clipped || fate == RayFate::stop; }
    bool operator==(const RayStatus&) const = default;
};
/// "ok", "miss:3", "clipped:5", … rows counted from 1.
std::string to_string(const RayStatus& status);

/// One meeting of a ray with a surface on its way.
struct RayHit {
    std::size_t surface = 0;   ///< row from 0
    glm::dvec3 point{};        ///< mm, z = 0 at the first vertex
    double cos_incidence = 1;  ///< in the medium the ray comes from
    bool reflected = false;
    double intensity = 1;  ///< polarisation carried, just after this event
    double r_rel = 0;      ///< r over the clear radius (over the stop's radius at the stop)
};

/// A ray followed to the sensor. Clipped rays are followed too (virtual extension of surfaces).
struct TracedRay {
    RayStatus status;
    glm::dvec3 sensor_point{};
    glm::dvec3 direction{};
    glm::dvec2 stop_point{};      ///< at the last stop crossing, mm
    double r_rel = 0.0;           ///< running maximum over all crossings but the stop's
    double weight = 0.0;          ///< polarisation carried, unpolarised light in
    double weight_s = 0.0;        ///< light in polarised along e1 of the beam
    double weight_p = 0.0;        ///< along e2
    double weight_average = 0.0;  ///< (R_s + R_p)/2 and (T_s + T_p)/2 at every surface
    std::vector<RayHit> hits;     ///< in path order, up to where the ray fails
};

/// Follows one ray along a path, in double.
TracedRay trace_ray(const OpticalSystem& system, const GhostPath& path, const Ray& ray);

/// The ray that crosses the plane z = 0 at (px, py) mm.
Ray ray_at_entrance(const LightDirection& light, double px_mm, double py_mm);

/// Edges of the stop: one for a round one, else one per blade; one more for its image.
int stop_edges(const StopMask& mask);

/// Positive inside one edge of the stop, 1 at most, smooth: 1 − r²/a² for a round stop of
/// semi-diameter a; for a blade the distance from its edge over a. A polygon's corners lie on the
/// circle of the semi-diameter, the first at the rotation angle from +x; its edges are arcs of
/// radius semi-diameter / blade_curvature. The last edge of a stop with an image is the image's,
/// turned by the rotation angle: the distance over a.
double stop_margin(const StopMask& mask, int edge, double u_mm, double v_mm);

/// True where the stop is open.
bool stop_passes(const StopMask& mask, double u_mm, double v_mm);

}  // namespace ghostlight
