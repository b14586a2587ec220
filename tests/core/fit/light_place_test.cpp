// From a place on the sensor to the light that is imaged there, and back.

#include "core/fit/light_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/optics/optical_system.h"
#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(LightPlace, DirectionsComeBack) {
    for (const BundledLens& each : bundled_lenses()) {
        const Prescription lens = read_lens(each.file).lens;
        const OpticalSystem system = compile(lens, d_line_nm);
        const LightDirection light{3.0, 40.0};
        const auto image = image_of_light(system, light);
        ASSERT_TRUE(image) << each.name;
        const LightDirection found = light_imaged_at(system, *image);
        // A sixteenth of the pupil's cells: the mean of the rays that pass jumps where one does.
        EXPECT_NEAR(found.field_deg, 3.0, 0.02) << each.name;
        EXPECT_NEAR(std::remainder(found.azimuth_deg - 40.0, 360.0), 0.0, 0.5) << each.name;
    }
}

TEST(LightPlace, BeyondTheImageCircleIsRefused) {
    const OpticalSystem system = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    EXPECT_NE(error_of([&] {
                  light_imaged_at(system, {900.0, 0.0});
              }).problem.find("no light"),
              std::string::npos);
}

}  // namespace
}  // namespace ghostlight
