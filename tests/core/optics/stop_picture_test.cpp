#include "core/optics/stop_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/flare/flare_image.h"
#include "core/ghosts/row_details.h"
#include "core/optics/trace.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

/// A disc of a radius in semi-diameters, its edge covered by pixels in part.
std::vector<float> disc(int across, double radius) {
    std::vector<float> open;
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < across; ++i) {
            const double x = (2.0 * i + 1.0) / across - 1.0, y = (2.0 * j + 1.0) / across - 1.0;
            open.push_back(static_cast<float>(
                std::clamp(0.5 + (radius - std::hypot(x, y)) * 0.5 * across, 0.0, 1.0)));
        }
    return open;
}

TEST(StopPicture, DistanceToADiscIsThatToItsCircle) {
    constexpr int across = 200;
    const StopPicture picture(across, across, disc(across, 0.6));
    for (double r = 0.05; r < 0.95; r += 0.01)
        for (double turn = 0.0; turn < 6.28; turn += 0.37)
            // Half a pixel, 1/200, in general; a fifth of a pixel at the edge itself.
            EXPECT_NEAR(picture.distance_at(r * std::cos(turn), r * std::sin(turn)), 0.6 - r,
                        std::abs(0.6 - r) < 0.005 ? 2e-3 : 6e-3)
                << r;
}

TEST(StopPicture, LongSideSpansTheStopAndLargeOnesAreAveraged) {
    // 3000 × 1000, all open: a third of the height, reduced to 1024.
    const StopPicture picture(3000, 1000, std::vector<float>(3'000'000, 1.0F));
    EXPECT_EQ(picture.across_px(), StopPicture::most_across_px);
    EXPECT_NEAR(picture.open_at(0.0, 0.3), 1.0, 1e-6);
    EXPECT_NEAR(picture.open_at(0.0, 0.36), 0.0, 1e-6);
    EXPECT_NEAR(picture.open_at(0.9, 0.0), 1.0, 1e-6);
    EXPECT_LT(picture.distance_at(0.0, 0.5), 0.0);
    EXPECT_LT(picture.distance_at(1.5, 0.0), -0.4);
    double sum = 0.0;
    for (const float open : picture.open()) sum += static_cast<double>(open);
    EXPECT_NEAR(sum / picture.open().size(), 1.0 / 3.0, 1e-6);
}

TEST(StopPicture, OnePixelIsAnImage) {
    const StopPicture picture(1, 1, {1.0F});
    EXPECT_GT(picture.distance_at(0.0, 0.0), 0.0);
    EXPECT_EQ(picture.open_at(0.3, -0.8), 1.0);
}

TEST(StopPicture, DiscOfAnImageClipsAsASmallerStop) {
    // Ghosts of a stop closed by an image are those of a stop closed by its blades.
    Prescription pictured = stopped_down(bundled("tessar_brendel_100_f2.8"), 10.0);
    pictured.stop.image =
        StopImage{"disc", std::make_shared<const StopPicture>(512, 512, disc(512, 0.5))};
    const Prescription closed = stopped_down(bundled("tessar_brendel_100_f2.8"), 5.0);
    const OpticalSystem system = compile(pictured, 550.0);
    EXPECT_EQ(stop_edges(system.stop_mask), 2);
    EXPECT_NEAR(stop_area_mm2(system.stop_mask), std::numbers::pi * 25.0, 0.3);
    FlareRequest request;
    request.light = {8.0, 90.0};
    request.width_px = 200;
    request.tolerance = 0.005;
    const FlareImage by_image = *render_flare(pictured, request);
    const FlareImage by_blades = *render_flare(closed, request);
    EXPECT_TRUE(by_image.plan.ghosts.empty()) << "drawn uniformly";
    // Chords of cells of 1/128: 1e-4; the disc's own edge, a thousandth of its radius.
    EXPECT_NEAR(by_image.flux_mm2 / by_blades.flux_mm2, 1.0, 5e-3);
    double difference = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < by_image.irradiance.size(); ++k) {
        difference +=
            std::abs(static_cast<double>(by_image.irradiance[k] - by_blades.irradiance[k]));
        sum += static_cast<double>(by_blades.irradiance[k]);
    }
    EXPECT_LT(difference / sum,
              0.03);  // rims half a pixel's thousandth apart, and the plan's 0.5 %
}

}  // namespace
}  // namespace ghostlight
