// Fluxes against closed forms and against a second quadrature.
#include "core/ghosts/flux_quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/support/reference_flux.h"

namespace ghostlight {
namespace {

PathFlux flux_of(const OpticalSystem& system, const GhostPath& path, const LightDirection& light,
                 double share) {
    const PathQuadrature quadrature(system, path, beam_frame(light));
    PathFlux flux = quadrature.start();
    quadrature.refine(flux, share, 0.0, {});
    return flux;
}

TEST(FluxQuadrature, ThinBeamThroughASingletIsAreaTimesTransmission) {
    // On the axis of a weak lens: the surfaces are met at 90° within (r/f)².
    constexpr double share = 1e-4;
    constexpr double obliquity = 1e-6;  // (0.05/50)², relative
    const double n = 1.5, r = 0.05;
    const OpticalSystem system = compile(
        lens_of({row(0.0, 1.0, 1.0, r), row(100.0, 2.0, n), row(-100.0, 90.0, 1.0)}), d_line_nm);
    const PathFlux flux = flux_of(system, {}, {}, share);
    const double transmitted = 1.0 - std::pow((n - 1.0) / (n + 1.0), 2);
    const double expected = std::numbers::pi * r * r * transmitted * transmitted;
    EXPECT_NEAR(flux.sums.flux, expected, flux.error_mm2 + obliquity * expected);
    EXPECT_LE(flux.error_mm2, share * expected);
}

TEST(FluxQuadrature, TiltedPlateSeesTheProjectedArea) {
    // A round hole at 60°: π r² cos θ across the beam.
    constexpr double share = 1e-4;
    const OpticalSystem system = compile(lens_of({row(0.0, 5.0, 1.0, 3.0)}), d_line_nm);
    for (const double azimuth : {90.0, 0.0, 25.0}) {
        const PathFlux flux = flux_of(system, {}, {60.0, azimuth}, share);
        EXPECT_NEAR(flux.sums.flux, std::numbers::pi * 9.0 * 0.5, flux.error_mm2) << azimuth;
        // Its centroid is that of the hole, 5 mm on.
        const double shift = 5.0 * std::tan(rad_from_deg(60.0));
        EXPECT_NEAR(flux.sums.x / flux.sums.flux, shift * std::cos(rad_from_deg(azimuth)), 1e-3);
        EXPECT_NEAR(flux.sums.y / flux.sums.flux, shift * std::sin(rad_from_deg(azimuth)), 1e-3);
    }
}

TEST(FluxQuadrature, MomentsOfAUniformDisc) {
    constexpr double share = 1e-4;
    const double r = 3.0;
    OpticalSystem system = compile(lens_of({row(0.0, 5.0, 1.0, r)}), d_line_nm);
    system.sensor_width_mm = system.sensor_height_mm = 2.0;
    const PathFlux flux = flux_of(system, {}, {}, share);
    EXPECT_NEAR(flux.sums.r2 / flux.sums.flux, 0.5 * r * r, 5 * share * r * r);
    EXPECT_NEAR(flux.sums.on_sensor, 4.0, 1e-9) << "a square inside the disc";
}

TEST(FluxQuadrature, PolygonalStopHasItsArea) {
    constexpr double share = 1e-4;
    Prescription lens = lens_of({row(0.0, 5.0, 1.0, 3.0)});
    lens.stop.blades = 6;
    lens.stop.rotation_deg = 10.0;
    const PathFlux flux = flux_of(compile(lens, d_line_nm), {}, {}, share);
    // Straight edges may be clipped exactly: then rounding is left.
    constexpr double rounding_mm2 = 1e-9;
    EXPECT_NEAR(flux.sums.flux, 1.5 * std::sqrt(3.0) * 9.0, flux.error_mm2 + rounding_mm2);
}

TEST(FluxQuadrature, TinyStopsPassTheirParaxialPreImage) {
    // On the axis, with all else open: π y² W, y the height that meets the stop's edge first.
    constexpr double share = 1e-3;
    constexpr double bend =
        1e-3;  // third order over the beam, below (0.03/30)² of it, and rounding
    for (const char* file : {"tessar_brendel_100_f2.8", "double_gauss_tronnier_100_f2"})
        for (const double stop_mm : {0.01, 1e-4}) {
            const OpticalSystem system = compile(stopped_down(bundled(file), stop_mm), d_line_nm);
            std::vector<GhostPath> paths = two_reflection_ghosts(system);
            paths.emplace_back();
            for (const GhostPath& path : paths) {
                const double y = paraxial_ghost(system, path).entrance_semi_diameter_mm;
                const double w = trace_ray(system, path, ray_at_entrance({}, 0.0, 0.0)).weight;
                const double expected = std::numbers::pi * y * y * w;
                if (y > 0.1) continue;  // the stop is not what limits it
                const PathFlux flux = flux_of(system, path, {}, share);
                EXPECT_NEAR(flux.sums.flux, expected, flux.error_mm2 + bend * expected)
                    << file << " " << name(path) << " stop " << stop_mm;
            }
        }
}

TEST(FluxQuadrature, TinyStopsOffTheAxisPassTheJacobiansPreImage) {
    // Newton to the stop's middle, then π r²/|∂(stop)/∂(u, v)| W.
    constexpr double share = 1e-3, bend = 1e-3;
    const double stop_mm = 1e-3;
    const OpticalSystem system =
        compile(stopped_down(bundled("tessar_brendel_100_f2.8"), stop_mm), d_line_nm);
    const LightDirection light{10.0, 90.0};
    const BeamFrame frame = beam_frame(light);
    int compared = 0;
    std::vector<GhostPath> paths = two_reflection_ghosts(system);
    paths.emplace_back();
    for (const GhostPath& path : paths) {
        if (paraxial_ghost(system, path).stop_crossings != 1) continue;
        auto at = [&](double u, double v) {
            return trace_ray(system, path, {u * frame.e1 + v * frame.e2, frame.direction});
        };
        double v = 0.0, jacobian = 0.0;
        constexpr double h = 1e-5;
        bool valid = true;
        for (int k = 0; k < 30 && valid; ++k) {
            const TracedRay here = at(0.0, v), up = at(0.0, v + h), side = at(h, v);
            valid = here.status.reaches_sensor() && up.status.reaches_sensor();
            if (!valid) break;
            const double slope = (up.stop_point.y - here.stop_point.y) / h;
            jacobian = std::abs(slope * (side.stop_point.x - here.stop_point.x) / h);
            v -= here.stop_point.y / slope;
        }
        const TracedRay chief = at(0.0, v);
        if (!valid || chief.status.fate != RayFate::ok || chief.r_rel > 0.99) continue;
        const double expected = std::numbers::pi * stop_mm * stop_mm / jacobian * chief.weight;
        const PathFlux flux = flux_of(system, path, light, share);
        EXPECT_NEAR(flux.sums.flux, expected, flux.error_mm2 + bend * expected) << name(path);
        ++compared;
    }
    EXPECT_GE(compared, 4);
}

void expect_second_quadrature(const char* file, const LightDirection& light, int stride, int cells,
                              double share) {
    const OpticalSystem system = compile(bundled(file), d_line_nm);
    std::vector<GhostPath> paths = two_reflection_ghosts(system);
    paths.insert(paths.begin(), GhostPath{});
    int compared = 0;
    for (std::size_t i = 0; i < paths.size(); i += static_cast<std::size_t>(stride)) {
        const PathFlux flux = flux_of(system, paths[i], light, share);
        const ReferenceFlux second =
            reference_flux(system, paths[i], beam_frame(light), cells, 51 + i);
        // A ray in each cell sees nothing smaller than some cells.
        const double grain =
            9.0 * entrance_box(system, beam_frame(light)).area_mm2() / (cells * cells) * 1e-3;
        if (second.flux_mm2 == 0.0 && flux.sums.flux < grain) continue;
        EXPECT_NEAR(flux.sums.flux, second.flux_mm2, flux.error_mm2 + 4.0 * second.sigma_mm2)
            << file << " " << name(paths[i]) << " at " << light.field_deg << ": stated "
            << flux.error_mm2 << ", sigma " << second.sigma_mm2;
        EXPECT_LE(flux.error_mm2, share * flux.sums.flux) << file << " " << name(paths[i]);
        ++compared;
    }
    EXPECT_GE(compared, 1) << file;
}

TEST(FluxQuadrature, AgreesWithASecondQuadrature) {
    constexpr int cells = 150;  // six times as many rays: 0.1 % of a smooth disc
    expect_second_quadrature("tessar_brendel_100_f2.8", {0.0, 90.0}, 6, cells, 0.01);
    expect_second_quadrature("tessar_brendel_100_f2.8", {15.0, 90.0}, 6, cells, 0.01);
    expect_second_quadrature("nikkor_z_14_30_f4_wide", {20.0, 40.0}, 60, cells, 0.01);
    expect_second_quadrature("fisheye_nikkor_10.5_f2.8", {88.0, 90.0}, 30, cells, 0.01);
}

TEST(FluxQuadratureSlow, AgreesWithASecondQuadratureAtOnePerMille) {
    constexpr int cells = 300;
    expect_second_quadrature("tessar_brendel_100_f2.8", {0.0, 90.0}, 3, cells, 0.002);
    expect_second_quadrature("cooke_triplet_50_f5", {18.0, 90.0}, 3, cells, 0.002);
    expect_second_quadrature("nikkor_z_58_f0.95_noct", {10.0, 90.0}, 120, cells, 0.002);
}

TEST(FluxQuadrature, LightThatCannotEnterHasNoFlux) {
    const OpticalSystem system = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    for (const double field : {70.0, 89.0, 90.0}) {
        const PathFlux flux = flux_of(system, {}, {field, 90.0}, 0.01);
        EXPECT_EQ(flux.sums.flux, 0.0);
        EXPECT_EQ(flux.error_mm2, 0.0);
    }
}

}  // namespace
}  // namespace ghostlight
