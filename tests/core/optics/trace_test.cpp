// The trace against geometry that is known in closed form, and against its own symmetries.
#include "core/optics/trace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double rounding_mm = 1e-12;  // some thousands of ulps of lengths of some mm

Ray ray(glm::dvec3 origin, glm::dvec3 towards) {
    return {origin, glm::normalize(glm::dvec3(towards - origin))};
}

TEST(Trace, AplanaticPointsOfASphereAreImagedExactly) {
    // Rays that converge at a distance R n2/n1 beyond the centre leave for R n1/n2 beyond it.
    const double radius = 20.0, n = 1.7;
    const double centre = radius;
    const double object = centre + radius * n, image = centre + radius / n;
    const OpticalSystem system = compile(lens_of({row(radius, image, n, 19.9)}), d_line_nm);
    for (const double height : {0.01, 3.0, 8.0, 15.0, 20.0, 24.0}) {
        // Start well before the sphere, on the way to the object point.
        const glm::dvec3 start(0.6 * height, 0.8 * height, -15.0);
        const TracedRay traced = trace_ray(system, {}, ray(start, {0.0, 0.0, object}));
        ASSERT_TRUE(traced.status.reaches_sensor()) << height;
        EXPECT_NEAR(traced.sensor_point.x, 0.0, rounding_mm) << height;
        EXPECT_NEAR(traced.sensor_point.y, 0.0, rounding_mm) << height;
    }
}

/// A ray parallel to the axis at a height, through one surface and into n, to the sensor.
double axial_error_mm(const Surface& surface, double n_in, double height_mm) {
    // A plane in front brings the light into n_in without turning it.
    const Prescription lens = lens_of({row(0.0, 5.0, n_in, 100.0), surface});
    const OpticalSystem system = compile(lens, d_line_nm);
    const TracedRay traced =
        trace_ray(system, {}, ray_at_entrance({0.0, 90.0}, 0.6 * height_mm, 0.8 * height_mm));
    EXPECT_TRUE(traced.status.reaches_sensor()) << to_string(traced.status);
    return std::hypot(traced.sensor_point.x, traced.sensor_point.y);
}

TEST(Trace, CartesianEllipsoidFocusesParallelLightInGlass) {
    // Air to glass, k = −1/n²: the far focus lies n R/(n − 1) from the vertex, without aberration.
    for (const double n : {1.5, 1.9})
        for (const double height : {0.1, 5.0, 10.0}) {
            const double radius = 16.0;
            const Surface ellipsoid = row(radius, n * radius / (n - 1.0), n, 15.0, -1.0 / (n * n));
            EXPECT_NEAR(axial_error_mm(ellipsoid, 1.0, height), 0.0, 10 * rounding_mm);
        }
}

TEST(Trace, CartesianHyperboloidFocusesParallelLightFromGlass) {
    // Glass to air, k = −n²: the focus lies R/(1 − n) from the vertex.
    for (const double n : {1.5, 1.9})
        for (const double height : {0.1, 5.0, 15.0, 40.0}) {
            const double radius = -16.0;
            const Surface hyperboloid = row(radius, radius / (1.0 - n), 1.0, 50.0, -n * n);
            EXPECT_NEAR(axial_error_mm(hyperboloid, n, height), 0.0, 20 * rounding_mm);
        }
}

TEST(Trace, ParaboloidMirrorsFocusParallelLight) {
    // A ghost by two confocal paraboloids: the later mirror gathers the light at the common focus,
    // the earlier sends it out parallel. Films in air reflect and do not refract.
    const double f1 = 40.0, f2 = 10.0;
    Prescription lens =
        lens_of({row(2.0 * f2, f1 + f2, 1.0, 30.0, -1.0), row(-2.0 * f1, 20.0, 1.0, 30.0, -1.0)});
    for (Surface& surface : lens.surfaces) surface.coating = LayerStack{{{medium(1.5), 50.0, 0.0}}};
    const OpticalSystem system = compile(lens, d_line_nm);
    const GhostPath ghost = parse_ghost("2-1", system);
    for (const double height : {0.5, 4.0, 8.0, 16.0}) {
        const TracedRay traced =
            trace_ray(system, ghost, ray_at_entrance({0.0, 90.0}, 0.0, height));
        ASSERT_TRUE(traced.status.reaches_sensor()) << to_string(traced.status);
        EXPECT_NEAR(traced.direction.y, 0.0, rounding_mm) << height;
        EXPECT_NEAR(traced.sensor_point.y, -height * f2 / f1, 10 * rounding_mm) << height;
    }
}

