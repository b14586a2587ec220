#include "core/optics/optical_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/ghosts/ghost_path.h"
#include "core/optics/paraxial.h"
#include "core/optics/trace.h"
#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

Prescription singlet() {
    return lens_of({row(50.0, 4.0, 1.5), row(-50.0, 3.0, 1.0), row(0.0, 45.0, 1.0, 6.0)}, 2);
}

TEST(OpticalSystem, VerticesAddUpFromTheFirst) {
    const OpticalSystem system = compile(singlet(), d_line_nm);
    EXPECT_EQ(system.surfaces[0].vertex_z_mm, 0.0);
    EXPECT_EQ(system.surfaces[1].vertex_z_mm, 4.0);
    EXPECT_EQ(system.surfaces[2].vertex_z_mm, 7.0);
    EXPECT_EQ(system.sensor_z_mm, 52.0);
    EXPECT_EQ(system.surfaces[1].n_before, 1.5);
    EXPECT_EQ(system.surfaces[1].n_after, 1.0);
    EXPECT_TRUE(system.surfaces[0].reflects);
    EXPECT_FALSE(system.surfaces[2].reflects);
}

TEST(OpticalSystem, StopFollowsTheFNumber) {
    constexpr double relative = 1e-12;
    for (const double f_number : {5.6, 8.0, 22.0}) {
        Prescription lens = singlet();
        lens.stop.f_number = f_number;
        const OpticalSystem system = compile(lens, d_line_nm);
        EXPECT_NEAR(first_order(system).f_number, f_number, relative * f_number);
    }
}

TEST(OpticalSystem, StopIsCappedByItsRow) {
    Prescription lens = singlet();
    lens.stop.f_number = 0.5;
    EXPECT_EQ(compile(lens, d_line_nm).stop_mask.semi_diameter_mm, 6.0);
    lens.stop.f_number.reset();
    lens.stop.semi_diameter_mm = 60.0;
    EXPECT_EQ(compile(lens, d_line_nm).stop_mask.semi_diameter_mm, 6.0);
    lens.stop.semi_diameter_mm = 1e-4;
    EXPECT_EQ(compile(lens, d_line_nm).stop_mask.semi_diameter_mm, 1e-4);
}

TEST(OpticalSystem, FocusAndStopAreThoseOfTheDLineAtEveryWavelength) {
    Prescription lens = singlet();
    lens.surfaces[0].medium_after = {"", ModelGlass{1.5168, 30.0}};
    lens.sensor.at_paraxial_focus = true;
    lens.stop.f_number = 8.0;
    const OpticalSystem d = compile(lens, d_line_nm), f = compile(lens, f_line_nm);
    EXPECT_NEAR(first_order(d).paraxial_defocus_mm, 0.0, 1e-12);
    EXPECT_EQ(d.sensor_z_mm, f.sensor_z_mm);
    EXPECT_EQ(d.stop_mask.semi_diameter_mm, f.stop_mask.semi_diameter_mm);
    EXPECT_GT(f.surfaces[0].n_after, d.surfaces[0].n_after);
    EXPECT_GT(first_order(f).paraxial_defocus_mm, 0.1) << "blue focuses nearer to the lens";
}

TEST(OpticalSystem, LensesWithoutFocusAreRefusedWhereOneIsNeeded) {
    Prescription plate = lens_of({row(0.0, 4.0, 1.5), row(0.0, 9.0, 1.0)});
    plate.stop.f_number = 4.0;
    EXPECT_EQ(error_of([&] { compile(plate, d_line_nm); }).where, "stop.f_number");
    plate.stop.f_number.reset();
    plate.sensor.at_paraxial_focus = true;
    EXPECT_EQ(error_of([&] { compile(plate, d_line_nm); }).where, "sensor.distance_mm");
    Prescription diverging = lens_of({row(-50.0, 2.0, 1.5), row(50.0, 9.0, 1.0)});
    diverging.sensor.at_paraxial_focus = true;
    EXPECT_EQ(error_of([&] { compile(diverging, d_line_nm); }).where, "sensor.distance_mm");
}

