#include "core/flare/pixel_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/ghosts/ghost_table.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

/// Picture and probe by different levels of drawing: each keeps to the tolerance asked for, which
/// is a share of all light, so together to twice that.
void expect_shares_sum_to_the_picture(const Prescription& lens, const FlareRequest& request) {
    const auto image = render_flare(lens, request);
    const auto probe = PixelProbe::make(lens, request);
    ASSERT_TRUE(image && probe);
    const double pitch_mm = image->sensor_width_mm / image->width_px;
    double apart = 0.0, all = 0.0;
    std::size_t lit = 0;
    for (int row = 1; row < image->height_px; row += 11)
        for (int column = 2; column < image->width_px; column += 13) {
            const double x = (column + 0.5) * pitch_mm - 0.5 * image->sensor_width_mm;
            const double y = (row + 0.5) * pitch_mm - 0.5 * image->height_px * pitch_mm;
            const auto pixel = probe->at(x, y);
            ASSERT_TRUE(pixel);
            ASSERT_EQ(pixel->column, column);
            ASSERT_EQ(pixel->row, row);
            double sum = 0.0, shares = 0.0;
            for (const GhostInPixel& ghost : pixel->ghosts) {
                sum += ghost.irradiance;
                shares += ghost.share;
            }
            EXPECT_NEAR(sum, pixel->irradiance,
                        1e-5 * pixel->irradiance);  // the least are not named
            EXPECT_NEAR(shares, pixel->irradiance > 0.0 ? 1.0 : 0.0, 1e-5);
            lit += pixel->irradiance > 0.0 ? 1 : 0;
            const double shown = static_cast<double>(
                image->irradiance[static_cast<std::size_t>(row * image->width_px + column)]);
            apart += std::abs(pixel->irradiance - shown);
            all += shown;
        }
    EXPECT_GT(lit, 30U);
    EXPECT_LT(apart, 2.0 * request.tolerance * all);
}

TEST(PixelProbe, SharesSumToThePicture) {
    FlareRequest request;
    request.light = {8.0, 60.0};
    request.width_px = 200;
    request.tolerance = 0.02;
    expect_shares_sum_to_the_picture(bundled("cooke_triplet_50_f5"), request);
    request.spectrum = parse_spectrum("D65");
    expect_shares_sum_to_the_picture(bundled("tessar_brendel_100_f2.8"), request);
}

TEST(PixelProbe, AsksLensesThatNoPlanDraws) {
    Prescription lens = bundled("cooke_triplet_50_f5");
    lens.sensor.reflectance = UniformReflectance{0.1};
    FlareRequest request;
    request.light = {8.0, 60.0};
    request.width_px = 160;
    ASSERT_FALSE(can_be_planned(compile(lens, d_line_nm), request.light));
    expect_shares_sum_to_the_picture(lens, request);
}

// The table integrates each ghost over the pupil; here its pixels are added up.
TEST(PixelProbe, AGhostsPixelsAddUpToItsFluxInTheTable) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    FlareRequest request;
    request.light = {8.0, 90.0};
    request.width_px = 48;
    request.tolerance = 0.005;
    const auto probe = PixelProbe::make(lens, request);
    GhostTableRequest wanted;
    wanted.light = request.light;
    wanted.tolerance = 0.003;
    wanted.peaks = false;
    const auto table = ghost_table(lens, wanted);
    ASSERT_TRUE(probe && table);
    const double pitch_mm = lens.sensor.width_mm / request.width_px;
    std::map<GhostPath, double> flux;
    const int rows = static_cast<int>(std::lround(lens.sensor.height_mm / pitch_mm));
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < request.width_px; ++column) {
            const auto pixel = probe->at((column + 0.5) * pitch_mm - 0.5 * lens.sensor.width_mm,
                                         (row + 0.5 - 0.5 * rows) * pitch_mm);
            ASSERT_TRUE(pixel);
            for (const GhostInPixel& ghost : pixel->ghosts)
                flux[ghost.path] += ghost.irradiance * pitch_mm * pitch_mm;
        }
    double all = 0.0;
    for (const GhostRow& row : table->ghosts) all += row.flux_mm2 * row.on_sensor;
    ASSERT_GT(all, 0.0);
    for (const GhostRow& row : table->ghosts)
        // Half a per cent of all ghosts is what the plan may err by; the share of a ghost that lies
        // on the sensor is known to a cell of the quadrature, some per cent.
        EXPECT_NEAR(flux[row.path], row.flux_mm2 * row.on_sensor, 0.005 * all + 0.04 * row.flux_mm2)
            << name(row.path);
}

TEST(PixelProbe, KnowsTheSensorsEdge) {
    FlareRequest request;
    request.width_px = 64;
    const Prescription lens = bundled("cooke_triplet_50_f5");
    const auto probe = PixelProbe::make(lens, request);
    ASSERT_TRUE(probe);
    const double x = 0.5 * lens.sensor.width_mm;
    EXPECT_TRUE(probe->at(0.999 * x, 0.0));
    EXPECT_FALSE(probe->at(1.001 * x, 0.0));
    EXPECT_FALSE(probe->at(0.0, -0.6 * lens.sensor.height_mm));
}

TEST(PixelProbe, StopsWhenAsked) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_FALSE(PixelProbe::make(bundled("cooke_triplet_50_f5"), {}, stop.get_token()));
}

}  // namespace
}  // namespace ghostlight