TEST(Trace, GhostOfAPlateIsDisplacedByTwoMoreCrossings) {
    // Plane-parallel plate: after two reflections the ray leaves in its old direction, displaced
    // along the plate by 2 t tan θ'.
    const double n = 1.6, thickness = 3.0, sensor = 10.0;
    const OpticalSystem system =
        compile(lens_of({row(0.0, thickness, n, 50.0), row(0.0, sensor, 1.0, 50.0)}), d_line_nm);
    const GhostPath ghost = parse_ghost("2-1", system);
    for (const double deg : {0.0, 1e-6, 10.0, 45.0, 80.0}) {
        const double sine = std::sin(rad_from_deg(deg)), inside = std::asin(sine / n);
        const Ray in = ray_at_entrance({deg, 90.0}, 1.0, -2.0);
        const TracedRay direct = trace_ray(system, {}, in);
        const TracedRay traced = trace_ray(system, ghost, in);
        EXPECT_NEAR(traced.sensor_point.y - direct.sensor_point.y,
                    2.0 * thickness * std::tan(inside), 10 * rounding_mm);
        EXPECT_NEAR(traced.sensor_point.x, 1.0, rounding_mm);
        EXPECT_NEAR(direct.sensor_point.y,
                    -2.0 + thickness * std::tan(inside) + sensor * std::tan(rad_from_deg(deg)),
                    20 * rounding_mm);
        EXPECT_NEAR(traced.direction.y, sine, 1e-15);
    }
}

TEST(Trace, WeightOfAPlatesGhostIsFresnels) {
    // Light stays in its own polarisation on a plate: T R R T for each, and their mean.
    constexpr double tolerance = 1e-13;
    const double n = 1.6;
    const OpticalSystem system =
        compile(lens_of({row(0.0, 3.0, n, 90.0), row(0.0, 10.0, 1.0, 90.0)}), d_line_nm);
    for (const double deg : {0.0, 30.0, 57.9946, 80.0})
        for (const double azimuth : {90.0, 0.0, 33.0}) {
            const double c1 = std::cos(rad_from_deg(deg));
            const double c2 = std::sqrt(1.0 - (1.0 - c1 * c1) / (n * n));
            const double rs = std::pow((c1 - n * c2) / (c1 + n * c2), 2);
            const double rp = std::pow((n * c1 - c2) / (n * c1 + c2), 2);
            const Ray in = ray_at_entrance({deg, azimuth}, 0.3, 0.2);
            const TracedRay ghost = trace_ray(system, parse_ghost("2-1", system), in);
            auto path = [](double r) { return (1.0 - r) * r * r * (1.0 - r); };
            EXPECT_NEAR(ghost.weight_s, path(rs), tolerance);
            EXPECT_NEAR(ghost.weight_p, path(rp), tolerance);
            EXPECT_NEAR(ghost.weight, 0.5 * (path(rs) + path(rp)), tolerance);
            EXPECT_NEAR(ghost.weight_average, path(0.5 * (rs + rp)), tolerance);
            const TracedRay direct = trace_ray(system, {}, in);
            EXPECT_NEAR(direct.weight_s, std::pow(1.0 - rs, 2), tolerance);
            EXPECT_NEAR(direct.weight_p, std::pow(1.0 - rp, 2), tolerance);
        }
}

/// The lens the other way round, its sensor one mm beyond.
Prescription turned_round(const Prescription& lens) {
    Prescription other = lens;
    other.surfaces.clear();
    for (std::size_t i = lens.surfaces.size(); i-- > 0;) {
        Surface surface = lens.surfaces[i];
        surface.curve = Curvature{-curvature_per_mm(surface.curve)};
        for (double& a : surface.aspheric) a = -a;
        surface.thickness_mm = i > 0 ? lens.surfaces[i - 1].thickness_mm : 1.0;
        surface.medium_after = medium_before(lens, i);
        other.surfaces.push_back(surface);
    }
    other.stop.surface = lens.surfaces.size() - 1 - lens.stop.surface;
    return other;
}

