// A row of the table and the layer of that ghost in the picture are one quantity by two routes:
// adaptive quadrature in double, and a raster of a uniform grid in float.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/flare/flare_image.h"
#include "core/ghosts/ghost_table.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

// The table's tolerance, and half of it for the grid; a faint ghost's edges matter less.
constexpr double picture_tolerance = 0.015;  // of the row's flux
constexpr double of_the_strongest = 0.002;

FlareImage layer(const Prescription& lens, const LightDirection& light, const GhostPath& path) {
    FlareRequest request;
    request.light = light;
    request.width_px = 320;
    request.grid = 128;  // fine enough that the edges' polygons are no part of the difference
    request.only = {path};
    return *render_flare(lens, request);
}

double integral(const FlareImage& image) {
    double sum = 0.0;
    for (const float value : image.irradiance) sum += static_cast<double>(value);
    return sum * image.sensor_width_mm / image.width_px * image.sensor_width_mm / image.width_px;
}

TEST(GhostLayer, HoldsTheFluxOfItsRow) {
    for (const char* file : {"tessar_brendel_100_f2.8", "double_gauss_tronnier_100_f2"}) {
        Prescription lens = bundled(file);
        lens.sensor.reflectance = UniformReflectance{0.06};
        const LightDirection light{4.0, 60.0};
        const auto table = ghost_table(lens, {.light = light, .peaks = false});
        const double floor = of_the_strongest * table->ghosts.front().flux_mm2;
        ASSERT_GT(table->ghosts.size(), 20U);
        for (std::size_t k = 0; k < 20; ++k) {
            const GhostRow& row = table->ghosts[k];
            const FlareImage image = layer(lens, light, row.path);
            EXPECT_NEAR(image.flux_mm2, row.flux_mm2, picture_tolerance * row.flux_mm2 + floor)
                << file << " " << name(row.path, table->surface_count);
            const double on_sensor = row.flux_mm2 * row.on_sensor;
            EXPECT_NEAR(integral(image), on_sensor, picture_tolerance * on_sensor + floor)
                << file << " " << name(row.path, table->surface_count);
        }
    }
}

TEST(GhostLayer, OfTheDirectPathHoldsTheImage) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    for (const double field : {0.0, 6.0}) {
        const LightDirection light{field, 90.0};
        const auto table = ghost_table(lens, {.light = light, .peaks = false});
        // It lands within a few pixels, all of it on the sensor.
        const FlareImage image = layer(lens, light, {});
        EXPECT_NEAR(integral(image), table->direct.flux_mm2,
                    picture_tolerance * table->direct.flux_mm2)
            << field;
    }
}

TEST(GhostLayer, LayersAddUpToThePicture) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    const LightDirection light{7.0, 90.0};
    FlareRequest request;
    request.light = light;
    request.width_px = 200;
    request.method = FlareMethod::uniform;
    const FlareImage all = *render_flare(lens, request);
    std::vector<double> sum(all.irradiance.size(), 0.0);
    for (const GhostPath& path : two_reflection_ghosts(compile(lens, 587.5618))) {
        request.only = {path};
        const FlareImage one = *render_flare(lens, request);
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += static_cast<double>(one.irradiance[i]);
    }
    const double brightest = static_cast<double>(*std::ranges::max_element(all.irradiance));
    for (std::size_t i = 0; i < sum.size(); ++i)
        ASSERT_NEAR(sum[i], static_cast<double>(all.irradiance[i]), 2e-6 * brightest)
            << i;  // float
}

}  // namespace
}  // namespace ghostlight