TEST(OpticalSystem, TrailingZeroTermsLeaveASphere) {
    Prescription lens = singlet();
    lens.surfaces[0].aspheric = {0.0, 0.0};
    EXPECT_TRUE(compile(lens, d_line_nm).surfaces[0].aspheric.empty());
}

TEST(OpticalSystem, ConfigurationsOverrideThicknesses) {
    const Prescription zoom = bundled("canon_zoom_70_200_f2.8");
    ASSERT_EQ(zoom.configurations.size(), 3U);
    const double wide = first_order(compile(zoom, d_line_nm, "wide")).efl_mm;
    const double tele = first_order(compile(zoom, d_line_nm, "tele")).efl_mm;
    // The listing's own rounding: a few per mille of its nominal ends.
    EXPECT_NEAR(wide, 71.0, 3.0);
    EXPECT_NEAR(tele, 196.0, 6.0);
}

TEST(StopMask, RoundStopIsACircle) {
    const StopMask mask{2.0, 0, 0.0, 0.0};
    EXPECT_DOUBLE_EQ(stop_margin(mask, 0, 0.0, 0.0), 1.0);
    EXPECT_NEAR(stop_margin(mask, 0, 1.2, 1.6), 0.0, 1e-15);
    EXPECT_TRUE(stop_passes(mask, 1.99, 0.0));
    EXPECT_FALSE(stop_passes(mask, 1.5, 1.5));
}

TEST(StopMask, PolygonHasItsCornersOnTheCircle) {
    constexpr double step = 1e-9;
    for (const int blades : {3, 6, 9})
        for (const double curvature : {0.0, 0.5, 1.0}) {
            const double rotation = 0.3;
            const StopMask mask{2.0, blades, rotation, curvature};
            for (int k = 0; k < blades; ++k) {
                const double corner = rotation + 2.0 * std::numbers::pi * k / blades;
                auto passes = [&](double r, double phi) {
                    return stop_passes(mask, r * std::cos(phi), r * std::sin(phi));
                };
                EXPECT_TRUE(passes(2.0 - step, corner));
                EXPECT_FALSE(passes(2.0 + step, corner));
                if (curvature == 0.0) {
                    const double half = std::numbers::pi / blades;
                    EXPECT_TRUE(passes(2.0 * std::cos(half) - step, corner + half));
                    EXPECT_FALSE(passes(2.0 * std::cos(half) + step, corner + half));
                }
            }
        }
}

TEST(StopMask, BladesOfFullCurvatureAreTheCircle) {
    const StopMask round{1.5, 0, 0.0, 0.0}, blades{1.5, 7, 0.2, 1.0};
    for (double phi = 0.0; phi < 6.3; phi += 0.1)
        for (const double r : {1e-3, 0.7, 1.499, 1.501, 3.0})
            EXPECT_EQ(stop_passes(round, r * std::cos(phi), r * std::sin(phi)),
                      stop_passes(blades, r * std::cos(phi), r * std::sin(phi)));
}

TEST(StopMask, AreaOfAPolygon) {
    // Midpoints of a 1000² grid: an error of some perimeter × pitch^1.5.
    constexpr double tolerance = 2e-3;
    const double a = 1.0;
    for (const double curvature : {0.0, 0.6}) {
        const StopMask mask{a, 5, 0.1, curvature};
        int inside = 0;
        constexpr int n = 1000;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                inside +=
                    stop_passes(mask, (2.0 * i + 1.0) / n - 1.0, (2.0 * j + 1.0) / n - 1.0) ? 1 : 0;
        double area = 2.5 * a * a * std::sin(0.4 * std::numbers::pi);
        if (curvature > 0.0) {
            // Five segments of circles of radius a/curvature over the polygon's sides.
            const double r = a / curvature,
                         half = std::asin(a * std::sin(std::numbers::pi / 5) / r);
            area += 5.0 * r * r * (half - std::sin(half) * std::cos(half));
        }
        EXPECT_NEAR(4.0 * inside / (n * n), area, tolerance);
    }
}

}  // namespace
}  // namespace ghostlight
