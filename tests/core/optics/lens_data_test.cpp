// Principal points, ray tables and real apertures against closed forms and the expected values.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/ghosts/field_curves.h"
#include "core/optics/paraxial.h"
#include "core/optics/paraxial_rays.h"
#include "core/optics/real_rays.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

constexpr double relative = 1e-9;  // the expected values' own digits

TEST(LensData, AgreesWithTheIndependentTracer) {
    std::ifstream in(test_data_folder() / "expected" / "first_order_tessar.json");
    const auto expected = nlohmann::json::parse(in);
    const Prescription lens =
        read_lens(test_data_folder() / "expected/tessar_brendel_100_f2.8.json").lens;
    for (const auto& [line, nm] :
         {std::pair{"F", f_line_nm}, std::pair{"d", d_line_nm}, std::pair{"C", c_line_nm}}) {
        const FirstOrder order = first_order(compile(lens, nm));
        const auto& at = expected[line];
        auto near = [&](double found, const char* key) {
            const double value = at[key].get<double>();
            EXPECT_NEAR(found, value, relative * std::abs(value)) << line << " " << key;
        };
        near(order.front_principal_z_mm, "front_principal_z");
        near(order.rear_principal_z_mm, "rear_principal_from_last_vertex");
        near(order.total_track_mm, "total_track");
        // In air the nodal points are the principal points.
        EXPECT_NEAR(order.front_nodal_z_mm, order.front_principal_z_mm, 1e-9);
        EXPECT_NEAR(order.rear_nodal_z_mm, order.rear_principal_z_mm, 1e-9);
        EXPECT_NEAR(
            order.pupil_magnification,
            at["exit_pupil_radius"].get<double>() / at["entrance_pupil_radius"].get<double>(),
            relative);
    }
}

TEST(LensData, OfASingleSurfaceIntoGlass) {
    // One refracting surface: both principal points at its vertex, both nodal points at its centre.
    const double n = 1.5, r = 20.0;
    const FirstOrder order = first_order(compile(lens_of({row(r, 60.0, n)}), d_line_nm));
    EXPECT_NEAR(order.efl_mm, n * r / (n - 1.0), 1e-9);
    EXPECT_NEAR(order.front_principal_z_mm, 0.0, 1e-9);
    EXPECT_NEAR(order.rear_principal_z_mm, 0.0, 1e-9);
    EXPECT_NEAR(order.front_nodal_z_mm, r, 1e-9);
    EXPECT_NEAR(order.rear_nodal_z_mm, r, 1e-9);
    EXPECT_NEAR(order.petzval_per_mm, (n - 1.0) / (n * r), 1e-15);
}

TEST(LensData, PetzvalSumOfAThinLensIsItsPowerOverItsIndex) {
    const double n = 1.6;
    const FirstOrder order =
        first_order(compile(lens_of({row(50.0, 0.0, n), row(-80.0, 45.0, 1.0)}), d_line_nm));
    EXPECT_NEAR(order.petzval_per_mm, 1.0 / (n * order.efl_mm), 1e-15);
}

TEST(LensData, TheLagrangeInvariantIsOne) {
    for (const char* file : {"tessar_brendel_100_f2.8", "canon_zoom_70_200_f2.8",
                             "fisheye_nikkor_10.5_f2.8", "nikkor_z_58_f0.95_noct"}) {
        const OpticalSystem system = compile(bundled(file), 546.1);
        const FirstOrder order = first_order(system);
        const double tangent = 0.2;
        const auto rays = paraxial_rays(system, tangent);
        ASSERT_EQ(rays.size(), system.surfaces.size() + 1);
        // In front: u = 0, and the marginal height is the entrance pupil's radius.
        const double expected = -tangent * order.entrance_pupil_radius_mm;
        for (const ParaxialRaysAt& at : rays)
            EXPECT_NEAR(at.lagrange_mm, expected, 1e-11 * std::abs(expected)) << file;
        // Both rays at the stop, and where they end.
        EXPECT_NEAR(std::abs(rays[system.stop].marginal.y_mm), system.stop_mask.semi_diameter_mm,
                    1e-9);
        EXPECT_NEAR(rays[system.stop].chief.y_mm, 0.0, 1e-9);
        EXPECT_NEAR(rays.back().marginal.u * order.efl_mm, -order.entrance_pupil_radius_mm, 1e-9);
        EXPECT_NEAR(rays.back().chief.y_mm - rays.back().chief.u * order.paraxial_defocus_mm,
                    order.efl_mm * tangent, 1e-9);
    }
}

TEST(LensData, IncidencesAreThoseOfRealRaysNearTheAxis) {
    const OpticalSystem system = compile(bundled("double_gauss_tronnier_100_f2"), d_line_nm);
    constexpr double small = 1e-4;  // of the pupil: cubic errors are 1e-8 of the angle
    const double y = small * first_order(system).entrance_pupil_radius_mm;
    const TracedRay ray = trace_ray(system, {}, ray_at_entrance({0.0, 90.0}, 0.0, y));
    const auto rays = paraxial_rays(system, 0.0);
    for (std::size_t k = 0; k < system.surfaces.size(); ++k)
        EXPECT_NEAR(std::acos(std::min(1.0, ray.hits[k].cos_incidence)),
                    small * std::abs(rays[k].marginal.incidence), 2e-8)
            << k;
}

