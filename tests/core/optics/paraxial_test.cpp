#include "core/optics/paraxial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "core/optics/trace.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

constexpr double relative = 1e-12;  // some tens of roundings

void expect_relative(double found, double expected, double tolerance = relative) {
    EXPECT_NEAR(found, expected, tolerance * std::abs(expected));
}

TEST(Paraxial, ThickLensObeysTheLensmaker) {
    const double n = 1.6, r1 = 40.0, r2 = -60.0, t = 8.0;
    const FirstOrder order =
        first_order(compile(lens_of({row(r1, t, n), row(r2, 50.0, 1.0)}), d_line_nm));
    const double power = (n - 1.0) * (1.0 / r1 - 1.0 / r2 + (n - 1.0) * t / (n * r1 * r2));
    expect_relative(order.efl_mm, 1.0 / power);
    expect_relative(order.bfd_mm, (1.0 - (n - 1.0) * t / (n * r1)) / power);
    expect_relative(order.ffd_mm, -(1.0 + (n - 1.0) * t / (n * r2)) / power);
    expect_relative(order.paraxial_defocus_mm, 50.0 - order.bfd_mm);
}

TEST(Paraxial, BallLens) {
    const double n = 1.5, r = 5.0;
    const FirstOrder order =
        first_order(compile(lens_of({row(r, 2 * r, n), row(-r, 5.0, 1.0)}), d_line_nm));
    expect_relative(order.efl_mm, n * r / (2.0 * (n - 1.0)));
    expect_relative(order.bfd_mm, order.efl_mm - r);
}

TEST(Paraxial, PupilsOfAStopBehindAThinLens) {
    // A thin lens of focal length f, the stop 10 mm behind: its image by 1/s' = 1/f − 1/s.
    const double n = 1.5, f = 50.0, stop = 10.0;
    const OpticalSystem system = compile(
        lens_of({row(0.0, 0.0, n), row(-(n - 1.0) * f, stop, 1.0), row(0.0, 30.0, 1.0, 4.0)}, 2),
        d_line_nm);
    const FirstOrder order = first_order(system);
    const double magnified = f / (f - stop);
    expect_relative(order.entrance_pupil_z_mm, stop * magnified);
    expect_relative(order.entrance_pupil_radius_mm, 4.0 * magnified);
    expect_relative(order.f_number, f / (8.0 * magnified));
    EXPECT_NEAR(order.exit_pupil_z_mm, 0.0, 1e-12) << "the stop is the last row";
    expect_relative(order.exit_pupil_radius_mm, 4.0);
}

TEST(Paraxial, WhatDoesNotExistIsInfinite) {
    const FirstOrder plate =
        first_order(compile(lens_of({row(0.0, 4.0, 1.5), row(0.0, 9.0, 1.0)}), d_line_nm));
    EXPECT_TRUE(std::isinf(plate.efl_mm));
    EXPECT_TRUE(std::isinf(plate.bfd_mm));
    EXPECT_TRUE(std::isinf(plate.f_number));
    // A stop in the front focal plane: telecentric on the image side.
    const OpticalSystem telecentric = compile(
        lens_of({row(0.0, 50.0, 1.0, 4.0), row(0.0, 0.0, 1.5), row(-25.0, 50.0, 1.0)}), d_line_nm);
    EXPECT_GT(std::abs(first_order(telecentric).exit_pupil_z_mm), 1e12);
}

TEST(Paraxial, GhostOfAPlateIsALongerPlate) {
    const double n = 1.6, t = 3.0, sensor = 10.0;
    const OpticalSystem system =
        compile(lens_of({row(0.0, t, n, 5.0), row(0.0, sensor, 1.0, 6.0)}), d_line_nm);
    const ParaxialGhost ghost = paraxial_ghost(system, {{1, 0}});
    EXPECT_DOUBLE_EQ(ghost.to_sensor.a, 1.0);
    EXPECT_DOUBLE_EQ(ghost.to_sensor.b, 3.0 * t / n + sensor);
    EXPECT_DOUBLE_EQ(ghost.to_sensor.c, 0.0);
    EXPECT_DOUBLE_EQ(ghost.to_sensor.d, 1.0);
    EXPECT_DOUBLE_EQ(ghost.diameter_mm, 10.0);
    EXPECT_TRUE(std::isinf(ghost.focus_from_sensor_mm));
    EXPECT_EQ(ghost.stop_crossings, 2) << "crossed once, and met again as a mirror";
}

