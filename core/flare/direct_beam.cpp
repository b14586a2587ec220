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

/// The rays of a quadrature that pass, traced again for where they meet the stop.
Bundle<double> passing_rays(const OpticalSystem& system, const BeamFrame& frame,
                            const PathFlux& flux) {
    Bundle<double> passing;
    for (std::size_t k = 0; k < flux.field.rays.size(); ++k)
        if (std::ranges::all_of(flux.field.clearances,
                                [k](const auto& c) { return c[k] >= 0.0; })) {
            passing.u_mm.push_back(flux.field.rays.u_mm[k]);
            passing.v_mm.push_back(flux.field.rays.v_mm[k]);
        }
    if (passing.size() > 0)
        trace_bundle(trace_path<double>(system, {}), frame, Weights::none, passing);
    return passing;
}

/// The one nearest to the stop's middle.
std::size_t middle_ray(const Bundle<double>& rays) {
    std::size_t middle = 0;
    double least = 1e300;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const double r = std::hypot(rays.stop_u_mm[0][k], rays.stop_v_mm[0][k]);
        if (r >= least) continue;
        middle = k;
        least = r;
    }
    return middle;
}

/// How far rays land from each other over how far apart they meet the stop: the slope of a straight
/// line through all that pass, on even steps of the entrance. For a perfect lens out of focus it is
/// M of physics.md §9; for a real one the defocus that is left where its sensor stands.
double real_magnification(const OpticalSystem& system, const BeamFrame& frame,
                          const PupilBox& box) {
    constexpr int cells = 32;
    Bundle<double> rays;
    lay_grid(box, cells, rays);
    const RayField<double> field =
        trace_field(system, trace_path<double>(system, {}), frame, std::move(rays), Weights::none);
    const Bundle<double>& at = field.rays;
    double count = 0.0, x = 0.0, y = 0.0, u = 0.0, v = 0.0, products = 0.0, squares = 0.0;
    for (std::size_t k = 0; k < at.size(); ++k) {
        if (!std::ranges::all_of(field.clearances, [k](const auto& c) { return c[k] >= 0.0; }))
            continue;
        const double stop_u = at.stop_u_mm[0][k], stop_v = at.stop_v_mm[0][k];
        count += 1.0;
        x += at.x_mm[k];
        y += at.y_mm[k];
        u += stop_u;
        v += stop_v;
        products += stop_u * at.x_mm[k] + stop_v * at.y_mm[k];
        squares += stop_u * stop_u + stop_v * stop_v;
    }
    if (count < 3.0) return 0.0;
    const double spread = squares - (u * u + v * v) / count;
    return spread > 0.0 ? (products - (u * x + v * y) / count) / spread : 0.0;
}

/// The edge of what passes every rim and the stop's circle, around a point of the entrance that
/// does, as it is seen at the stop; nothing where the circle alone is the edge.
std::optional<ApertureOutline> limits_of(const OpticalSystem& system, const BeamFrame& frame,
                                         const PathFlux& flux, const Bundle<double>& passing) {
    // Around the middle of all that passes: the middle ray may be at the beam's edge.
    double u = 0.0, v = 0.0;
    for (std::size_t k = 0; k < passing.size(); ++k) {
        u += passing.u_mm[k] / static_cast<double>(passing.size());
        v += passing.v_mm[k] / static_cast<double>(passing.size());
    }
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
    if (beam.is_dark() || !(main.sums.flux > 0.0)) return beam;
    beam.x_mm = main.sums.x / main.sums.flux;
    beam.y_mm = main.sums.y / main.sums.flux;
    beam.tangential_rad = rad_from_deg(light.azimuth_deg);
    if (direct.stop_to_sensor.b != 0.0)
        beam.fresnel_number = a * a * real_magnification(system, frame, main.pupil.box) /
                              (wavelength_mm * direct.stop_to_sensor.b);
    const Bundle<double> passing = passing_rays(system, frame, main);
    if (passing.size() == 0) return beam;
    const std::size_t middle = middle_ray(passing);
    Ray ray{{}, frame.direction};
    for (int k = 0; k < 3; ++k)
        ray.origin[k] = passing.u_mm[middle] * frame.e1[k] + passing.v_mm[middle] * frame.e2[k];
    const TracedRay traced = trace_ray(system, {}, ray);
    if (traced.status.reaches_sensor()) {
        beam.cos_image_angle = traced.direction.z;
        const double across = std::hypot(traced.direction.x, traced.direction.y);
        if (across > 1e-9) beam.tangential_rad = std::atan2(traced.direction.y, traced.direction.x);
    }
    beam.limits = limits_of(system, frame, main, passing);
    return beam;
}

}  // namespace ghostlight
