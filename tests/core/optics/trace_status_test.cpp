// What becomes of rays that do not pass, and at which surface.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/optics/trace.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

const Coating mirror = LayerStack{{{medium(2.0), 70.0, 0.0}}};

TracedRay at_height(const Prescription& lens, double py_mm, const char* ghost = "direct",
                    double field_deg = 0.0) {
    const OpticalSystem system = compile(lens, d_line_nm);
    return trace_ray(system, parse_ghost(ghost, system),
                     ray_at_entrance({field_deg, 90.0}, 0.0, py_mm));
}

TEST(TraceStatus, BesideASphereIsAMiss) {
    const Prescription lens =
        lens_of({row(0.0, 2.0, 1.0, 20.0), row(10.0, 5.0, 1.5, 9.0), row(0.0, 10.0, 1.5)});
    EXPECT_EQ(to_string(at_height(lens, 10.001).status), "miss:2");
    EXPECT_EQ(to_string(at_height(lens, 9.999).status), "clipped:2");
    EXPECT_EQ(to_string(at_height(lens, 8.0).status), "ok");
    EXPECT_EQ(at_height(lens, 10.001).hits.size(), 1U);
}

TEST(TraceStatus, BeyondTheCriticalAngleIsTotalReflection) {
    // Inside a plano-convex end the angle of incidence has the sine h/R.
    const Prescription lens = lens_of({row(0.0, 12.0, 1.5, 20.0), row(-10.0, 30.0, 1.0)});
    EXPECT_EQ(to_string(at_height(lens, 10.0 / 1.5 + 1e-6).status), "tir:2");
    EXPECT_EQ(to_string(at_height(lens, 10.0 / 1.5 - 1e-6).status), "ok");
    EXPECT_FALSE(at_height(lens, 8.0).status.reaches_sensor());
}

TEST(TraceStatus, AMirrorThatSendsLightOnwardsTurnsIt) {
    // A convex mirror struck above R/√2 does not send the ray back.
    Prescription lens = lens_of({row(0.0, 5.0, 1.0, 90.0), row(10.0, 5.0, 1.0, 10.0)});
    for (Surface& surface : lens.surfaces) surface.coating = mirror;
    EXPECT_EQ(to_string(at_height(lens, 7.2, "2-1").status), "turned:1");
    EXPECT_NE(to_string(at_height(lens, 6.9, "2-1").status), "turned:1");
    EXPECT_EQ(to_string(at_height(lens, 1.0, "2-1").status), "ok");
}

TEST(TraceStatus, LightTurnedAtTheLastSurfaceNeverReachesTheSensor) {
    // Concave first mirror struck steeply from inside: the ray leaves backwards.
    Prescription lens = lens_of({row(-10.0, 4.0, 1.0, 10.0), row(-300.0, 5.0, 1.0, 90.0)});
    for (Surface& surface : lens.surfaces) surface.coating = mirror;
    const TracedRay traced = at_height(lens, 8.0, "2-1");
    EXPECT_FALSE(traced.status.reaches_sensor());
    EXPECT_EQ(traced.status.fate, RayFate::turned);
}

TEST(TraceStatus, TheFirstClipInPathOrderIsNamedAndTheRayFollowed) {
    const Prescription lens = lens_of({row(0.0, 2.0, 1.5, 5.0), row(0.0, 2.0, 1.0, 4.0),
                                       row(0.0, 3.0, 1.0, 3.0), row(0.0, 10.0, 1.0, 2.0)},
                                      2);
    EXPECT_EQ(to_string(at_height(lens, 1.9).status), "ok");
    EXPECT_EQ(to_string(at_height(lens, 2.5).status), "clipped:4");
    EXPECT_EQ(to_string(at_height(lens, 3.5).status), "stop:3");
    EXPECT_EQ(to_string(at_height(lens, 4.5).status), "clipped:2");
    EXPECT_EQ(to_string(at_height(lens, 5.5).status), "clipped:1");
    const TracedRay clipped = at_height(lens, 5.5);
    EXPECT_TRUE(clipped.status.reaches_sensor());
    EXPECT_EQ(clipped.hits.size(), 4U);
    EXPECT_DOUBLE_EQ(clipped.sensor_point.y, 5.5);
    EXPECT_DOUBLE_EQ(clipped.stop_point.y, 5.5);
    EXPECT_DOUBLE_EQ(clipped.r_rel, 5.5 / 2.0) << "the stop does not count";
    EXPECT_GT(clipped.weight, 0.5);
}

