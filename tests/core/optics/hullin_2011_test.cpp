// The supplement's formula against the exact film: the factors by which it is known to be wrong.
#include "core/optics/hullin_2011.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/optics/coating.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

/// Over the true R of a quarter wave of index 1.38 at its own wavelength and normal incidence.
double factor_on(double glass) {
    constexpr double nm = 550.0, layer = 1.38;
    const double thickness_nm = nm / (4.0 * layer);
    QuarterWave film{.center_nm = nm, .layer = medium(layer)};
    const double exact = reflectances(film_at(film, medium(1.0), medium(glass), nm), 1.0).r();
    return hullin_2011_reflectance(1.0, nm, thickness_nm, 1.0, layer, glass) / exact;
}

TEST(Hullin2011, IsWrongByItsKnownFactors) {
    // Given to two or three digits for n = 1.5168, 1.62 and 1.80 in the project's physics notes.
    EXPECT_NEAR(factor_on(1.5168), 1.24, 0.02);
    EXPECT_NEAR(factor_on(1.62), 1.63, 0.03);
    EXPECT_NEAR(factor_on(1.80), 5.5, 0.2);
}

TEST(Hullin2011, IsANumberWhereTheFormulaIsNone) {
    EXPECT_TRUE(std::isfinite(hullin_2011_reflectance(1.0, 550.0, 99.6, 1.0, 1.38, 1.5)));
    EXPECT_EQ(hullin_2011_reflectance(0.3, 550.0, 99.6, 1.5, 1.38, 1.0), 1.0);
}

}  // namespace
}  // namespace ghostlight
