// The first look against the planned picture, which searches and refines.
#include "core/flare/first_look.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/flare/planned_flare.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

FlareRequest request_of(LightDirection light) {
    FlareRequest request;
    request.light = light;
    request.width_px = 320;
    request.tolerance = 0.005;
    return request;
}

double relative_l1(const FlareImage& image, const FlareImage& truth) {
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < truth.irradiance.size(); ++i) {
        difference += std::abs(static_cast<double>(image.irradiance[i] - truth.irradiance[i]));
        sum += static_cast<double>(truth.irradiance[i]);
    }
    return difference / sum;
}

TEST(FirstLook, TendsToThePlannedPictureForSmallStops) {
    // Of a stop a tenth as wide the maps are linear to 1e-2 of themselves; rims by six chords a
    // half, and polarisation averaged (up to a tenth in single ghosts), are what is left, a tenth
    // for each ghost drawn small.
    constexpr double linear = 0.15;
    for (const std::string file : {"tessar_brendel_100_f2.8", "double_gauss_tronnier_100_f2"}) {
        const Prescription whole = bundled(file);
        const Prescription lens =
            stopped_down(whole, 0.1 * whole.surfaces[whole.stop.surface].semi_diameter_mm);
        const FlareScene scene = flare_scene(lens, Monochromatic{});
        for (const LightDirection light : {LightDirection{2.0, 90.0}, LightDirection{5.0, 30.0}}) {
            const FlareImage truth = render_planned(scene, request_of(light)).value();
            const FlareImage look = render_first_look(scene, request_of(light)).value();
            EXPECT_LE(relative_l1(look, truth), linear) << file << " at " << light.field_deg;
            EXPECT_NEAR(look.flux_on_sensor_mm2 / truth.flux_on_sensor_mm2, 1.0, linear) << file;
        }
    }
}

TEST(FirstLook, SaysHowFarOffItIs) {
    // An estimate from second differences is good to a factor of two.
    constexpr double estimate = 2.0;
    for (const std::string file : {"tessar_brendel_100_f2.8", "heliar_tronnier_100",
                                   "double_gauss_tronnier_100_f2", "cooke_triplet_50_f5"}) {
        FlareRequest request = request_of({7.0, 90.0});
        request.spectrum = StandardLight{Illuminant::d65};
        const FlareScene scene = flare_scene(bundled(file), request.spectrum);
        const FlareImage truth = render_planned(scene, request).value();
        const FlareImage look = render_first_look(scene, request).value();
        EXPECT_LE(relative_l1(look, truth), estimate * look.plan.estimated_error()) << file;
        EXPECT_EQ(look.plan.ghosts.size(), scene.ghosts.size());
    }
}

TEST(FirstLook, IsTheSameOnAnyNumberOfThreads) {
    FlareRequest request = request_of({7.0, 60.0});
    request.spectrum = StandardLight{Illuminant::d65};
    const FlareScene scene = flare_scene(bundled("tessar_brendel_100_f2.8"), request.spectrum);
    request.threads = 1;
    const FlareImage one = render_first_look(scene, request).value();
    request.threads = 3;
    EXPECT_EQ(render_first_look(scene, request)->rgb, one.rgb);
}

TEST(FirstLook, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    const FlareScene scene = flare_scene(bundled("tessar_brendel_100_f2.8"), Monochromatic{});
    EXPECT_FALSE(render_first_look(scene, request_of({7.0, 90.0}), source.get_token()));
}

}  // namespace
}  // namespace ghostlight
