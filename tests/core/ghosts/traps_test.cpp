// Lenses at the edge of what can be: everything stays finite, and energy is not made.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/flare/flare_image.h"
#include "core/ghosts/ghost_table.h"
#include "core/ghosts/pupil.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

/// Tables and pictures without a NaN, and no ghost stronger than the light that enters.
void expect_sane(const Prescription& lens, const LightDirection& light, const std::string& what) {
    const auto table = ghost_table(lens, {.light = light, .tolerance = 0.05, .peaks = true});
    ASSERT_TRUE(table.has_value()) << what;
    const double a = lens.surfaces.front().semi_diameter_mm;
    for (const GhostRow& r : table->ghosts) {
        EXPECT_TRUE(std::isfinite(r.flux_mm2 + r.flux_error_mm2 + r.peak_per_e0 + r.centroid_x_mm +
                                  r.centroid_y_mm + r.rms_radius_mm + r.on_sensor))
            << what << " " << name(r.path);
        EXPECT_GE(r.flux_mm2, 0.0) << what << " " << name(r.path);
        EXPECT_LE(r.flux_mm2, 4.0 * a * a) << what << " " << name(r.path);
    }
    EXPECT_TRUE(std::isfinite(table->direct.flux_mm2)) << what;
    FlareRequest request;
    request.light = light;
    request.width_px = 64;
    request.grid = 12;
    const auto image = render_flare(lens, request);
    ASSERT_TRUE(image.has_value()) << what;
    for (const float v : image->irradiance) ASSERT_TRUE(std::isfinite(v) && v >= 0.0F) << what;
    EXPECT_LE(image->flux_on_sensor_mm2, image->flux_mm2 * 1.0001) << what;
}

Prescription doublet() {
    return lens_of({row(40.0, 6.0, 1.6), row(-30.0, 2.0, 1.7), row(-200.0, 5.0, 1.0),
                    row(0.0, 50.0, 1.0, 8.0)},
                   3);
}

TEST(Traps, StopAtTheFirstOrLastSurface) {
    for (const std::size_t stop : {std::size_t{0}, std::size_t{2}, std::size_t{3}}) {
        Prescription lens = doublet();
        lens.stop.surface = stop;
        expect_sane(lens, {7.0, 90.0}, "stop " + std::to_string(stop + 1));
    }
}

TEST(Traps, ZeroGapsAndCementedSurfaces) {
    Prescription lens = doublet();
    for (Surface& surface : lens.surfaces)
        if (&surface != &lens.surfaces.back()) surface.thickness_mm = 0.0;
    expect_sane(lens, {5.0, 90.0}, "no thickness");
    Prescription cemented = doublet();
    cemented.surfaces[1].medium_after = cemented.surfaces[0].medium_after;
    expect_sane(cemented, {5.0, 90.0}, "equal media");
    EXPECT_EQ(two_reflection_ghosts(compile(cemented, d_line_nm)).size(), 1U);
}

TEST(Traps, CoatingsOfNoThicknessOrANeighboursIndex) {
    for (const Coating& coating :
         {Coating{QuarterWave{550.0, medium(1.38), 0.0}},
          Coating{QuarterWave{550.0, medium(1.6), 1.0}},
          Coating{LayerStack{{{medium(1.0), 100.0, 0.0}}}}, Coating{LayerStack{}},
          Coating{LayerStack{{{medium(0.2), 30.0, 3.5}}}}})
        expect_sane(with_air_coating(doublet(), coating), {5.0, 90.0}, describe(coating));
}

TEST(Traps, StopOfATenthOfAMicron) {
    expect_sane(stopped_down(doublet(), 1e-4), {0.0, 90.0}, "1e-4 mm");
    expect_sane(stopped_down(doublet(), 1e-4), {9.0, 90.0}, "1e-4 mm off the axis");
}

TEST(Traps, RadiusBarelyAboveTheSemiDiameter) {
    Prescription lens = doublet();
    lens.surfaces[0].curve = Radius{10.0 * (1.0 + 1e-9)};
    lens.surfaces[0].thickness_mm = 12.0;
    expect_sane(lens, {0.0, 90.0}, "hemisphere");
    expect_sane(lens, {40.0, 90.0}, "hemisphere at 40 degrees");
    lens.surfaces[0].curve = Radius{9.0};
    expect_sane(lens, {0.0, 90.0}, "more than a hemisphere");
}