TEST(Trace, LightReturnsOnItsOwnPath) {
    constexpr double tolerance_mm = 1e-9;  // digits lost where the beam is magnified
    constexpr double weight_tolerance = 1e-11;
    for (const char* file : {"tessar_brendel_100_f2.8", "fisheye_nikkor_10.5_f2.8",
                             "nikkor_z_14_30_f4_wide", "canon_zoom_70_200_f2.8"}) {
        Prescription lens = bundled(file);
        for (Surface& surface : lens.surfaces) surface.coating = Uncoated{};
        const OpticalSystem forward = compile(lens, d_line_nm);
        const OpticalSystem backward = compile(turned_round(lens), d_line_nm);
        const double last = forward.surfaces.back().vertex_z_mm;
        const std::size_t count = forward.surfaces.size();
        Random random(21);
        int compared = 0;
        for (int i = 0; i < 400 && compared < 60; ++i) {
            GhostPath ghost, mirrored;
            const auto all = two_reflection_ghosts(forward);
            if (i % 4 != 0) {
                ghost = all[static_cast<std::size_t>(
                    random.integer(0, static_cast<int>(all.size()) - 1))];
                // The last to reflect is the first on the way back.
                mirrored.reflections = {count - 1 - ghost.reflections[1],
                                        count - 1 - ghost.reflections[0]};
            }
            const double field = random.between(0.0, 10.0);
            const Ray in = ray_at_entrance({field, random.between(0.0, 360.0)},
                                           random.between(-6.0, 6.0), random.between(-6.0, 6.0));
            const TracedRay there = trace_ray(forward, ghost, in);
            if (!there.status.reaches_sensor()) continue;
            // In the turned lens z' = last − z.
            auto turned = [](const glm::dvec3& v) { return glm::dvec3(v.x, v.y, -v.z); };
            glm::dvec3 start = turned(there.sensor_point);
            start.z += last;
            const TracedRay back = trace_ray(backward, mirrored, {start, -turned(there.direction)});
            ASSERT_TRUE(back.status.reaches_sensor()) << file << to_string(back.status);
            ++compared;
            const glm::dvec3 out = -turned(back.direction);
            EXPECT_NEAR(glm::length(out - in.direction), 0.0, tolerance_mm) << file << name(ghost);
            // Its sensor plane is 1 mm before the entrance plane.
            const glm::dvec3 expected = in.origin - in.direction / in.direction.z;
            EXPECT_NEAR(back.sensor_point.x, expected.x, tolerance_mm) << file << name(ghost);
            EXPECT_NEAR(back.sensor_point.y, expected.y, tolerance_mm) << file << name(ghost);
            EXPECT_NEAR(back.weight, there.weight, weight_tolerance) << file << name(ghost);
            EXPECT_NEAR(back.weight_average, there.weight_average, weight_tolerance);
        }
        EXPECT_GE(compared, 30) << file;
    }
}

TEST(Trace, MirroredRaysStayMirrored) {
    const OpticalSystem system = compile(bundled("nikkor_z_58_f0.95_noct"), d_line_nm);
    for (const GhostPath& ghost : {GhostPath{}, GhostPath{{8, 2}}, GhostPath{{20, 5}}})
        for (const double x : {0.5, 7.0, 15.0}) {
            const TracedRay a = trace_ray(system, ghost, ray_at_entrance({12.0, 90.0}, x, 3.0));
            const TracedRay b = trace_ray(system, ghost, ray_at_entrance({12.0, 90.0}, -x, 3.0));
            EXPECT_EQ(a.status, b.status);
            EXPECT_EQ(a.sensor_point.x, -b.sensor_point.x);
            EXPECT_EQ(a.sensor_point.y, b.sensor_point.y);
            EXPECT_DOUBLE_EQ(a.weight, b.weight);
        }
}

TEST(Trace, TurningTheLightTurnsThePicture) {
    // Also of the weights: a wrong sign of p̂ would show here, off the axis.
    constexpr double tolerance_mm = 1e-9, weight_tolerance = 1e-12;
    const OpticalSystem system = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    for (const GhostPath& ghost : two_reflection_ghosts(system)) {
        const double px = 4.0, py = -6.0, field = 11.0;
        const TracedRay a = trace_ray(system, ghost, ray_at_entrance({field, 0.0}, px, py));
        for (const double azimuth : {17.0, 45.0, 90.0, 200.0}) {
            const double c = std::cos(rad_from_deg(azimuth)), s = std::sin(rad_from_deg(azimuth));
            const TracedRay b = trace_ray(
                system, ghost, ray_at_entrance({field, azimuth}, c * px - s * py, s * px + c * py));
            ASSERT_EQ(a.status, b.status) << name(ghost);
            if (!a.status.reaches_sensor()) continue;
            EXPECT_NEAR(b.sensor_point.x, c * a.sensor_point.x - s * a.sensor_point.y,
                        tolerance_mm);
            EXPECT_NEAR(b.sensor_point.y, s * a.sensor_point.x + c * a.sensor_point.y,
                        tolerance_mm);
            EXPECT_NEAR(b.weight, a.weight, weight_tolerance * a.weight) << name(ghost);
            EXPECT_NEAR(b.weight_s, a.weight_s, weight_tolerance * a.weight) << name(ghost);
            EXPECT_NEAR(b.weight_p, a.weight_p, weight_tolerance * a.weight) << name(ghost);
        }
    }
}