TEST(Paraxial, MatricesKeepTheOpticalInvariant) {
    // det = n_in/n_out = 1 between air and air, whatever the reflections.
    constexpr double tolerance = 1e-9;  // entries up to 1e3, 60 matrices
    for (const char* file : {"tessar_brendel_100_f2.8", "canon_zoom_70_200_f2.8"}) {
        const OpticalSystem system = compile(bundled(file), d_line_nm);
        for (const GhostPath& path : two_reflection_ghosts(system)) {
            const ParaxialGhost ghost = paraxial_ghost(system, path);
            const RayMatrix& m = ghost.to_sensor;
            const double scale = std::abs(m.a * m.d) + std::abs(m.b * m.c) + 1.0;
            EXPECT_NEAR(m.a * m.d - m.b * m.c, 1.0, tolerance * scale) << name(path);
            // Where the ghost is in focus a collimated beam has no height: a + c x = 0.
            EXPECT_NEAR(m.a + m.c * ghost.focus_from_sensor_mm, 0.0, tolerance * scale);
        }
    }
}

TEST(Paraxial, StopCrossingsOfAGhost) {
    const OpticalSystem system = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    for (const GhostPath& path : two_reflection_ghosts(system)) {
        const bool straddles =
            path.reflections[1] < system.stop && path.reflections[0] > system.stop;
        const ParaxialGhost ghost = paraxial_ghost(system, path);
        EXPECT_EQ(ghost.stop_crossings, straddles ? 3 : 1) << name(path);
        const RayMatrix rebuilt = ghost.stop_to_sensor * ghost.to_stop;
        if (straddles) continue;
        EXPECT_NEAR(rebuilt.a, ghost.to_sensor.a, 1e-9 * std::abs(rebuilt.a) + 1e-9);
    }
}

/// |trace − matrix| for a ray of height and tangent `scale` times those given.
double third_order_error(const OpticalSystem& system, const GhostPath& path, double scale) {
    const double y = 1.2 * scale, u = 0.03 * scale;
    const RayMatrix m = paraxial_ghost(system, path).to_sensor;
    const TracedRay traced =
        trace_ray(system, path, ray_at_entrance({deg_from_rad(std::atan(u)), 90.0}, 0.0, y));
    EXPECT_TRUE(traced.status.reaches_sensor()) << name(path);
    return traced.sensor_point.y - (m.a * y + m.b * u);
}

TEST(Paraxial, TraceApproachesItAsTheThirdPower) {
    // Halving height and angle: 8 but for the fifth order, 2 with a wrong sign.
    constexpr double low = 7.6, high = 8.4;
    constexpr double rounding_mm = 1e-9;  // below it the ratio has no digits
    int compared = 0;
    for (const char* file : {"tessar_brendel_100_f2.8", "cooke_triplet_50_f5",
                             "double_gauss_tronnier_100_f2", "heliar_tronnier_100"}) {
        const OpticalSystem system = compile(bundled(file), d_line_nm);
        std::vector<GhostPath> paths = two_reflection_ghosts(system);
        paths.emplace_back();
        for (const GhostPath& path : paths) {
            const double whole = third_order_error(system, path, 0.1);
            const double half = third_order_error(system, path, 0.05);
            if (std::abs(half) < rounding_mm) continue;
            EXPECT_GT(whole / half, low) << file << " " << name(path);
            EXPECT_LT(whole / half, high) << file << " " << name(path);
            ++compared;
        }
    }
    EXPECT_GT(compared, 80);
}

