#include "core/optics/coating_curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace ghostlight {
namespace {

const Medium glass{{}, ConstantIndex{1.6}};
const CoatedSurface bare{Uncoated{}, Medium{}, glass, true};

/// Fresnel's equations, written out.
TEST(CoatingCurvesTest, BareGlassIsFresnels) {
    const double normal = std::pow((1.6 - 1.0) / (1.6 + 1.0), 2);
    for (const CurvePoint& at : over_wavelength(bare, 0.0, 400.0, 700.0, 7)) {
        EXPECT_NEAR(at.r_s, normal, 1e-14);
        EXPECT_NEAR(at.r_p, normal, 1e-14);
    }
    const auto angles = over_angle(bare, 550.0, 90.0, 91);
    ASSERT_EQ(angles.size(), 91U);
    for (const CurvePoint& at : angles) {
        const double c1 = std::cos(rad_from_deg(at.x));
        const double s2 = std::sin(rad_from_deg(at.x)) / 1.6;
        const double c2 = std::sqrt(1.0 - s2 * s2);
        EXPECT_NEAR(at.r_s, std::pow((c1 - 1.6 * c2) / (c1 + 1.6 * c2), 2), 1e-12) << at.x;
        EXPECT_NEAR(at.r_p, std::pow((c2 - 1.6 * c1) / (c2 + 1.6 * c1), 2), 1e-12) << at.x;
    }
    EXPECT_NEAR(angles.back().mean(), 1.0, 1e-12);
}

/// From behind, the angle is in the glass: nothing passes beyond asin(1/1.6) = 38.68°.
TEST(CoatingCurvesTest, FromBehindTheGlassReflectsTotally) {
    CoatedSurface behind = bare;
    behind.from_front = false;
    for (const CurvePoint& at : over_angle(behind, 550.0, 80.0, 81)) {
        if (at.x > 38.7) {
            EXPECT_NEAR(at.mean(), 1.0, 1e-12) << at.x;
        } else if (at.x < 38.6) {
            EXPECT_LT(at.mean(), 0.9) << at.x;
        }
    }
}

TEST(CoatingCurvesTest, AQuarterWaveIsDarkestAtItsCentre) {
    const CoatedSurface coated{QuarterWave{520.0, IdealIndex{}}, Medium{}, glass, true};
    const auto curve = over_wavelength(coated, 0.0, 400.0, 700.0, 301);
    for (const CurvePoint& at : curve) {
        if (at.x == 520.0) {
            EXPECT_NEAR(at.mean(), 0.0, 1e-12);
        } else {
            EXPECT_GT(at.mean(), 0.0) << at.x;
        }
    }
}

}  // namespace
}  // namespace ghostlight
