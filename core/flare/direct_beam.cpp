#include "core/flare/direct_beam.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/ghosts/flux_quadrature.h"
#include "core/optics/paraxial.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// Of the flux. The pattern of a beam is steadier than that.
constexpr double flux_tolerance = 2e-3;
constexpr int limit_directions = 80;
constexpr int bisections = 30;
/// An edge that stays this close to the stop's circle is the stop's.
constexpr double at_circle = 2e-3;
/// A corner in the limits: two rims meet there.
constexpr double corner_rad = 0.25;

/// The passing ray nearest to the stop's middle: its place in the entrance.
struct MiddleRay {
    bool found = false;
    double u_mm = 0.0, v_mm = 0.0;
};
MiddleRay middle_ray(const PathFlux& flux) {
    const Bundle<double>& rays = flux.field.rays;
    MiddleRay middle;
    double least = 0.0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const bool passes =
            std::ranges::all_of(flux.field.clearances, [k](const auto& c) { return c[k] >= 0.0; });
        if (!passes) continue;
        const double r = std::hypot(rays.stop_u_mm[0][k], rays.stop_v_mm[0][k]);
        if (middle.found && r >= least) continue;
        middle = {true, rays.u_mm[k], rays.v_mm[k]};
        least = r;
    }
    return middle;
}

/// The edge of what passes every rim and the stop's circle, around a point of the entrance that
/// does, as it is seen at the stop; nothing where the circle alone is the edge.
std::optional<ApertureOutline> limits_of(const OpticalSystem& system, const BeamFrame& frame,
                                         const PathFlux& flux) {
    // Around the middle of all that passes: the middle ray may be at the beam's edge.
    const Bundle<double>& rays = flux.field.rays;
    double u = 0.0, v = 0.0, count = 0.0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        if (!std::ranges::all_of(flux.field.clearances, [k](const auto& c) { return c[k] >= 0.0; }))
            continue;
        u += rays.u_mm[k];
        v += rays.v_mm[k];
        count += 1.0;
    }
    if (count == 0.0) return std::nullopt;
    u /= count;
    v /= count;
    const auto path = trace_path<double>(system, {});
    const double a = system.stop_mask.semi_diameter_mm;
    std::vector<double> inside(limit_directions, 0.0), outside(limit_directions);
    const double reach = 2.0 * std::hypot(flux.pupil.entrance.u1_mm - flux.pupil.entrance.u0_mm,
                                          flux.pupil.entrance.v1_mm - flux.pupil.entrance.v0_mm);
    std::ranges::fill(outside, reach);
    Bundle<double> edge;
    auto lay = [&](const std::vector<double>& at) {
        edge.u_mm.clear();
        edge.v_mm.clear();
        for (int d = 0; d < limit_directions; ++d) {
            const double angle = 2.0 * std::numbers::pi * d / limit_directions;
            edge.u_mm.push_back(u + at[static_cast<std::size_t>(d)] * std::cos(angle));
            edge.v_mm.push_back(v + at[static_cast<std::size_t>(d)] * std::sin(angle));
        }
        trace_bundle(path, frame, Weights::none, edge);
    };
    std::vector<double> middle(limit_directions);
    for (int step = 0; step < bisections; ++step) {
        for (std::size_t d = 0; d < middle.size(); ++d) middle[d] = 0.5 * (inside[d] + outside[d]);
        lay(middle);
        for (std::size_t d = 0; d < middle.size(); ++d) {
            const bool passes = edge.margin[d] >= 0.0 && edge.r_rel[d] <= 1.0 &&
                                std::hypot(edge.stop_u_mm[0][d], edge.stop_v_mm[0][d]) <= a;
            (passes ? inside : outside)[d] = middle[d];
        }
    }
    lay(inside);
    ApertureOutline outline;
    bool limited = false;
    for (std::size_t d = 0; d < limit_directions; ++d) {
        const glm::dvec2 at(edge.stop_u_mm[0][d] / a, edge.stop_v_mm[0][d] / a);
        limited = limited || std::hypot(at.x, at.y) < 1.0 - at_circle;
        outline.corners.push_back(at);
    }
    if (!limited) return std::nullopt;
    if (outline.area() < 0.0) std::ranges::reverse(outline.corners);
    for (std::size_t i = 0; i < limit_directions; ++i) {
        const glm::dvec2 before =
            outline.corners[i] - outline.corners[(i + limit_directions - 1) % limit_directions];
        const glm::dvec2 after = outline.corners[(i + 1) % limit_directions] - outline.corners[i];
        const double turn = std::remainder(
            std::atan2(after.y, after.x) - std::atan2(before.y, before.x), 2.0 * std::numbers::pi);
        outline.is_smooth.push_back(std::abs(turn) < corner_rad ? 1 : 0);
    }
    return outline;
}

}  // namespace

bool DirectBeam::is_dark() const {
    return std::ranges::none_of(flux_mm2, [](double flux) { return flux > 0.0; });
}

std::optional<DirectBeam> direct_beam(const std::vector<OpticalSystem>& systems,
                                      const LightDirection& light, unsigned threads,
                                      const std::stop_token& stop) {
    const BeamFrame frame = beam_frame(light);
    std::vector<PathFlux> fluxes(systems.size());
    const bool finished = parallel_for(systems.size(), threads, stop, [&](std::size_t w) {
        const PathQuadrature quadrature(systems[w], {}, frame);
        fluxes[w] = quadrature.start();
        quadrature.refine(fluxes[w], flux_tolerance, 0.0, stop);
    });
    if (!finished || stop.stop_requested()) return std::nullopt;
    DirectBeam beam;
    for (const PathFlux& flux : fluxes) beam.flux_mm2.push_back(flux.sums.flux);
    const OpticalSystem& system = systems[systems.size() / 2];
    const PathFlux& main = fluxes[systems.size() / 2];
    beam.wavelength_nm = system.wavelength_nm;
    const double a = system.stop_mask.semi_diameter_mm;
    const ParaxialGhost direct = paraxial_ghost(system, {});
    const double wavelength_mm =
        mm_from_nm(system.wavelength_nm) / system.surfaces[system.stop].n_before;
    beam.radius_per_k_mm = wavelength_mm * direct.stop_to_sensor.b / (2.0 * std::numbers::pi * a);
    beam.fresnel_number =
        std::copysign(direct.fresnel_number, direct.magnification * direct.stop_to_sensor.b);
    if (beam.is_dark() || !(main.sums.flux > 0.0)) return beam;
    beam.x_mm = main.sums.x / main.sums.flux;
    beam.y_mm = main.sums.y / main.sums.flux;
    beam.tangential_rad = rad_from_deg(light.azimuth_deg);
    if (const MiddleRay middle = middle_ray(main); middle.found) {
        Ray ray{{}, frame.direction};
        for (int k = 0; k < 3; ++k)
            ray.origin[k] = middle.u_mm * frame.e1[k] + middle.v_mm * frame.e2[k];
        const TracedRay traced = trace_ray(system, {}, ray);
        if (traced.status.reaches_sensor()) {
            beam.cos_image_angle = traced.direction.z;
            const double across = std::hypot(traced.direction.x, traced.direction.y);
            if (across > 1e-9)
                beam.tangential_rad = std::atan2(traced.direction.y, traced.direction.x);
        }
    }
    beam.limits = limits_of(system, frame, main);
    return beam;
}

}  // namespace ghostlight