TEST(Paraxial, ConicsAndAspheresAreTheirVertexSpheres) {
    Surface conic = row(30.0, 5.0, 1.6, 10.0, -3.0);
    conic.aspheric = {1e-5, -2e-8};
    const OpticalSystem curved = compile(lens_of({conic, row(0.0, 40.0, 1.0)}), d_line_nm);
    const OpticalSystem sphere =
        compile(lens_of({row(30.0, 5.0, 1.6), row(0.0, 40.0, 1.0)}), d_line_nm);
    EXPECT_EQ(first_order(curved).efl_mm, first_order(sphere).efl_mm);
    EXPECT_EQ(paraxial_ghost(curved, {{1, 0}}).to_sensor,
              paraxial_ghost(sphere, {{1, 0}}).to_sensor);
}

TEST(Paraxial, FresnelNumberOfAnApertureInParallelLight) {
    // No lens: N = a²/(λ z).
    const OpticalSystem system = compile(lens_of({row(0.0, 80.0, 1.0, 0.5)}), 500.0);
    const ParaxialGhost direct = paraxial_ghost(system, {});
    expect_relative(direct.fresnel_number, 0.25 / (500e-6 * 80.0));
    // In a medium of index n the wave is shorter.
    const OpticalSystem inside =
        compile(lens_of({row(0.0, 1.0, 1.5), row(0.0, 80.0, 1.5, 0.5)}, 1), 500.0);
    expect_relative(paraxial_ghost(inside, {}).fresnel_number, 1.5 * 0.25 / (500e-6 * 80.0));
}

TEST(Paraxial, AgreesWithASeparateProgram) {
    constexpr double tolerance = 1e-9;  // relative, what the values' source states
    const std::string folder = (test_data_folder() / "expected/").string();
    const Prescription lens = read_lens(folder + "tessar_brendel_100_f2.8.json").lens;
    std::ifstream file(folder + "first_order_tessar.json");
    const auto expected = nlohmann::json::parse(file);
    for (const auto& [line, nm] :
         {std::pair{"F", f_line_nm}, std::pair{"d", d_line_nm}, std::pair{"C", c_line_nm}}) {
        const FirstOrder order = first_order(compile(lens, nm));
        const auto& e = expected[line];
        expect_relative(order.efl_mm, e["efl"].get<double>(), tolerance);
        expect_relative(order.bfd_mm, e["bfd"].get<double>(), tolerance);
        expect_relative(order.ffd_mm, e["ffd"].get<double>(), tolerance);
        expect_relative(order.exit_pupil_radius_mm, e["exit_pupil_radius"].get<double>(),
                        tolerance);
        expect_relative(order.entrance_pupil_z_mm, e["entrance_pupil_z"].get<double>(), tolerance);
    }
    const OpticalSystem system = compile(lens, d_line_nm);
    std::ifstream table(folder + "paraxial_tessar.csv");
    std::string text;
    std::getline(table, text);
    int compared = 0;
    while (std::getline(table, text)) {
        std::istringstream fields(text);
        std::vector<double> v;
        for (std::string word; std::getline(fields, word, ',');) v.push_back(std::stod(word));
        if (v[0] < 0) continue;
        const GhostPath path{{static_cast<std::size_t>(v[0]), static_cast<std::size_t>(v[1])}};
        const ParaxialGhost ghost = paraxial_ghost(system, path);
        // Heights and slopes along z there, along travel here: the same after two reflections.
        expect_relative(ghost.to_sensor.a, v[2], tolerance);
        expect_relative(ghost.to_sensor.b, v[3], tolerance);
        expect_relative(ghost.to_sensor.c, v[4], tolerance);
        expect_relative(ghost.to_sensor.d, v[5], tolerance);
        expect_relative(ghost.focus_from_sensor_mm, v[7], tolerance);
        expect_relative(0.5 * ghost.diameter_mm, v[10], tolerance);
        EXPECT_EQ(ghost.stop_crossings, static_cast<int>(v[14]));
        ++compared;
    }
    EXPECT_EQ(compared, 21);
}

}  // namespace
}  // namespace ghostlight
