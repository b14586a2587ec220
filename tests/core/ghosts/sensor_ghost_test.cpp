// Ghosts that turn at the sensor, against the same lens with one more surface in its place.

#include <gtest/gtest.h>

#include <numbers>

#include "core/flare/flare_image.h"
#include "core/ghosts/bundle.h"
#include "core/ghosts/ghost_table.h"
#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double tolerance_mm = 1e-9;      // rounding over twenty surfaces
constexpr double weight_tolerance = 1e-9;  // relative, the same

Prescription with_sensor(Prescription lens, SensorReflectance reflectance) {
    lens.sensor.reflectance = std::move(reflectance);
    return lens;
}

SensorFilms two_layers() {
    return {{{{medium(1.46), 80.0, 0.0}, {medium(2.1), 45.0, 0.0}}}, medium(3.5)};
}

/// The lens with the sensor's films on a surface of its own, the sensor just behind it.
Prescription with_extra_surface(Prescription lens, const SensorFilms& films) {
    Surface extra;
    extra.medium_after = films.substrate;
    extra.coating = films.stack;
    extra.semi_diameter_mm = 200.0;
    lens.surfaces.push_back(extra);
    return lens;
}

TEST(SensorGhost, IsTheGhostOfAnExtraSurfaceInItsPlace) {
    const Prescription lens = bundled("double_gauss_tronnier_100_f2");
    const OpticalSystem sensor = compile(with_sensor(lens, two_layers()), 550.0);
    const OpticalSystem extra = compile(with_extra_surface(lens, two_layers()), 550.0);
    const std::size_t n = lens.surfaces.size();
    Random random(11);
    int compared = 0;
    for (std::size_t j = 0; j < n; ++j) {
        if (!sensor.surfaces[j].reflects) continue;
        for (int k = 0; k < 40; ++k) {
            const LightDirection light{random.between(0.0, 5.0), random.between(0.0, 360.0)};
            const Ray ray =
                ray_at_entrance(light, random.between(-15.0, 15.0), random.between(-15.0, 15.0));
            const TracedRay a = trace_ray(sensor, {{n, j}}, ray);
            const TracedRay b = trace_ray(extra, {{n, j}}, ray);
            if (!a.status.reaches_sensor() || !b.status.reaches_sensor()) continue;
            EXPECT_NEAR(a.sensor_point.x, b.sensor_point.x, tolerance_mm);
            EXPECT_NEAR(a.sensor_point.y, b.sensor_point.y, tolerance_mm);
            // The extra surface is crossed once more at the end.
            const double before = b.hits[b.hits.size() - 2].intensity;
            EXPECT_NEAR(a.weight, before, weight_tolerance * before) << "j = " << j;
            ++compared;
        }
    }
    EXPECT_GT(compared, 200);
}

TEST(SensorGhost, OnlyTheRectangleReflects) {
    Prescription lens = with_sensor(bundled("tessar_brendel_100_f2.8"), UniformReflectance{0.05});
    lens.sensor.width_mm = 8.0;
    lens.sensor.height_mm = 30.0;
    const OpticalSystem system = compile(lens, d_line_nm);
    const GhostPath ghost = parse_ghost("sensor-3", system);
    // The image of a light at 4 degrees lies 7 mm from the axis: inside along y, outside along x.
    EXPECT_EQ(trace_ray(system, ghost, ray_at_entrance({4.0, 90.0}, 0.0, 0.0)).status.fate,
              RayFate::ok);
    const TracedRay outside = trace_ray(system, ghost, ray_at_entrance({4.0, 0.0}, 0.0, 0.0));
    EXPECT_EQ(outside.status, (RayStatus{RayFate::clipped, lens.surfaces.size()}));
    EXPECT_NEAR(outside.hits[lens.surfaces.size()].r_rel,
                std::abs(outside.hits[lens.surfaces.size()].point.x) / 4.0, 1e-12);
}

TEST(SensorGhost, FluxBehindAPlateIsTheProductOfItsCoefficients) {
    // Stop of 5 mm, a plane plate, the sensor: at normal incidence every ghost is the stop's disc.
    Prescription lens = lens_of({row(0.0, 2.0, 1.0, 5.0), row(0.0, 4.0, 1.5), row(0.0, 20.0, 1.0)});
    lens = with_sensor(lens, UniformReflectance{0.1});
    const double r = 0.04, t = 0.96, disc = std::numbers::pi * 25.0;
    const auto table = ghost_table(lens, {.light = {}, .tolerance = 1e-3, .peaks = false});
    ASSERT_TRUE(table.has_value());
    ASSERT_EQ(table->ghosts.size(), 3U);
    EXPECT_EQ(name(table->ghosts[0].path, table->surface_count), "sensor-3");
    EXPECT_EQ(name(table->ghosts[1].path, table->surface_count), "sensor-2");
    const double tolerance = 2e-3;  // relative: twice what was asked
    const double near = disc * t * t * 0.1 * r, far = near * t * t;
    EXPECT_NEAR(table->ghosts[0].flux_mm2, near, tolerance * near);
    EXPECT_NEAR(table->ghosts[1].flux_mm2, far, tolerance * far);
    EXPECT_NEAR(table->ghosts[0].turns[0].reflectance, 0.1, 1e-12);
    EXPECT_NEAR(table->ghosts[0].turns[1].reflectance, r, 1e-12);
    // The beam's section, and its footprint: at normal incidence the same disc.
    EXPECT_NEAR(table->ghosts[0].pupil_area_mm2, disc, tolerance * disc);
    EXPECT_NEAR(table->ghosts[0].area_mm2, disc, tolerance * disc);
    EXPECT_NEAR(table->ghosts[0].box.x1_mm, 5.0, 0.02);
    EXPECT_NEAR(table->ghosts[0].vignetting, 0.0, tolerance);
}