TEST(TraceStatus, ClipsCountAtEveryCrossing) {
    // A ghost passes the stop three times; the light grows between the mirrors.
    Prescription lens = lens_of(
        {row(0.0, 10.0, 1.0, 50.0), row(0.0, 10.0, 1.0, 3.0), row(60.0, 10.0, 1.0, 50.0)}, 1);
    lens.surfaces[0].coating = lens.surfaces[2].coating = mirror;
    EXPECT_EQ(to_string(at_height(lens, 2.9, "direct").status), "ok");
    const TracedRay ghost = at_height(lens, 2.9, "3-1");
    EXPECT_EQ(to_string(ghost.status), "stop:2");
    int crossings = 0;
    for (const RayHit& hit : ghost.hits) crossings += hit.surface == 1 ? 1 : 0;
    EXPECT_EQ(crossings, 3);
    EXPECT_LT(ghost.hits[1].r_rel, 1.0);
    EXPECT_GT(ghost.stop_point.y, 3.0) << "of the last crossing";
}

TEST(TraceStatus, BeyondTheVertexHemisphereIsClipped) {
    // A point past the equator of a ball, lit from the side at 60°.
    const double radius = 10.0;
    const Prescription lens = lens_of({row(radius, 40.0, 1.5, radius), row(0.0, 5.0, 1.5, 500.0)});
    const OpticalSystem system = compile(lens, d_line_nm);
    const double a = rad_from_deg(20.0);
    auto aimed_at = [&](double z_sign) {
        const glm::dvec3 target(0.0, -radius * std::cos(a), radius + z_sign * radius * std::sin(a));
        const glm::dvec3 d = beam_frame({60.0, 90.0}).direction;
        return trace_ray(system, {}, {target - 100.0 * d, d});
    };
    const TracedRay beyond = aimed_at(+1.0);
    ASSERT_GE(beyond.hits.size(), 1U);
    EXPECT_NEAR(beyond.hits[0].point.z, radius + radius * std::sin(a), 1e-12);
    EXPECT_LT(beyond.r_rel, 1.0);
    EXPECT_EQ(to_string(beyond.status), "clipped:1");
    EXPECT_EQ(to_string(aimed_at(-1.0).status), "ok");
}

TEST(TraceStatus, FlatConicsAndHyperboloidsHaveNoEquator) {
    // 1 + k ≤ 0: every point belongs to the vertex's side.
    for (const double conic : {-1.0, -2.25}) {
        const Prescription lens =
            lens_of({row(4.0, 10.0, 1.5, 30.0, conic), row(0.0, 5.0, 1.0, 90.0)});
        EXPECT_EQ(at_height(lens, 25.0).status.fate == RayFate::miss, false);
        EXPECT_EQ(at_height(lens, 25.0).hits.size(), 2U) << conic;
    }
}

TEST(TraceStatus, WhatCannotReflectCarriesNoLight) {
    const Prescription lens = lens_of({row(0.0, 2.0, 1.0), row(0.0, 2.0, 1.5), row(0.0, 9.0, 1.0)});
    const OpticalSystem system = compile(lens, d_line_nm);
    const TracedRay traced = trace_ray(system, GhostPath{{2, 0}}, ray_at_entrance({}, 0.0, 1.0));
    EXPECT_EQ(traced.weight, 0.0);
    EXPECT_EQ(traced.weight_average, 0.0);
}

TEST(TraceStatus, LightFromTheSideIsFiniteUpTo90Degrees) {
    const OpticalSystem system = compile(bundled("fisheye_nikkor_10.5_f2.8"), d_line_nm);
    for (const double field : {60.0, 85.0, 88.0, 89.99, 90.0})
        for (const double v : {-20.0, 0.0, 20.0}) {
            const BeamFrame frame = beam_frame({field, 90.0});
            const TracedRay traced = trace_ray(system, {}, {v * frame.e2, frame.direction});
            if (!traced.status.reaches_sensor()) continue;
            EXPECT_TRUE(std::isfinite(traced.sensor_point.y + traced.weight + traced.r_rel));
        }
}

}  // namespace
}  // namespace ghostlight