TEST(Trace, UnpolarisedLightIsTheMeanOfTwoPolarisations) {
    const OpticalSystem system = compile(bundled("double_gauss_tronnier_100_f2"), d_line_nm);
    for (const GhostPath& ghost : two_reflection_ghosts(system)) {
        const TracedRay traced = trace_ray(system, ghost, ray_at_entrance({9.0, 90.0}, 5.0, -7.0));
        if (!traced.status.reaches_sensor()) continue;
        EXPECT_EQ(traced.weight, 0.5 * (traced.weight_s + traced.weight_p));
        EXPECT_GT(traced.weight, 0.0);
        EXPECT_LT(traced.weight, 1.0);
    }
}

TEST(Trace, AlmostPlaneIsPlane) {
    // A slope of 2e-8 at 20 mm, doubled by each of two mirrors, over a path of up to 100 mm.
    constexpr double tolerance_mm = 1e-5;
    auto system = [](double radius) {
        return compile(lens_of({row(radius, 5.0, 1.5, 20.0), row(-radius, 50.0, 1.0, 20.0)}),
                       d_line_nm);
    };
    Prescription plane = lens_of({row(0.0, 5.0, 1.5, 20.0), row(0.0, 50.0, 1.0, 20.0)});
    const OpticalSystem flat = compile(plane, d_line_nm);
    for (const GhostPath& ghost : {GhostPath{}, GhostPath{{1, 0}}})
        for (const double radius : {1e9, -1e9}) {
            Prescription bent = plane;
            bent.surfaces[0].curve = Curvature{1.0 / radius};
            bent.surfaces[1].curve = Curvature{-1.0 / radius};
            const OpticalSystem curved = compile(bent, d_line_nm);
            const Ray in = ray_at_entrance({20.0, 60.0}, 6.0, 8.0);
            const TracedRay a = trace_ray(curved, ghost, in), b = trace_ray(flat, ghost, in);
            EXPECT_NEAR(a.sensor_point.x, b.sensor_point.x, tolerance_mm);
            EXPECT_NEAR(a.sensor_point.y, b.sensor_point.y, tolerance_mm);
            EXPECT_NEAR(a.weight, b.weight, 1e-7);
            const TracedRay c = trace_ray(system(radius), ghost, in);
            EXPECT_EQ(a.sensor_point, c.sensor_point);
        }
}

TEST(Trace, AlmostHemisphericalSurfaceTakesRaysToItsEdge) {
    // Clear radius 1 − 1e-9 of R: a ball lens half, refraction at nearly grazing incidence.
    const double radius = 10.0;
    const OpticalSystem system =
        compile(lens_of({row(radius, 10.0, 1.5, radius * (1.0 - 1e-9)), row(0.0, 5.0, 1.0, 20.0)}),
                d_line_nm);
    for (const double gap : {1e-3, 1e-6, 1e-8}) {
        const double height = radius * (1.0 - gap);
        const TracedRay traced = trace_ray(system, {}, ray_at_entrance({0.0, 90.0}, 0.0, height));
        ASSERT_FALSE(traced.hits.empty());
        EXPECT_NEAR(traced.hits[0].point.y, height, rounding_mm);
        const double cos1 = std::sqrt(gap * (2.0 - gap));
        EXPECT_NEAR(traced.hits[0].cos_incidence, cos1, 1e-7);
    }
    const TracedRay beside =
        trace_ray(system, {}, ray_at_entrance({0.0, 90.0}, 0.0, radius + 1e-9));
    EXPECT_EQ(beside.status, (RayStatus{RayFate::miss, 0}));
}

}  // namespace
}  // namespace ghostlight
