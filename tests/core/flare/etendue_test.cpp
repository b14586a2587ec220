// What limits a ghost's peak: étendue and the size of the source, nothing added. Radiance is kept
// along a path but for its films, so that the pixel on the axis of a focused ghost sees the sun's
// radiance times them within the cone of the rays that leave the lens.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/flare/extended_flare.h"
#include "core/flare/light.h"
#include "core/optics/coating.h"
#include "core/optics/paraxial.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;

/// A bare biconvex lens, in whose one ghost the sensor lies in focus, at a small aperture: its
/// rays spread far less than the sun's image is wide.
class FocusedGhost {
   public:
    double peak(int width_px, double diameter_deg) const {
        FlareRequest request;
        request.light = {0.0, 90.0};
        request.width_px = width_px;  // odd: one pixel lies on the axis
        request.tolerance = 0.005;
        request.only = {path_};
        const FlareImage image =
            render_extended(scene_, request, disc_pattern(diameter_deg), {}).value();
        return static_cast<double>(*std::ranges::max_element(image.irradiance));
    }
    /// Over E0, of a disc that the pixel on the axis sees through all of the opening.
    double radiance_within_the_cone(double diameter_deg) const {
        const ParaxialGhost ghost = paraxial_ghost(scene_.system(), path_);
        const double sine =
            std::sin(std::atan(ghost.to_sensor.c * ghost.entrance_semi_diameter_mm));
        const double disc_sr = 2.0 * pi * (1.0 - std::cos(0.5 * diameter_deg * pi / 180.0));
        // Normal incidence at all four meetings: 4 % each, to the second order of small angles.
        const double r = 0.04;
        return pi * sine * sine / disc_sr * r * r * (1.0 - r) * (1.0 - r);
    }

   private:
    GhostPath path_{{1, 0}};
    FlareScene scene_ = flare_scene(focused(path_), Monochromatic{});

    static Prescription focused(const GhostPath& path) {
        Prescription lens = lens_of({row(200.0, 4.0, 1.5, 4.0), row(-200.0, 60.0, 1.0, 6.0)});
        lens.surfaces.back().thickness_mm +=
            paraxial_ghost(compile(lens, Monochromatic{}.wavelength_nm), path).focus_from_sensor_mm;
        lens.sensor.width_mm = lens.sensor.height_mm = 2.0;
        return lens;
    }
};

TEST(Etendue, LimitsTheFocusedGhostOfASun) {
    const FocusedGhost ghost;
    const double limit = ghost.radiance_within_the_cone(sun_diameter_deg);
    ASSERT_GT(limit, 0.0);
    // Weights over the opening, folding at a scale of a dozen pixels a sun, the picture's own
    // error.
    constexpr double tolerance = 0.05;
    for (const int width_px : {101, 301})
        EXPECT_NEAR(ghost.peak(width_px, sun_diameter_deg) / limit, 1.0, tolerance) << width_px;
}

TEST(Etendue, ThePeakGoesWithTheSourcesRadiance) {
    // Half the diameter is four times the radiance, as long as the image is wider than a pixel.
    const FocusedGhost ghost;
    const double whole = ghost.peak(301, sun_diameter_deg);
    const double half = ghost.peak(301, 0.5 * sun_diameter_deg);
    EXPECT_NEAR(half / whole, 4.0, 0.4);
}

}  // namespace
}  // namespace ghostlight
