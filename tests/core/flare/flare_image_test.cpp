#include "core/flare/flare_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/ghosts/ghost_table.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

FlareRequest request_of(const LightDirection& light, int width_px) {
    FlareRequest request;
    request.light = light;
    request.width_px = width_px;
    return request;
}

FlareImage image_of(const Prescription& lens, const FlareRequest& request) {
    auto image = render_flare(lens, request);
    EXPECT_TRUE(image.has_value());
    return image.value_or(FlareImage{});
}

double total(const std::vector<float>& values) {
    double sum = 0.0;
    for (const float v : values) sum += static_cast<double>(v);
    return sum;
}

void expect_flux_of_the_table(const char* file, const LightDirection& light) {
    // The picture's uniform grids of 32 cells; the table states 1 %.
    constexpr double grid_accuracy = 0.02;
    const Prescription lens = bundled(file);
    const FlareImage image = image_of(lens, request_of(light, 320));
    const auto table = ghost_table(lens, {.light = light, .peaks = false});
    ASSERT_TRUE(table.has_value());
    double all = 0.0, on_sensor = 0.0, error = 0.0;
    for (const GhostRow& r : table->ghosts) {
        all += r.flux_mm2;
        on_sensor += r.flux_mm2 * r.on_sensor;
        error += r.flux_error_mm2;
    }
    EXPECT_GT(all, 0.0);
    EXPECT_NEAR(image.flux_mm2, all, error + grid_accuracy * all)
        << file << " at " << light.field_deg;
    EXPECT_NEAR(image.flux_on_sensor_mm2, on_sensor, error + grid_accuracy * on_sensor)
        << file << " at " << light.field_deg;
}

TEST(FlareImage, HoldsTheFluxOfTheGhostTable) {
    expect_flux_of_the_table("tessar_brendel_100_f2.8", {0.0, 90.0});
    expect_flux_of_the_table("tessar_brendel_100_f2.8", {15.0, 40.0});
    expect_flux_of_the_table("cooke_triplet_50_f5", {12.0, 90.0});
    expect_flux_of_the_table("heliar_tronnier_100", {8.0, 90.0});
}

TEST(FlareImageSlow, HoldsTheFluxOfTheGhostTableOfLargeLenses) {
    expect_flux_of_the_table("double_gauss_tronnier_100_f2", {14.0, 90.0});
    expect_flux_of_the_table("fisheye_nikkor_10.5_f2.8", {60.0, 90.0});
    expect_flux_of_the_table("nikkor_z_58_f0.95_noct", {10.0, 90.0});
    expect_flux_of_the_table("angenieux_1953_100_f1.1", {8.0, 90.0});
}

TEST(FlareImage, HugeSensorHoldsAllLight) {
    // Float pixels, summed in double; on the axis pixels 10 mm wide are boxes along a ghost's
    // radius (radial_profile.h), hence parts of a thousand.
    constexpr double tolerance_off_axis = 1e-5, tolerance_on_axis = 1e-3;
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    lens.sensor.width_mm = lens.sensor.height_mm = 4000.0;
    for (const double field : {0.0, 12.0}) {
        const double tolerance = field == 0.0 ? tolerance_on_axis : tolerance_off_axis;
        const FlareImage image = image_of(lens, request_of({field, 90.0}, 400));
        EXPECT_GT(image.flux_mm2, 0.0);
        EXPECT_NEAR(image.flux_on_sensor_mm2, image.flux_mm2, tolerance * image.flux_mm2);
    }
}

TEST(FlareImage, FluxIsKeptWhateverTheNumberOfPixels) {
    constexpr double tolerance = 1e-5;      // float pixels
    constexpr double grid_accuracy = 0.02;  // a picture may choose its grids by its size
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    lens.sensor.width_mm = lens.sensor.height_mm = 4000.0;  // holds all light
    const double fine = image_of(lens, request_of({9.0, 90.0}, 500)).flux_mm2;
    for (const int width : {1, 7, 60, 180}) {
        const FlareImage image = image_of(lens, request_of({9.0, 90.0}, width));
        EXPECT_NEAR(image.flux_on_sensor_mm2, image.flux_mm2, tolerance * image.flux_mm2) << width;
        EXPECT_NEAR(image.flux_mm2, fine, grid_accuracy * fine) << width;
    }
}

TEST(FlareImage, IsBitIdenticalForAnyNumberOfThreads) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    FlareRequest request = request_of({11.0, 77.0}, 200);
    request.spectrum = StandardLight{};
    request.highlighted = {{{4, 2}}};
    request.threads = 1;
    const FlareImage one = image_of(lens, request);
    for (const unsigned threads : {2U, 5U}) {
        request.threads = threads;
        const FlareImage many = image_of(lens, request);
        EXPECT_EQ(one.irradiance, many.irradiance);
        EXPECT_EQ(one.rgb, many.rgb);
        EXPECT_EQ(one.highlight, many.highlight);
        EXPECT_EQ(one.flux_mm2, many.flux_mm2);
    }
}

