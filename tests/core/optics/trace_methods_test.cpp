// The trace against second routes to the same numbers: the unfolded lens, another form of the same
// surface, and derivatives by differences.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "core/optics/trace.h"
#include "core/optics/trace_path.h"
#include "core/optics/trace_steps.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

using Long = long double;
struct Vector {
    Long x, y, z;
};
Long dot_of(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// A mirror in an unfolded lens turns n into −n, and light goes on along +z over negative
/// thicknesses. Sequential trace in extended precision, sphere by sphere about its centre.
struct Unfolded {
    struct Face {
        Long gap, curvature, n_before, n_after;
    };
    std::vector<Face> faces;
    Long to_sensor = 0;
};

Unfolded unfold(const OpticalSystem& system, const GhostPath& ghost) {
    Unfolded lens;
    Long z = 0, sign = 1;
    for (const PathEvent& event : events(ghost, system.surfaces.size())) {
        const SurfaceAt& s = system.surfaces[event.surface];
        const Long n = sign * (event.forward ? s.n_before : s.n_after);
        const Long beyond = sign * (event.forward ? s.n_after : s.n_before);
        lens.faces.push_back(
            {s.vertex_z_mm - z, s.curvature_per_mm, n, event.reflects ? -n : beyond});
        if (event.reflects) sign = -sign;
        z = s.vertex_z_mm;
    }
    lens.to_sensor = system.sensor_z_mm - z;
    return lens;
}

/// False when the ray misses or is totally reflected.
bool trace_unfolded(const Unfolded& lens, Vector p, Vector d, Vector& at_sensor) {
    for (const auto& face : lens.faces) {
        p.z -= face.gap;
        if (face.curvature == 0) {
            const Long t = -p.z / d.z;
            p = {p.x + t * d.x, p.y + t * d.y, 0};
        } else {
            const Long r = 1 / face.curvature;
            const Vector q{p.x, p.y, p.z - r};
            const Long b = dot_of(q, d), under = b * b - dot_of(q, q) + r * r;
            if (under < 0) return false;
            const Long t = -b - (r > 0 ? 1 : -1) * std::sqrt(under);  // the side of the vertex
            p = {p.x + t * d.x, p.y + t * d.y, p.z + t * d.z};
        }
        const Long c = face.curvature;
        const Vector normal{-c * p.x, -c * p.y, 1 - c * p.z};
        const Long cosine = dot_of(d, normal), ratio = face.n_before / face.n_after;
        const Long under = 1 - ratio * ratio * (1 - cosine * cosine);
        if (under < 0) return false;
        const Long beyond = (cosine < 0 ? -1 : 1) * std::sqrt(under);
        const Long along_normal = beyond - ratio * cosine;
        d = {ratio * d.x + along_normal * normal.x, ratio * d.y + along_normal * normal.y,
             ratio * d.z + along_normal * normal.z};
    }
    const Long t = (lens.to_sensor - p.z) / d.z;
    at_sensor = {p.x + t * d.x, p.y + t * d.y, lens.to_sensor};
    return true;
}

TEST(TraceUnfolded, GhostsAreTheTraceOfTheUnfoldedLens) {
    constexpr double tolerance_mm = 1e-10;  // times (1 + |x| + |y|)/cos: rounding of 60 surfaces
    Random random(31);
    for (const char* file : {"tessar_brendel_100_f2.8", "double_gauss_tronnier_100_f2",
                             "canon_zoom_70_200_f2.8", "fisheye_nikkor_10.5_f2.8"}) {
        const OpticalSystem system = compile(bundled(file), f_line_nm);
        int compared = 0;
        for (const GhostPath& ghost : two_reflection_ghosts(system)) {
            const Unfolded lens = unfold(system, ghost);
            for (int i = 0; i < 3; ++i) {
                const Ray in =
                    ray_at_entrance({random.between(0.0, 25.0), random.between(0.0, 360.0)},
                                    random.between(-5.0, 5.0), random.between(-5.0, 5.0));
                const TracedRay ours = trace_ray(system, ghost, in);
                if (!ours.status.reaches_sensor()) continue;
                Vector at{};
                ASSERT_TRUE(trace_unfolded(lens, {in.origin.x, in.origin.y, in.origin.z},
                                           {in.direction.x, in.direction.y, in.direction.z}, at))
                    << file << name(ghost);
                const double scale =
                    (1.0 + std::abs(ours.sensor_point.x) + std::abs(ours.sensor_point.y)) /
                    std::pow(ours.direction.z, 2);
                EXPECT_NEAR(ours.sensor_point.x, static_cast<double>(at.x), tolerance_mm * scale);
                EXPECT_NEAR(ours.sensor_point.y, static_cast<double>(at.y), tolerance_mm * scale);
                ++compared;
            }
        }
        EXPECT_GE(compared, 20) << file;
    }
}

TEST(TraceAsphere, PowerSeriesOfAConicIsTheConic) {
    // z = Σ C_m (1+k)^(m−1) c^(2m−1) r^(2m); its difference from a sphere as aspheric terms.
    // At c²r² = 0.09 what follows 20 terms is 1e-20.
    constexpr double tolerance_mm = 1e-12, weight_tolerance = 1e-13;
    const double radius = 30.0, semi = 9.0;
    for (const double conic : {-2.0, -1.0, -0.4, 0.05}) {
        Prescription exact =
            lens_of({row(radius, 6.0, 1.6, semi, conic), row(0.0, 40.0, 1.0, 20.0)});
        Prescription series = exact;
        series.surfaces[0].conic = 0.0;
        double coefficient = 0.5, power = 1.0 / radius;
        for (int m = 2; m <= 20; ++m) {
            coefficient *= (2.0 * m - 3.0) / (2.0 * m);
            power /= radius * radius;
            series.surfaces[0].aspheric.push_back(coefficient * power *
                                                  (std::pow(1.0 + conic, m - 1) - 1.0));
        }
        const OpticalSystem a = compile(exact, d_line_nm), b = compile(series, d_line_nm);
        for (const GhostPath& ghost : {GhostPath{}, GhostPath{{1, 0}}})
            for (const double height : {-8.9, -3.0, 0.0, 1e-5, 5.0, 8.0})
                for (const double field : {0.0, 15.0}) {
                    const Ray in = ray_at_entrance({field, 90.0}, 0.5, height);
                    const TracedRay p = trace_ray(a, ghost, in), q = trace_ray(b, ghost, in);
                    EXPECT_EQ(p.status, q.status);
                    EXPECT_NEAR(p.sensor_point.x, q.sensor_point.x, 100 * tolerance_mm);
                    EXPECT_NEAR(p.sensor_point.y, q.sensor_point.y, 100 * tolerance_mm) << height;
                    EXPECT_NEAR(p.weight, q.weight, weight_tolerance);
                    EXPECT_NEAR(p.hits[0].point.z, q.hits[0].point.z, tolerance_mm);
                }
    }
}

TEST(TraceAsphere, HitsLieOnTheSurfaceAndOnTheRay) {
    constexpr double tolerance_mm = 1e-12;  // some ulps of the semi-diameter
    Surface wavy = row(40.0, 6.0, 1.6, 12.0, -0.7);
    wavy.aspheric = {-3e-5, 2e-7, -6e-10};
    const OpticalSystem system = compile(lens_of({wavy, row(0.0, 20.0, 1.0, 40.0)}), d_line_nm);
    Random random(32);
    for (int i = 0; i < 300; ++i) {
        const Ray in = ray_at_entrance({random.between(0.0, 50.0), random.between(0.0, 360.0)},
                                       random.between(-8.0, 8.0), random.between(-8.0, 8.0));
        const TracedRay traced = trace_ray(system, {}, in);
        if (traced.hits.empty()) continue;
        const glm::dvec3 p = traced.hits[0].point;
        const double r2 = p.x * p.x + p.y * p.y, c = 1.0 / 40.0;
        const double sag = c * r2 / (1.0 + std::sqrt(1.0 - 0.3 * c * c * r2)) +
                           r2 * r2 * (-3e-5 + r2 * (2e-7 - r2 * 6e-10));
        EXPECT_NEAR(p.z, sag, tolerance_mm);
        EXPECT_NEAR(glm::length(glm::cross(p - in.origin, in.direction)), 0.0, 10 * tolerance_mm);
    }
}

constexpr int parameter_count = 2;
using Jet = ceres::Jet<double, parameter_count>;

struct JetResult {
    Jet x, y, weight;
};

/// The trace on Jets: derivative 0 by the curvature of `surface`, 1 by the thickness after it.
JetResult trace_jets(const OpticalSystem& system, const GhostPath& ghost, std::size_t surface,
                     const LightDirection& light, double px, double py) {
    TracePath<Jet> path = trace_path<Jet>(system, ghost);
    const int row_number = static_cast<int>(surface);
    auto shift = [&](int at) { return at > row_number ? 1.0 : 0.0; };
    int before = 0;
    for (TraceStep<Jet>& step : path.steps) {
        if (step.surface == row_number) step.curvature.v[0] = 1.0;
        step.gap_mm.v[1] = shift(before) - shift(step.surface);
        before = step.surface;
    }
    path.sensor_gap_mm.v[1] = shift(before) - 1.0;
    const BeamFrame frame = beam_frame(light);
    RayAt<Jet> ray{{Jet(px), Jet(py), Jet(0.0)},
                   {Jet(frame.direction.x), Jet(frame.direction.y), Jet(frame.direction.z)}};
    JonesState<Jet> jones =
        jones_start<Jet>(Vec3<Jet>(Jet(frame.e1.x), Jet(frame.e1.y), Jet(frame.e1.z)));
    for (const TraceStep<Jet>& step : path.steps) {
        const Meeting<Jet> meeting = meet(step, path.aspheric.data(), Jet(1.0), ray);
        const Vec3<Jet> direction = ray.direction;
        turn(step, meeting, ray);
        if (!step.invisible)
            apply(amplitudes(step, path.layers.data(), meeting.cos_incidence), step.reflects,
                  meeting, direction, jones);
    }
    const Jet t = -(ray.position.z + path.sensor_gap_mm) / ray.direction.z;
    return {ray.position.x + t * ray.direction.x, ray.position.y + t * ray.direction.y,
            0.5 * (jones.intensity(0) + jones.intensity(1))};
}

TEST(TraceJets, DerivativesAreTheLimitOfDifferences) {
    // Five-point differences: relative truncation (h/scale)^4 and rounding 1e-12/h.
    constexpr double tolerance = 2e-6;
    for (const char* file : {"tessar_brendel_100_f2.8", "nikkor_z_14_30_f4_wide"}) {
        const Prescription lens = bundled(file);
        const OpticalSystem system = compile(lens, d_line_nm);
        const LightDirection light{8.0, 70.0};
        for (const std::size_t surface :
             {std::size_t{0}, std::size_t{1}, std::size_t{4}, std::size_t{6}})
            for (const GhostPath& ghost : {GhostPath{}, GhostPath{{6, 4}}, GhostPath{{5, 1}}}) {
                const double px = 1.5, py = -2.5;
                const TracedRay now = trace_ray(system, ghost, ray_at_entrance(light, px, py));
                if (!now.status.reaches_sensor()) continue;
                const JetResult jet = trace_jets(system, ghost, surface, light, px, py);
                EXPECT_NEAR(jet.x.a, now.sensor_point.x, 1e-9);
                EXPECT_NEAR(jet.weight.a, now.weight, 1e-12);
                for (int k = 0; k < parameter_count; ++k) {
                    const double h = k == 0 ? 2e-5 : 2e-3;  // 1/mm, mm
                    auto at = [&](double step) {
                        OpticalSystem changed = system;
                        if (k == 0) {
                            changed.surfaces[surface].curvature_per_mm += step;
                        } else {
                            for (std::size_t i = surface + 1; i < changed.surfaces.size(); ++i)
                                changed.surfaces[i].vertex_z_mm += step;
                            changed.sensor_z_mm += step;
                        }
                        return trace_ray(changed, ghost, ray_at_entrance(light, px, py));
                    };
                    const TracedRay p = at(h), m = at(-h), pp = at(2 * h), mm = at(-2 * h);
                    auto slope = [&](const std::function<double(const TracedRay&)>& value) {
                        return (8.0 * (value(p) - value(m)) - (value(pp) - value(mm))) / (12.0 * h);
                    };
                    auto expect = [&](const Jet& found,
                                      const std::function<double(const TracedRay&)>& value,
                                      double scale) {
                        EXPECT_NEAR(found.v[k], slope(value),
                                    tolerance * (scale + std::abs(slope(value))))
                            << file << " " << name(ghost) << " surface " << surface + 1 << " by "
                            << k;
                    };
                    const double per = k == 0 ? 1e3 : 1.0;
                    expect(
                        jet.x, [](const TracedRay& r) { return r.sensor_point.x; }, per);
                    expect(
                        jet.y, [](const TracedRay& r) { return r.sensor_point.y; }, per);
                    expect(
                        jet.weight, [](const TracedRay& r) { return r.weight; },
                        0.01 * per * now.weight);
                }
            }
    }
}

}  // namespace
}  // namespace ghostlight
