// Light on the axis drawn as one profile, against the general way (a light hardly beside the axis),
// which traces grids and rasterises them, and against closed forms.
#include "core/flare/radial_flare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/flare/color_raster.h"
#include "core/flare/planned_flare.h"
#include "core/flare/radial_profile.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

double relative_l1(const std::vector<float>& image, const std::vector<float>& truth) {
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        difference += std::abs(static_cast<double>(image[i] - truth[i]));
        sum += std::abs(static_cast<double>(truth[i]));
    }
    return difference / sum;
}

std::vector<float> whole(const RadialProfile<gray_channels>& profile, const PixelFrame& frame) {
    const auto filtered = profile.filtered();
    const int columns = (frame.width_px + 1) / 2;
    std::vector<float> line(static_cast<std::size_t>(columns)), picture;
    for (int row = 0; row < frame.height_px; ++row) {
        filtered.draw_row(std::min(row, frame.height_px - 1 - row), line);
        for (int i = 0; i < frame.width_px; ++i)
            picture.push_back(line[static_cast<std::size_t>(std::min(i, frame.width_px - 1 - i))]);
    }
    return picture;
}

TEST(RadialProfile, ARingCoversPixelsByTheirShareOfIt) {
    for (const int width_px : {120, 121}) {
        const PixelFrame frame = pixel_frame(36.0, 24.0, width_px);
        for (const auto& [low, high] : {std::pair{0.0, 25.3}, {11.2, 30.7}, {3.1, 3.9}}) {
            RadialProfile<gray_channels> profile(frame);
            const double area = std::numbers::pi * (high * high - low * low);
            profile.add(high, low, {area});
            const std::vector<float> picture = whole(profile, frame);
            // Coverage by 32 × 32 places a pixel.
            constexpr int places = 32;
            double off = 0.0, sum = 0.0;
            for (int j = 0; j < frame.height_px; ++j)
                for (int i = 0; i < frame.width_px; ++i) {
                    int inside = 0;
                    for (int n = 0; n < places; ++n)
                        for (int m = 0; m < places; ++m) {
                            const double r =
                                std::hypot(i + (m + 0.5) / places - 0.5 * frame.width_px,
                                           j + (n + 0.5) / places - 0.5 * frame.height_px);
                            inside += r >= low && r < high ? 1 : 0;
                        }
                    const double value = static_cast<double>(
                        picture[static_cast<std::size_t>(j * frame.width_px + i)]);
                    off += std::abs(value - inside / (1.0 * places * places));
                    sum += value;
                }
            // In directions between rows and diagonals a pixel's shape is interpolated: some 1e-2
            // of a pixel along the rims.
            const double rims_px = 2.0 * std::numbers::pi * (low + high);
            EXPECT_LT(off, 0.02 * rims_px) << width_px << ": " << low << " to " << high;
            EXPECT_NEAR(sum / area, 1.0, 0.003) << width_px << ": " << low << " to " << high;
        }
    }
}

TEST(RadialProfile, ASpotKeepsItsLight) {
    const PixelFrame frame = pixel_frame(36.0, 24.0, 90);
    RadialProfile<gray_channels> profile(frame);
    profile.add(0.0, 0.0, {2.0});
    profile.add(0.0, 1e-3, {1.0});
    const std::vector<float> picture = whole(profile, frame);
    double sum = 0.0;
    for (const float value : picture) sum += static_cast<double>(value);
    EXPECT_NEAR(sum, 3.0, 1e-3);
}

FlareRequest request_of(double field_deg, double tolerance) {
    FlareRequest request;
    request.light = {field_deg, 90.0};
    request.width_px = 480;
    request.tolerance = tolerance;
    return request;
}

/// Moves no ghost by a hundredth of a pixel.
constexpr double hardly_beside_deg = 1e-4;