TEST(FlareImage, VerticalFieldsAreMirrorSymmetric) {
    // x → −x leaves lens and light alone: columns mirror, in float.
    constexpr double tolerance = 1e-3;  // of all light: edges traced in single precision
    for (const char* file : {"tessar_brendel_100_f2.8", "fisheye_nikkor_10.5_f2.8"}) {
        const FlareImage image = image_of(bundled(file), request_of({13.0, 90.0}, 240));
        double difference = 0.0;
        for (int j = 0; j < image.height_px; ++j)
            for (int i = 0; i < image.width_px; ++i) {
                const auto at = [&](int column) {
                    return static_cast<double>(
                        image.irradiance[static_cast<std::size_t>(j * image.width_px + column)]);
                };
                difference += std::abs(at(i) - at(image.width_px - 1 - i));
            }
        EXPECT_LE(difference, tolerance * total(image.irradiance)) << file;
    }
}

TEST(FlareImage, OppositeLightsGiveTurnedPictures) {
    constexpr double tolerance = 5e-3;  // of all light: the grids' diagonals do not turn
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    const FlareImage a = image_of(lens, request_of({9.0, 30.0}, 240));
    const FlareImage b = image_of(lens, request_of({9.0, 210.0}, 240));
    double difference = 0.0;
    for (std::size_t i = 0; i < a.irradiance.size(); ++i)
        difference += std::abs(static_cast<double>(a.irradiance[i]) -
                               static_cast<double>(b.irradiance[b.irradiance.size() - 1 - i]));
    EXPECT_LE(difference, tolerance * total(a.irradiance));
}

TEST(FlareImage, HighlightIsPartOfTheWhole) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    const OpticalSystem system = compile(lens, d_line_nm);
    FlareRequest request = request_of({10.0, 90.0}, 160);
    EXPECT_TRUE(image_of(lens, request).highlight.empty());
    request.highlighted = {{{4, 2}}, {{7, 5}}};
    const FlareImage some = image_of(lens, request);
    ASSERT_EQ(some.highlight.size(), some.irradiance.size());
    EXPECT_GT(total(some.highlight), 0.0);
    for (std::size_t i = 0; i < some.highlight.size(); ++i)
        EXPECT_LE(some.highlight[i], some.irradiance[i]);
    request.highlighted = two_reflection_ghosts(system);
    const FlareImage all = image_of(lens, request);
    EXPECT_EQ(all.highlight, all.irradiance);
}

TEST(FlareImage, SingleWavelengthsAreNeutral) {
    const FlareImage image =
        image_of(bundled("tessar_brendel_100_f2.8"), request_of({10.0, 90.0}, 100));
    for (std::size_t i = 0; i < image.irradiance.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_FLOAT_EQ(image.rgb[3 * i + c], image.irradiance[i]);
}

TEST(FlareImage, LightBesideTheLensLeavesItBlack) {
    const FlareImage image =
        image_of(bundled("tessar_brendel_100_f2.8"), request_of({90.0, 90.0}, 64));
    EXPECT_EQ(image.width_px, 64);
    for (const float v : image.irradiance) EXPECT_TRUE(std::isfinite(v) && v >= 0.0F);
    EXPECT_EQ(image_of(lens_of({row(0.0, 5.0, 1.0)}), request_of({}, 16)).flux_mm2, 0.0)
        << "a lens without reflections";
}

TEST(FlareImage, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    EXPECT_FALSE(render_flare(bundled("cooke_triplet_50_f5"), {}, source.get_token()).has_value());
}

TEST(FlareImage, SmallestPicturesWork) {
    Prescription lens = bundled("cooke_triplet_50_f5");
    for (const int width : {1, 2, 17}) {
        const FlareImage image = image_of(lens, request_of({5.0, 90.0}, width));
        EXPECT_EQ(image.irradiance.size(),
                  static_cast<std::size_t>(image.width_px * image.height_px));
        EXPECT_GT(image.flux_on_sensor_mm2, 0.0);
    }
}

TEST(UprightPicture, IsTheSensorSeenFromBehindTurnedRound) {
    // Sensor data: row 0 is the lowest y, column 0 the lowest x. The picture's left is +x, and its
    // top, row 0, is −y.
    const std::vector<float> data{1, 2, 3,   // y low, x from low
                                  4, 5, 6};  // y high
    EXPECT_EQ(upright_picture(data, 3, 2, 1), (std::vector<float>{3, 2, 1, 6, 5, 4}));
    const std::vector<float> rgb{1, 10, 100, 2, 20, 200};
    EXPECT_EQ(upright_picture(rgb, 2, 1, 3), (std::vector<float>{2, 20, 200, 1, 10, 100}));
    EXPECT_EQ(upright_picture(upright_picture(data, 3, 2, 1), 3, 2, 1), data);
}

}  // namespace
}  // namespace ghostlight