TEST(SensorGhost, BundlesFollowSingleRays) {
    const OpticalSystem system =
        compile(with_sensor(bundled("tessar_brendel_100_f2.8"), two_layers()), d_line_nm);
    const LightDirection light{2.0, 70.0};
    const BeamFrame frame = beam_frame(light);
    const GhostPath ghost = parse_ghost("sensor-5", system);
    Bundle<double> rays;
    Random random(5);
    for (int k = 0; k < 300; ++k) {
        rays.u_mm.push_back(random.between(-18.0, 18.0));
        rays.v_mm.push_back(random.between(-18.0, 18.0));
    }
    trace_bundle(trace_path<double>(system, ghost), frame, Weights::polarised, rays);
    int compared = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const glm::dvec3 origin = rays.u_mm[k] * frame.e1 + rays.v_mm[k] * frame.e2;
        const TracedRay one = trace_ray(system, ghost, {origin, frame.direction});
        if (!one.status.reaches_sensor()) continue;
        EXPECT_NEAR(rays.x_mm[k], one.sensor_point.x, tolerance_mm);
        EXPECT_NEAR(rays.r_rel[k], one.r_rel, 1e-9);
        EXPECT_NEAR(rays.weight[k], one.weight, weight_tolerance * one.weight);
        ++compared;
    }
    EXPECT_GT(compared, 50);
}

TEST(SensorGhost, FluxIsProportionalToTheReflectance) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    auto total = [&](double share) {
        double sum = 0.0;
        const auto table = ghost_table(with_sensor(lens, UniformReflectance{share}),
                                       {.light = {1.0, 90.0}, .tolerance = 0.05, .peaks = false});
        for (const GhostRow& row : table->ghosts)
            if (row.path.reflections[0] == lens.surfaces.size()) sum += row.flux_mm2;
        return sum;
    };
    const double one = total(0.1);
    EXPECT_GT(one, 0.0);
    EXPECT_NEAR(total(0.2), 2.0 * one, 1e-9 * one);
}

TEST(SensorGhost, PictureHoldsTheTablesFlux) {
    const Prescription lens =
        with_sensor(bundled("double_gauss_tronnier_100_f2"), UniformReflectance{0.08});
    // The rectangle is not symmetric about the second light's plane.
    for (const double azimuth : {90.0, 30.0}) {
        const LightDirection light{5.0, azimuth};
        const auto table = ghost_table(lens, {.light = light, .peaks = false});
        double flux = 0.0, sensor = 0.0;
        for (const GhostRow& row : table->ghosts) {
            const double on_sensor = row.flux_mm2 * row.on_sensor;
            flux += on_sensor;
            if (row.path.reflections[0] == lens.surfaces.size()) sensor += on_sensor;
        }
        EXPECT_GT(sensor, 0.1 * flux);  // the picture without them would be seen to be wrong
        FlareRequest request;
        request.light = light;
        request.width_px = 640;
        const auto image = render_flare(lens, request);
        constexpr double picture_tolerance = 0.03;  // the picture's own 2 %, and the table's 1 %
        EXPECT_NEAR(image->flux_on_sensor_mm2, flux, picture_tolerance * flux) << azimuth;
    }
}

TEST(SensorGhost, IsOffUnlessAsked) {
    const OpticalSystem off = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    EXPECT_EQ(turning_count(off), off.surfaces.size());
    EXPECT_NE(error_of([&] { parse_ghost("sensor-3", off); }).problem.find("does not reflect"),
              std::string::npos);
    const OpticalSystem none = compile(
        with_sensor(bundled("tessar_brendel_100_f2.8"), UniformReflectance{0.0}), d_line_nm);
    EXPECT_EQ(two_reflection_ghosts(none), two_reflection_ghosts(off));
}

TEST(SensorGhost, TableIsLinearBetweenItsEntries) {
    const Prescription lens = with_sensor(bundled("tessar_brendel_100_f2.8"),
                                          ReflectanceTable{{{400.0, 0.02}, {600.0, 0.06}}});
    EXPECT_DOUBLE_EQ(*compile(lens, 450.0).sensor_face->uniform_reflectance, 0.03);
    EXPECT_DOUBLE_EQ(*compile(lens, 390.0).sensor_face->uniform_reflectance, 0.02);
    EXPECT_DOUBLE_EQ(*compile(lens, 700.0).sensor_face->uniform_reflectance, 0.06);
}

TEST(SensorGhost, FaceMovesWithTheFocus) {
    Prescription lens = with_sensor(bundled("cooke_triplet_50_f5"), UniformReflectance{0.1});
    lens.sensor.at_paraxial_focus = true;
    const OpticalSystem system = compile(lens, d_line_nm);
    EXPECT_EQ(system.sensor_face->vertex_z_mm, system.sensor_z_mm);
}

}  // namespace
}  // namespace ghostlight
