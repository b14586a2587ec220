#include "core/optics/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/optics/trace_steps.h"
#include "core/units.h"

namespace ghostlight {

namespace {

int blade_edges(const StopMask& mask) { return mask.blades < 3 ? 1 : mask.blades; }

}  // namespace

int stop_edges(const StopMask& mask) { return blade_edges(mask) + (mask.picture ? 1 : 0); }

double stop_margin(const StopMask& mask, int edge, double u_mm, double v_mm) {
    const double a = mask.semi_diameter_mm;
    if (edge == blade_edges(mask)) {
        const double c = std::cos(mask.rotation_rad) / a, s = std::sin(mask.rotation_rad) / a;
        return mask.picture->distance_at(c * u_mm + s * v_mm, c * v_mm - s * u_mm);
    }
    if (mask.blades < 3) return 1.0 - (u_mm * u_mm + v_mm * v_mm) / (a * a);
    const double half = std::numbers::pi / mask.blades;
    const double middle = mask.rotation_rad + half * (2 * edge + 1);
    const double nx = std::cos(middle), ny = std::sin(middle);
    if (mask.blade_curvature <= 0.0) return std::cos(half) - (u_mm * nx + v_mm * ny) / a;
    // An arc through the two corners.
    const double radius = a / mask.blade_curvature;
    const double back =
        std::sqrt(radius * radius - std::pow(a * std::sin(half), 2)) - a * std::cos(half);
    return (radius - std::hypot(u_mm + back * nx, v_mm + back * ny)) / a;
}

BeamFrame beam_frame(const LightDirection& light) {
    const double theta = rad_from_deg(light.field_deg);
    const double phi = rad_from_deg(light.azimuth_deg);
    // Exact values at the axis's quarter turns keep symmetric lenses exactly symmetric.
    auto exact = [](double x) { return std::abs(x) < 1e-16 ? 0.0 : x; };
    const double cos_phi = exact(std::cos(phi)), sin_phi = exact(std::sin(phi));
    const double cos_theta = exact(std::cos(theta)), sin_theta = exact(std::sin(theta));
    BeamFrame frame;
    frame.direction = {sin_theta * cos_phi, sin_theta * sin_phi, cos_theta};
    frame.e1 = {sin_phi, -cos_phi, 0.0};
    frame.e2 = cross(frame.direction, frame.e1);
    return frame;
}

std::string to_string(const RayStatus& status) {
    const auto at = [&](const char* fate) {
        return fmt::format("{}:{}", fate, status.surface + 1);
    };
    switch (status.fate) {
        case RayFate::ok:
            return "ok";
        case RayFate::miss:
            return at("miss");
        case RayFate::tir:
            return at("tir");
        case RayFate::turned:
            return at("turned");
        case RayFate::clipped:
            return at("clipped");
        case RayFate::stop:
            return at("stop");
    }
    return "ok";
}

bool stop_passes(const StopMask& mask, double u_mm, double v_mm) {
    for (int edge = 0; edge < stop_edges(mask); ++edge)
        if (stop_margin(mask, edge, u_mm, v_mm) < 0.0) return false;
    return true;
}

Ray ray_at_entrance(const LightDirection& light, double px_mm, double py_mm) {
    return {{px_mm, py_mm, 0.0}, beam_frame(light).direction};
}

TracedRay trace_ray(const OpticalSystem& system, const GhostPath& ghost, const Ray& ray) {
    const TracePath<double> path = trace_path<double>(system, ghost);
    TracedRay result;
    RayAt<double> at{ray.origin, ray.direction};
    const double across = std::hypot(ray.direction.x, ray.direction.y);
    const glm::dvec3 e1 = across > 0.0
                              ? glm::dvec3(ray.direction.y / across, -ray.direction.x / across, 0.0)
                              : glm::dvec3(1.0, 0.0, 0.0);
    JonesState<double> jones = jones_start<double>(e1);
    double average = 1.0;
    auto fail = [&](RayFate fate, std::size_t surface) {
        result.status = {fate, surface};
        return result;
    };
    auto clip = [&](RayFate fate, std::size_t surface) {
        if (result.status.fate == RayFate::ok) result.status = {fate, surface};
    };
    double left = 1.0;  // by the media
    auto absorb = [&](double per_mm, double length_mm) {
        if (per_mm > 0.0) left *= std::exp(-per_mm * length_mm);
    };
    for (const TraceStep<double>& step : path.steps) {
        const std::size_t surface = static_cast<std::size_t>(step.surface);
        const glm::dvec3 start = at.position;
        const Meeting<double> meeting = meet(step, path.aspheric.data(), 1.0, at);
        const glm::dvec3 leg = at.position - start - glm::dvec3(0.0, 0.0, step.gap_mm);
        absorb(step.absorption_per_mm, dot(leg, at.direction));
        if (!(meeting.turned_margin >= 0.0)) return fail(RayFate::turned, surface);
        if (!(meeting.miss_margin >= 0.0)) return fail(RayFate::miss, surface);
        RayHit hit{.surface = surface,
                   .point = at.position,
                   .cos_incidence = meeting.cos_incidence,
                   .reflected = step.reflects};
        hit.point.z += surface_at(system, surface).vertex_z_mm;
        if (step.at_stop) {
            result.stop_point = {at.position.x, at.position.y};
            hit.r_rel =
                std::hypot(at.position.x, at.position.y) / system.stop_mask.semi_diameter_mm;
            if (!stop_passes(system.stop_mask, at.position.x, at.position.y))
                clip(RayFate::stop, surface);
        } else {
            hit.r_rel = std::sqrt(r2_rel(step, at.position));
            result.r_rel = std::max(result.r_rel, hit.r_rel);
            if (hit.r_rel > 1.0) clip(RayFate::clipped, surface);
        }
        if (!(meeting.hemisphere_margin > 0.0)) clip(RayFate::clipped, surface);
        const glm::dvec3 before = at.direction;
        const double cos2_squared = turn(step, meeting, at);
        if (!step.reflects && cos2_squared < 0.0) {
            result.hits.push_back(hit);
            return fail(RayFate::tir, surface);
        }
        if (!step.invisible) {
            const auto film = amplitudes(step, path.layers.data(), meeting.cos_incidence);
            apply(film, step.reflects, meeting, before, jones);
            average *= step.reflects ? 0.5 * (norm(film.r_s) + norm(film.r_p))
                                     : 0.5 * (norm(film.t_s) + norm(film.t_p));
        } else if (step.reflects) {
            average = 0.0;
            jones = {};
        }
        hit.intensity = left * 0.5 * (jones.intensity(0) + jones.intensity(1));
        result.hits.push_back(hit);
    }
    if (!(at.direction.z > 0.0)) return fail(RayFate::turned, system.surfaces.size());
    at.position.z += path.sensor_gap_mm;
    const double to_sensor_mm = -at.position.z / at.direction.z;
    absorb(path.sensor_absorption_per_mm, to_sensor_mm);
    result.sensor_point = along(at.position, at.direction, to_sensor_mm);
    result.sensor_point.z = system.sensor_z_mm;
    result.direction = at.direction;
    result.weight_s = left * jones.intensity(0);
    result.weight_p = left * jones.intensity(1);
    result.weight = 0.5 * (result.weight_s + result.weight_p);
    result.weight_average = left * average;
    return result;
}

}  // namespace ghostlight
