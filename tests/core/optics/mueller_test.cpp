// The polarisation carried by Jones matrices against a second formalism: Stokes vectors and Mueller
// matrices (E. Collett, Polarized Light, ch. 5 and 8), with frames from the points that rays meet.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <glm/geometric.hpp>

#include "core/optics/trace.h"
#include "core/optics/trace_steps.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

struct Stokes {
    double i = 1.0, q = 0.0, u = 0.0, v = 0.0;
};

/// In a frame turned by `angle_rad` from s towards p.
Stokes turned(const Stokes& light, double angle_rad) {
    const double c = std::cos(2.0 * angle_rad), s = std::sin(2.0 * angle_rad);
    return {light.i, c * light.q + s * light.u, -s * light.q + c * light.u, light.v};
}

/// After an element whose amplitudes for s and p are those.
Stokes passed(const Stokes& light, std::complex<double> s, std::complex<double> p) {
    const double sum = 0.5 * (std::norm(s) + std::norm(p));
    const double difference = 0.5 * (std::norm(s) - std::norm(p));
    const std::complex<double> both = s * std::conj(p);
    return {sum * light.i + difference * light.q, difference * light.i + sum * light.q,
            both.real() * light.u + both.imag() * light.v,
            -both.imag() * light.u + both.real() * light.v};
}

std::complex<double> number(const Complex<double>& z) { return {z.re, z.im}; }

/// The weight of a traced ray, for unpolarised light.
double mueller_weight(const OpticalSystem& system, const GhostPath& path, const Ray& ray,
                      const TracedRay& traced) {
    const TracePath<double> steps = trace_path<double>(system, path);
    Stokes light;
    glm::dvec3 s_before{};
    glm::dvec3 direction = ray.direction;
    bool framed = false;
    for (std::size_t k = 0; k < traced.hits.size(); ++k) {
        const RayHit& hit = traced.hits[k];
        const TraceStep<double>& step = steps.steps[k];
        const SurfaceAt& surface = surface_at(system, hit.surface);
        const double z = hit.point.z - surface.vertex_z_mm;
        const double c = surface.curvature_per_mm;
        const glm::dvec3 normal = glm::normalize(
            glm::dvec3(-c * hit.point.x, -c * hit.point.y, 1.0 - (1.0 + surface.conic) * c * z));
        const glm::dvec3 across = glm::cross(direction, normal);
        const glm::dvec3 along = glm::dot(direction, normal) < 0.0 ? -normal : normal;
        const double cosine = glm::dot(direction, along);
        // Snell's law for vectors; point to point would not do where surfaces cross or touch.
        const double eta = step.n_in / step.n_out;
        const double cosine_after = std::sqrt(1.0 - eta * eta * (1.0 - cosine * cosine));
        const glm::dvec3 next = step.reflects
                                    ? direction - 2.0 * cosine * along
                                    : eta * direction + (cosine_after - eta * cosine) * along;
        if (!step.invisible) {
            const glm::dvec3 s = glm::length(across) > 1e-9 ? glm::normalize(across) : s_before;
            if (framed) {
                const glm::dvec3 p_before = glm::cross(direction, s_before);
                light = turned(light, std::atan2(glm::dot(s, p_before), glm::dot(s, s_before)));
            }
            s_before = s;
            framed = true;
            const auto film = amplitudes(step, steps.layers.data(), cosine);
            light = step.reflects ? passed(light, number(film.r_s), number(film.r_p))
                                  : passed(light, number(film.t_s), number(film.t_p));
        }
        direction = next;
    }
    return light.i;
}

TEST(Mueller, SkewRaysOfRealLensesHaveTheWeightsOfJones) {
    // Rounding of some tens of turns of the frame.
    constexpr double tolerance = 1e-11;
    int compared = 0;
    double most_averaged = 0.0;
    for (const char* file : {"tessar_brendel_100_f2.8", "double_gauss_tronnier_100_f2",
                             "cooke_triplet_50_f5", "heliar_tronnier_100"})
        for (const bool coated : {true, false}) {
            const Prescription lens =
                coated ? bundled(file) : with_air_coating(bundled(file), Uncoated{});
            const OpticalSystem system = compile(lens, d_line_nm);
            for (const GhostPath& path : two_reflection_ghosts(system))
                for (const double azimuth : {90.0, 25.0}) {
                    const Ray ray = ray_at_entrance({9.0, azimuth}, 2.0, -5.0);
                    const TracedRay traced = trace_ray(system, path, ray);
                    if (!traced.status.reaches_sensor() || traced.weight < 1e-12) continue;
                    ++compared;
                    EXPECT_NEAR(mueller_weight(system, path, ray, traced), traced.weight,
                                tolerance * traced.weight)
                        << file << " " << name(path) << " azimuth " << azimuth;
                    most_averaged = std::max(most_averaged,
                                             std::abs(traced.weight_average / traced.weight - 1.0));
                }
        }
    EXPECT_GT(compared, 200);
    EXPECT_GT(most_averaged, 0.02) << "rays whose polarisation matters have to be among them";
}

/// A plate across which light goes at an angle, in any azimuth: s and p stay apart all the way.
TEST(Mueller, TiltedPlateHasFresnelsProducts) {
    constexpr double n = 1.62, field_deg = 55.0, tolerance = 1e-13;
    const OpticalSystem system =
        compile(lens_of({row(0.0, 3.0, n, 100.0), row(0.0, 9.0, 1.0, 100.0)}), d_line_nm);
    const double theta = rad_from_deg(field_deg), inside = std::asin(std::sin(theta) / n);
    const double rs = std::pow(std::sin(theta - inside) / std::sin(theta + inside), 2);
    const double rp = std::pow(std::tan(theta - inside) / std::tan(theta + inside), 2);
    for (const double azimuth : {0.0, 33.0, 90.0, 251.0}) {
        const Ray ray = ray_at_entrance({field_deg, azimuth}, 0.3, 0.1);
        const TracedRay direct = trace_ray(system, {}, ray);
        EXPECT_NEAR(direct.weight, 0.5 * (std::pow(1.0 - rs, 2) + std::pow(1.0 - rp, 2)),
                    tolerance);
        const TracedRay ghost = trace_ray(system, {{1, 0}}, ray);
        EXPECT_NEAR(ghost.weight,
                    0.5 * (std::pow(rs * (1.0 - rs), 2) + std::pow(rp * (1.0 - rp), 2)), tolerance);
        EXPECT_NEAR(ghost.weight_s, std::pow(rs * (1.0 - rs), 2), tolerance);
        EXPECT_NEAR(ghost.weight_p, std::pow(rp * (1.0 - rp), 2), tolerance);
    }
}

}  // namespace
}  // namespace ghostlight