TEST(LensData, WorkingApertureOfAnAplanaticBall) {
    // A hemisphere's plane face first, the stop on it: sin u' = n sin(i − i') + … by Snell, by
    // hand.
    const double n = 1.5, r = 20.0, a = 4.0;
    const OpticalSystem system =
        compile(lens_of({row(0.0, 10.0, n, a), row(-r, 60.0, 1.0, 15.0)}), d_line_nm);
    const double i = std::asin(a / r);
    const double out = std::asin(n * a / r) - i;
    const auto aperture = real_aperture(system);
    ASSERT_TRUE(aperture.has_value());
    EXPECT_NEAR(aperture->numerical_aperture, std::sin(out), 1e-9);
    EXPECT_NEAR(aperture->working_f_number, 0.5 / std::sin(out), 1e-7);
}

TEST(LensData, ChiefRaysGoThroughTheStopsCentre) {
    const OpticalSystem system = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    const auto field = field_at_height_deg(system, 15.0);
    ASSERT_TRUE(field.has_value());
    const auto chief = ray_through_stop(system, *field, 0.0);
    ASSERT_TRUE(chief.has_value());
    EXPECT_NEAR(chief->stop_point.y, 0.0, 1e-8);
    EXPECT_NEAR(std::abs(chief->sensor_point.y), 15.0, 1e-6);
    EXPECT_FALSE(field_at_height_deg(system, 1e5).has_value());
}

TEST(FieldCurves, OfAPinholeAreCosineToTheFourth) {
    // A bare stop before the sensor: no distortion, no vignetting, T = 1, and cos⁴ θ exactly. Its
    // focal length is infinite, so distortion has no meaning; the image's scale is the distance.
    const OpticalSystem system = compile(lens_of({row(0.0, 100.0, 1.0, 0.5)}), d_line_nm);
    for (const FieldPoint& at : field_curves(system, 40.0, 5)) {
        const double cosine = std::cos(rad_from_deg(at.field_deg));
        constexpr double tolerance = 3e-3;  // thrice the flux's
        EXPECT_NEAR(at.relative_illumination, std::pow(cosine, 4), tolerance);
        EXPECT_NEAR(at.vignetting, 0.0, tolerance);
        EXPECT_NEAR(at.transmittance, 1.0, 1e-12);
        EXPECT_NEAR(at.image_height_mm, 100.0 * std::tan(rad_from_deg(at.field_deg)), 1e-6);
    }
}

TEST(FieldCurves, OfAThinLensAtItsStopAreNearlyCosineToTheFourth) {
    const double n = 1.5, f = 100.0;
    const OpticalSystem system =
        compile(lens_of({row(0.0, 0.0, 1.0, 1.0), row(0.0, 0.0, n), row(-(n - 1.0) * f, f, 1.0)}),
                d_line_nm);
    for (const FieldPoint& at : field_curves(system, 20.0, 5)) {
        const double cosine = std::cos(rad_from_deg(at.field_deg));
        const double transmitted = at.transmittance / 0.9216;  // (1 − 0.04)² on axis
        EXPECT_NEAR(at.relative_illumination, std::pow(cosine, 4) * transmitted, 3e-3);
        if (at.field_deg > 0.0) {
            EXPECT_NEAR(at.distortion, 0.0, 1e-3);
        }
    }
}

TEST(FieldCurves, PupilAreasAreThoseOfCountedRays) {
    const OpticalSystem system = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    const auto curves = field_curves(system, 12.0, 3);
    EXPECT_EQ(curves.front().vignetting, 0.0);
    EXPECT_EQ(curves.front().relative_illumination, 1.0);
    constexpr int across = 300;
    constexpr double half_mm = 25.0;
    for (const FieldPoint& at : curves) {
        const BeamFrame frame = beam_frame({at.field_deg, 90.0});
        int passed = 0;
        for (int i = 0; i < across; ++i)
            for (int j = 0; j < across; ++j) {
                const double u = half_mm * (2.0 * (i + 0.5) / across - 1.0);
                const double v = half_mm * (2.0 * (j + 0.5) / across - 1.0);
                const TracedRay ray =
                    trace_ray(system, {}, {u * frame.e1 + v * frame.e2, frame.direction});
                passed += ray.status.fate == RayFate::ok ? 1 : 0;
            }
        const double area = passed * std::pow(2.0 * half_mm / across, 2);
        EXPECT_NEAR(at.pupil_area_mm2, area, 0.005 * area) << at.field_deg;  // edges of the count
        EXPECT_NEAR(at.vignetting,
                    1.0 - at.pupil_area_mm2 / (curves.front().pupil_area_mm2 *
                                               std::cos(rad_from_deg(at.field_deg))),
                    1e-12);
    }
    EXPECT_GT(curves.back().vignetting, 0.1);
}

}  // namespace
}  // namespace ghostlight