TEST(RadialFlare, IsThePictureOfALightBesideTheAxis) {
    constexpr double tolerance = 0.005;  // of each of the two
    for (const std::string file : {"tessar_brendel_100_f2.8", "double_gauss_tronnier_100_f2",
                                   "fisheye_nikkor_10.5_f2.8", "nikon_zoom_80_200_f2.8"}) {
        const FlareScene scene = flare_scene(bundled(file), Monochromatic{});
        ASSERT_TRUE(is_radial(scene, request_of(0.0, tolerance)));
        ASSERT_FALSE(is_radial(scene, request_of(hardly_beside_deg, tolerance)));
        const FlareImage radial = render_planned(scene, request_of(0.0, tolerance)).value();
        const FlareImage general =
            render_planned(scene, request_of(hardly_beside_deg, tolerance)).value();
        EXPECT_LE(relative_l1(radial.irradiance, general.irradiance), 2.0 * tolerance) << file;
        EXPECT_NEAR(radial.flux_on_sensor_mm2 / general.flux_on_sensor_mm2, 1.0, 2.0 * tolerance)
            << file;
        EXPECT_NEAR(radial.plan.flux_mm2 / radial.flux_on_sensor_mm2, 1.0, tolerance) << file;
        EXPECT_LE(radial.plan.estimated_error(), tolerance) << file;
    }
}

TEST(RadialFlare, HasTheSameColours) {
    constexpr double tolerance = 0.005;
    FlareRequest on = request_of(0.0, tolerance), beside = request_of(hardly_beside_deg, tolerance);
    on.spectrum = beside.spectrum = StandardLight{Illuminant::d65};
    const FlareScene scene = flare_scene(bundled("heliar_tronnier_100"), on.spectrum);
    on.highlighted = beside.highlighted = {scene.ghosts[3], scene.ghosts[8]};
    const FlareImage radial = render_planned(scene, on).value();
    const FlareImage general = render_planned(scene, beside).value();
    EXPECT_LE(relative_l1(radial.rgb, general.rgb), 2.0 * tolerance);
    // Ghosts of the whole picture's allowance: as far off as most_share lets a ghost be.
    EXPECT_LE(relative_l1(radial.highlight, general.highlight), 0.1);
}

TEST(RadialFlare, FollowsTheStop) {
    constexpr double tolerance = 0.005;
    const Prescription open = bundled("heliar_tronnier_100");
    for (const double share : {0.3, 0.02}) {
        const Prescription lens =
            stopped_down(open, share * open.surfaces[open.stop.surface].semi_diameter_mm);
        const FlareScene scene = flare_scene(lens, Monochromatic{});
        const FlareImage radial = render_planned(scene, request_of(0.0, tolerance)).value();
        const FlareImage general =
            render_planned(scene, request_of(hardly_beside_deg, tolerance)).value();
        EXPECT_LE(relative_l1(radial.irradiance, general.irradiance), 2.0 * tolerance) << share;
    }
}

TEST(RadialFlare, IsOnlyForWhatIsRound) {
    Prescription lens = bundled("heliar_tronnier_100");
    const auto radial = [&](const FlareRequest& request) {
        return is_radial(flare_scene(lens, request.spectrum), request);
    };
    FlareRequest request = request_of(0.0, 0.02);
    EXPECT_TRUE(radial(request));
    request.ringing = true;
    EXPECT_FALSE(radial(request));
    request = request_of(0.0, 0.02);
    request.economies.leaving_out = false;
    EXPECT_FALSE(radial(request));
    request = request_of(0.0, 0.02);
    lens.stop.blades = 7;
    EXPECT_FALSE(radial(request));
    lens.stop.blades = 0;
    lens.sensor.reflectance = UniformReflectance{0.2};
    EXPECT_FALSE(radial(request));
}

TEST(RadialFlare, IsTheSameOnAnyNumberOfThreads) {
    FlareRequest request = request_of(0.0, 0.02);
    request.spectrum = StandardLight{Illuminant::d65};
    const FlareScene scene = flare_scene(bundled("tessar_brendel_100_f2.8"), request.spectrum);
    request.threads = 1;
    const FlareImage one = render_planned(scene, request).value();
    request.threads = 3;
    EXPECT_EQ(render_planned(scene, request)->rgb, one.rgb);
}

TEST(RadialFlare, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    const FlareScene scene = flare_scene(bundled("tessar_brendel_100_f2.8"), Monochromatic{});
    EXPECT_FALSE(render_radial(scene, request_of(0.0, 0.02), source.get_token()));
}

}  // namespace
}  // namespace ghostlight
