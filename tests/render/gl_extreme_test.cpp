// The stiff cases of tests/core/extreme_test.cpp drawn in single precision, by OpenGL and by the
// CPU, against the ghost table, which integrates in double precision and knows no pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/flare/planned_flare.h"
#include "core/ghosts/ghost_table.h"
#include "core/optics/mend.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "render/gl_flare/gl_flare.h"
#include "render/offscreen.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double asked = 0.01;         ///< of pictures
constexpr double table_asked = 0.002;  ///< of the table's fluxes

struct Drawn {
    FlareImage cpu, gl;
    double light_mm2 = 0.0;  ///< of all ghosts on the sensor, by the table
};

class GlExtreme : public testing::Test {
   protected:
    OffscreenContext context_;
    GlFlare gl_;

    Drawn draw(const Prescription& lens, const LightDirection& light) {
        FlareRequest request;
        request.light = light;
        request.width_px = 320;
        request.tolerance = asked;
        const FlareScene scene = flare_scene(lens, request.spectrum);
        Drawn drawn{*render_planned(scene, request), *gl_.render(scene, request), 0.0};
        const auto table =
            ghost_table(lens, {.light = light, .tolerance = table_asked, .peaks = false});
        for (const GhostRow& ghost : table->ghosts)
            drawn.light_mm2 += ghost.flux_mm2 * ghost.on_sensor;
        return drawn;
    }

    /// Both pictures hold the table's light and nothing that is no number.
    void expect_true(const Drawn& drawn, const std::string& what) {
        ASSERT_GT(drawn.light_mm2, 0.0) << what;
        for (const FlareImage* image : {&drawn.cpu, &drawn.gl}) {
            const char* engine = image == &drawn.cpu ? ", CPU" : ", OpenGL";
            for (const float e : image->irradiance)
                ASSERT_TRUE(std::isfinite(e) && e >= 0.0F) << what << engine << ": " << e;
            EXPECT_NEAR(image->flux_on_sensor_mm2 / drawn.light_mm2, 1.0, asked + table_asked)
                << what << engine;
        }
    }

    static double relative_l1(const FlareImage& a, const FlareImage& b) {
        double off = 0.0, sum = 0.0;
        for (std::size_t i = 0; i < a.irradiance.size(); ++i) {
            off += std::abs(static_cast<double>(a.irradiance[i] - b.irradiance[i]));
            sum += static_cast<double>(a.irradiance[i]);
        }
        return off / sum;
    }
};

Prescription plate(double back_radius_mm) {
    Prescription lens = lens_of({row(0.0, 6.0, 1.5, 8.0), row(back_radius_mm, 60.0, 1.0, 8.0)});
    lens.sensor.width_mm = 36.0;
    lens.sensor.height_mm = 24.0;
    return lens;
}

TEST_F(GlExtreme, ARadiusOfABillionIsAPlane) {
    const LightDirection light{4.0, 70.0};
    const Drawn plane = draw(plate(0.0), light);
    expect_true(plane, "plane");
    for (const double radius_mm : {1e9, -1e9}) {
        const Drawn nearly = draw(plate(radius_mm), light);
        expect_true(nearly, "1e9 mm");
        // Closer than a float of millimetres tells apart.
        EXPECT_LT(relative_l1(plane.gl, nearly.gl), 1e-4);
        EXPECT_LT(relative_l1(plane.cpu, nearly.cpu), 1e-4);
    }
}

TEST_F(GlExtreme, ARadiusBarelyAboveTheSemiDiameter) {
    Prescription lens = lens_of({row(8.0 * 1.0001, 6.0, 1.5, 8.0), row(-40.0, 20.0, 1.0, 8.0)});
    expect_true(draw(lens, {2.0, 90.0}), "1.0001 semi-diameters");
}

TEST_F(GlExtreme, AStopNearlyClosed) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    double before = 0.0;
    for (const double stop_mm : {0.1, 0.01}) {
        const Drawn drawn = draw(stopped_down(lens, stop_mm), {5.0, 90.0});
        expect_true(drawn, std::to_string(stop_mm));
        // Light goes as the stop's area, as all of it comes through the middle of the lens.
        if (before > 0.0) {
            EXPECT_NEAR(drawn.gl.flux_on_sensor_mm2 / before, 0.01, 0.01 * 2.0 * asked);
        }
        before = drawn.gl.flux_on_sensor_mm2;
    }
}

TEST_F(GlExtreme, ALensOfAnySizeIsTheSameLens) {
    const Prescription lens = bundled("heliar_tronnier_100");
    const LightDirection light{6.0, 40.0};
    const Drawn usual = draw(lens, light);
    expect_true(usual, "as it is");
    for (const double factor : {1e-3, 1e3}) {
        Prescription sized = scaled(lens, factor);
        sized.sensor.width_mm = factor * lens.sensor.width_mm;
        sized.sensor.height_mm = factor * lens.sensor.height_mm;
        const Drawn other = draw(sized, light);
        expect_true(other, std::to_string(factor));
        // Irradiance has no scale; the plan's choices stand, and so does all but rounding.
        EXPECT_LT(relative_l1(usual.gl, other.gl), asked);
        EXPECT_LT(relative_l1(usual.cpu, other.cpu), asked);
    }
}

TEST_F(GlExtreme, AGhostInFocusOnTheSensorKeepsItsLight) {
    Prescription lens = lens_of({row(200.0, 4.0, 1.5, 10.0), row(-200.0, 60.0, 1.0, 10.0)});
    lens.surfaces.back().thickness_mm +=
        paraxial_ghost(compile(lens, d_line_nm), GhostPath{{1, 0}}).focus_from_sensor_mm;
    lens.sensor.width_mm = lens.sensor.height_mm = 4.0;
    expect_true(draw(lens, {0.0, 90.0}), "on the axis");
    expect_true(draw(lens, {0.3, 20.0}), "beside it");
}

TEST_F(GlExtreme, GapsOfNothingAndOfAKilometre) {
    Prescription lens = plate(0.0);
    lens.surfaces.insert(lens.surfaces.begin() + 1, row(0.0, 0.0, 1.7, 8.0));
    expect_true(draw(lens, {3.0, 90.0}), "no gap");
    lens = plate(0.0);
    for (Surface& surface : lens.surfaces) surface.semi_diameter_mm = 1e4;
    lens.surfaces.back().thickness_mm = 1e6;
    lens.sensor.width_mm = lens.sensor.height_mm = 4e4;
    expect_true(draw(lens, {0.2, 90.0}), "a kilometre");
}

TEST_F(GlExtreme, TheFisheyesField) {
    const Prescription lens = bundled("fisheye_nikkor_10.5_f2.8");
    for (const double field_deg : {60.0, 85.0})
        expect_true(draw(lens, {field_deg, 90.0}), std::to_string(field_deg));
}

}  // namespace
}  // namespace ghostlight