TEST(Traps, AlmostPlaneSurfaces) {
    Prescription lens = doublet();
    lens.surfaces[0].curve = Radius{1e9};
    lens.surfaces[2].curve = Radius{-1e9};
    expect_sane(lens, {5.0, 90.0}, "R = 1e9");
}

TEST(Traps, FieldsNear90Degrees) {
    for (const double field : {85.0, 89.0, 89.999, 90.0}) {
        expect_sane(doublet(), {field, 90.0}, std::to_string(field));
        expect_sane(bundled("cooke_triplet_50_f5"), {field, 12.0}, std::to_string(field));
    }
}

TEST(Traps, GhostFocusedOnTheSensor) {
    // The peak of a focused ghost is high and finite, and its flux the same as out of focus.
    Prescription lens = doublet();
    const OpticalSystem system = compile(lens, d_line_nm);
    for (const GhostPath& path : two_reflection_ghosts(system)) {
        const double shift = paraxial_ghost(system, path).focus_from_sensor_mm;
        if (lens.surfaces.back().thickness_mm + shift < 0.1) continue;
        Prescription focused = lens;
        focused.surfaces.back().thickness_mm += shift;
        expect_sane(focused, {0.0, 90.0}, "focus of " + name(path));
    }
}

/// Weak menisci one after another.
Prescription long_train(int surfaces) {
    std::vector<Surface> rows;
    for (int k = 0; k < surfaces; ++k)
        rows.push_back(row(k % 4 < 2 ? 150.0 + k : -170.0 - k, k % 2 == 0 ? 1.0 : 0.5,
                           k % 2 == 0 ? 1.5 : 1.0, 12.0));
    rows.back().thickness_mm = 40.0;
    return lens_of(rows, static_cast<std::size_t>(surfaces) / 2);
}

TEST(Traps, SixtySurfacesKeepTheirDigits) {
    constexpr double tolerance_mm = 1e-9;
    const OpticalSystem system = compile(long_train(60), d_line_nm);
    for (const GhostPath& path : {GhostPath{}, GhostPath{{59, 0}}, GhostPath{{40, 12}}}) {
        const TracedRay p = trace_ray(system, path, ray_at_entrance({3.0, 90.0}, 1.0, 2.0));
        const TracedRay m = trace_ray(system, path, ray_at_entrance({3.0, 90.0}, -1.0, 2.0));
        ASSERT_TRUE(p.status.reaches_sensor());
        EXPECT_NEAR(glm::dot(p.direction, p.direction), 1.0, 1e-14) << "unit length is kept";
        EXPECT_NEAR(p.sensor_point.x, -m.sensor_point.x, tolerance_mm);
        EXPECT_GT(p.weight, 0.0);
    }
}

TEST(TrapsSlow, SixtySurfacesHaveATable) {
    // 1770 ghosts.
    GhostTableRequest request{.light = {2.0, 90.0}, .tolerance = 0.5, .peaks = false};
    const auto table = ghost_table(long_train(60), request);
    ASSERT_TRUE(table.has_value());
    EXPECT_EQ(table->ghosts.size(), 1770U);
    for (const GhostRow& r : table->ghosts)
        ASSERT_TRUE(std::isfinite(r.flux_mm2 + r.flux_error_mm2 + r.rms_radius_mm));
    EXPECT_GT(table->direct.flux_mm2, table->ghosts.front().flux_mm2);
}

TEST(Traps, TwoHundredSurfacesAreTraced) {
    const OpticalSystem system = compile(long_train(200), d_line_nm);
    EXPECT_EQ(two_reflection_ghosts(system).size(), 200U * 199U / 2U);
    for (const GhostPath& path : {GhostPath{}, GhostPath{{199, 0}}, GhostPath{{150, 20}}}) {
        const TracedRay traced = trace_ray(system, path, ray_at_entrance({1.0, 90.0}, 0.2, 0.1));
        if (!traced.status.reaches_sensor()) continue;
        EXPECT_TRUE(std::isfinite(traced.sensor_point.y + traced.weight));
        EXPECT_NEAR(glm::dot(traced.direction, traced.direction), 1.0, 1e-14);
    }
    const BeamFrame frame = beam_frame({1.0, 90.0});
    Bundle<float> bundle;
    lay_grid({-5.0, 5.0, -5.0, 5.0}, 8, bundle);
    trace_bundle(trace_path<float>(system, {}), frame, Weights::polarised, bundle);
    for (std::size_t i = 0; i < bundle.size(); ++i)
        EXPECT_TRUE(std::isfinite(bundle.x_mm[i] + bundle.weight[i]));
}

}  // namespace
}  // namespace ghostlight
