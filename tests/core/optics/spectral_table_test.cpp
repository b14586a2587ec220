#include "core/optics/spectral_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/io/lens_file.h"
#include "core/optics/glass.h"
#include "core/units.h"
#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

TEST(SpectralTable, PassesThroughItsEntriesAndHoldsItsEnds) {
    const SpectralTable table{{400.0, 1.53}, {500.0, 1.52}, {650.0, 1.51}, {700.0, 1.515}};
    for (const SpectralValue& entry : table) {
        EXPECT_EQ(linear_at(table, entry.wavelength_nm), entry.value);
        EXPECT_EQ(smooth_at(table, entry.wavelength_nm), entry.value);
    }
    EXPECT_EQ(linear_at(table, 100.0), 1.53);
    EXPECT_EQ(smooth_at(table, 2000.0), 1.515);
    EXPECT_NEAR(linear_at(table, 425.0), 1.5275, 1e-15);
    const SpectralTable one{{550.0, 0.7}};
    EXPECT_EQ(smooth_at(one, 300.0), 0.7);
    EXPECT_EQ(linear_at(one, 800.0), 0.7);
}

TEST(SpectralTable, TwoEntriesAreCauchys) {
    // n = 1.5 + 0.004 µm²/λ².
    auto cauchy = [](double nm) { return 1.5 + 4000.0 / (nm * nm); };
    const SpectralTable table{{400.0, cauchy(400.0)}, {700.0, cauchy(700.0)}};
    for (const double nm : {450.0, 587.6, 690.0})
        EXPECT_NEAR(smooth_at(table, nm), cauchy(nm), 1e-15);
}

TEST(SpectralTable, ReproducesAGlassFromItsLines) {
    // h, g, F, e, d, C, r of N-SF11, as data sheets print them: what the curve loses between them
    // is below the fifth decimal everywhere but in the blue, where its neighbours are far.
    const Medium* glass = bundled_glasses().find("N-SF11");
    ASSERT_NE(glass, nullptr);
    SpectralTable table;
    for (const double nm : {404.6561, 435.8343, 486.1327, 546.074, 587.5618, 656.2725, 706.5188})
        table.push_back({nm, refractive_index(*glass, nm)});
    for (double nm = 405.0; nm <= 706.0; nm += 1.0)
        EXPECT_NEAR(smooth_at(table, nm), refractive_index(*glass, nm), nm < 490.0 ? 1e-4 : 2e-5)
            << nm;
}

TEST(SpectralTable, NeitherOvershootsNorRings) {
    const SpectralTable step{{400.0, 1.0}, {450.0, 1.0}, {500.0, 2.0}, {550.0, 2.0}, {600.0, 1.5}};
    for (double nm = 400.0; nm <= 600.0; nm += 0.5) {
        EXPECT_GE(smooth_at(step, nm), 1.0);
        EXPECT_LE(smooth_at(step, nm), 2.0);
    }
    EXPECT_EQ(smooth_at(step, 425.0), 1.0);
}

TEST(TabulatedGlass, EnforcesItsRangeUnlessItHolds) {
    const SpectralTable table{{450.0, 1.53}, {650.0, 1.51}};
    const Medium glass{"prv", TabulatedGlass{table}};
    EXPECT_EQ(refractive_index(glass, 450.0), 1.53);
    const Error::Parts error = error_of([&] { refractive_index(glass, 449.0); });
    EXPECT_THAT(error.problem, testing::HasSubstr("prv"));
    EXPECT_THAT(error.expected, testing::HasSubstr("450"));
    const Medium held{"layer", TabulatedGlass{table, true}};
    EXPECT_EQ(refractive_index(held, 300.0), 1.53);
    EXPECT_EQ(refractive_index(held, 900.0), 1.51);
    error_of([] { refractive_index({"empty", TabulatedGlass{}}, 500.0); });
}

TEST(InternalTransmittance, IsBeerLambertBetweenTheListedLengths) {
    Medium glass{"flint", ConstantIndex{1.8}, {{400.0, 0.81, 10.0}, {500.0, 0.99, 10.0}}};
    EXPECT_NEAR(internal_transmittance(glass, 400.0, 5.0), 0.9, 1e-15);
    EXPECT_NEAR(internal_transmittance(glass, 400.0, 20.0), 0.81 * 0.81, 1e-15);
    // Half-way between the wavelengths the losses per mm are averaged.
    EXPECT_NEAR(internal_transmittance(glass, 450.0, 10.0), std::sqrt(0.81 * 0.99), 1e-15);
    EXPECT_EQ(internal_transmittance(glass, 300.0, 10.0),
              internal_transmittance(glass, 400.0, 10.0));
    EXPECT_EQ(internal_transmittance(glass, 450.0, 0.0), 1.0);
    glass.transmittance.clear();
    EXPECT_EQ(internal_transmittance(glass, 450.0, 100.0), 1.0);
    // Of two lengths the longer one tells more, until hardly anything comes through.
    glass.transmittance = {
        {350.0, 0.5, 1.0}, {350.0, 0.03, 5.0}, {400.0, 0.9, 5.0}, {400.0, 0.6, 25.0}};
    EXPECT_NEAR(internal_transmittance(glass, 350.0, 1.0), 0.5, 1e-15);
    EXPECT_NEAR(internal_transmittance(glass, 400.0, 25.0), 0.6, 1e-15);
}

}  // namespace
}  // namespace ghostlight
