#include "core/flare/spectrum.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

/// Chromaticity by the CIE's sum over 380–780 nm in steps of 5 nm.
struct Chromaticity {
    double x, y;
};
Chromaticity chromaticity(const Spectrum& spectrum) {
    Xyz sum;
    for (int nm = 380; nm <= 780; nm += 5) {
        const double power = relative_power(spectrum, nm);
        const Xyz response = color_matching(nm);
        sum.x += power * response.x;
        sum.y += power * response.y;
        sum.z += power * response.z;
    }
    const double all = sum.x + sum.y + sum.z;
    return {sum.x / all, sum.y / all};
}

TEST(Spectrum, ChromaticitiesOfTheStandardLights) {
    // CIE 15 table T.3; the sum at 5 nm is itself good to 2e-5.
    constexpr double tolerance = 2e-5;
    const Chromaticity d65 = chromaticity(StandardLight{Illuminant::d65});
    EXPECT_NEAR(d65.x, 0.31272, tolerance);
    EXPECT_NEAR(d65.y, 0.32903, tolerance);
    const Chromaticity a = chromaticity(StandardLight{Illuminant::a});
    EXPECT_NEAR(a.x, 0.44758, tolerance);
    EXPECT_NEAR(a.y, 0.40745, tolerance);
    const Chromaticity e = chromaticity(StandardLight{Illuminant::e});
    EXPECT_NEAR(e.x, 1.0 / 3.0, tolerance);
    EXPECT_NEAR(e.y, 1.0 / 3.0, tolerance);
}

TEST(Spectrum, BlackbodyLiesOnThePlanckianLocus) {
    // Wyszecki and Stiles: 6500 K at (0.3135, 0.3237); 2856 K is illuminant A.
    const Chromaticity warm = chromaticity(Blackbody{2856.0});
    EXPECT_NEAR(warm.x, 0.4476, 3e-4);
    EXPECT_NEAR(warm.y, 0.4074, 3e-4);
    const Chromaticity day = chromaticity(Blackbody{6500.0});
    EXPECT_NEAR(day.x, 0.3135, 3e-4);
    EXPECT_NEAR(day.y, 0.3237, 3e-4);
}

TEST(Spectrum, BlackbodyFollowsWien) {
    // Wien's displacement: 2897.77 µm K.
    const Spectrum sun = Blackbody{5772.0};
    const double peak_nm = 2.897771955e6 / 5772.0;
    for (const double away_nm : {1.0, 20.0}) {
        EXPECT_GT(relative_power(sun, peak_nm), relative_power(sun, peak_nm - away_nm));
        EXPECT_GT(relative_power(sun, peak_nm), relative_power(sun, peak_nm + away_nm));
    }
    for (const double kelvin : {500.0, 1e6})
        for (const double nm : {300.0, 550.0, 2000.0}) {
            const double power = relative_power(Blackbody{kelvin}, nm);
            EXPECT_TRUE(std::isfinite(power) && power > 0.0) << kelvin << " K, " << nm << " nm";
        }
}

TEST(Spectrum, ObserverPeaksAndAreas) {
    EXPECT_EQ(color_matching(555.0).y, 1.0);
    Xyz area;
    for (int nm = 380; nm <= 780; nm += 5) {
        const Xyz response = color_matching(nm);
        EXPECT_LE(response.y, 1.0);
        area.x += response.x;
        area.y += response.y;
        area.z += response.z;
    }
    // The functions were made to have equal areas.
    EXPECT_NEAR(area.x / area.y, 1.0, 2e-5);
    EXPECT_NEAR(area.z / area.y, 1.0, 2e-5);
    EXPECT_EQ(color_matching(379.0).y, 0.0);
    EXPECT_EQ(color_matching(781.0).y, 0.0);
    EXPECT_GT(color_matching(380.0).y, 0.0);
    EXPECT_GT(color_matching(780.0).y, 0.0);
}

TEST(Spectrum, RecWhiteIsD65) {
    const Rgb white = linear_rec709({0.95047, 1.0, 1.08883});
    EXPECT_NEAR(white.r, 1.0, 1e-4);
    EXPECT_NEAR(white.g, 1.0, 1e-4);
    EXPECT_NEAR(white.b, 1.0, 1e-4);
}

TEST(Spectrum, SamplesAreMidpointsWithWeightsThatSumToOne) {
    for (const int count : {1, 2, 5, 31}) {
        const auto samples = sample(StandardLight{Illuminant::d65}, count);
        ASSERT_EQ(samples.size(), static_cast<std::size_t>(count));
        double sum = 0.0;
        for (int i = 0; i < count; ++i) {
            const auto& each = samples[static_cast<std::size_t>(i)];
            EXPECT_NEAR(each.wavelength_nm, 400.0 + 300.0 * (i + 0.5) / count, 1e-9);
            sum += each.weight;
        }
        EXPECT_NEAR(sum, 1.0, 1e-14);
    }
    const auto equal = sample(StandardLight{Illuminant::e}, 4);
    EXPECT_DOUBLE_EQ(equal[3].weight, 0.25);
    const auto single = sample(Monochromatic{632.8}, 7);
    ASSERT_EQ(single.size(), 1u);
    EXPECT_EQ(single[0].wavelength_nm, 632.8);
    EXPECT_EQ(single[0].weight, 1.0);
    error_of([] { sample(Blackbody{5000.0}, 0); });
}

Rgb mixed(const Spectrum& light, int count) {
    const auto samples = sample(light, count);
    const auto colors = sample_colors(light, samples);
    Rgb sum;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        sum.r += samples[i].weight * colors[i].r;
        sum.g += samples[i].weight * colors[i].g;
        sum.b += samples[i].weight * colors[i].b;
    }
    return sum;
}

TEST(Spectrum, TheLightItselfIsWhite) {
    for (const Spectrum& light :
         {Spectrum(StandardLight{Illuminant::d65}), Spectrum(StandardLight{Illuminant::a}),
          Spectrum(StandardLight{Illuminant::e}), Spectrum(Blackbody{5500.0})}) {
        const Rgb white = mixed(light, 31);
        EXPECT_NEAR(white.r, 1.0, 1e-12) << name(light);
        EXPECT_NEAR(white.g, 1.0, 1e-12) << name(light);
        EXPECT_NEAR(white.b, 1.0, 1e-12) << name(light);
    }
}

TEST(Spectrum, OutsideTheGamutOnlyTheLuminanceIsBalanced) {
    const Rgb ember = mixed(Blackbody{1000.0}, 31);
    EXPECT_NEAR(0.2126 * ember.r + 0.7152 * ember.g + 0.0722 * ember.b, 1.0, 1e-12);
    EXPECT_GT(ember.r, 1.5);
    EXPECT_LT(ember.b, 0.1);
}

TEST(Spectrum, ASingleWavelengthIsNeutral) {
    const Spectrum laser = Monochromatic{632.8};
    const auto colors = sample_colors(laser, sample(laser, 1));
    ASSERT_EQ(colors.size(), 1u);
    EXPECT_EQ(colors[0].r, 1.0);
    EXPECT_EQ(colors[0].g, 1.0);
    EXPECT_EQ(colors[0].b, 1.0);
}

TEST(Spectrum, NamesReadBack) {
    for (const Spectrum& light :
         {Spectrum(Monochromatic{587.5618}), Spectrum(StandardLight{Illuminant::d65}),
          Spectrum(StandardLight{Illuminant::a}), Spectrum(StandardLight{Illuminant::e}),
          Spectrum(Blackbody{5500.0}), Spectrum(Blackbody{2856.5})})
        EXPECT_EQ(parse_spectrum(name(light)), light) << name(light);
    EXPECT_EQ(name(Monochromatic{587.5618}), "587.5618 nm");
    EXPECT_EQ(name(Blackbody{5500.0}), "5500 K");
    EXPECT_EQ(parse_spectrum(" d65 "), Spectrum(StandardLight{Illuminant::d65}));
    EXPECT_EQ(parse_spectrum("632.8nm"), Spectrum(Monochromatic{632.8}));
    EXPECT_EQ(parse_spectrum("3200k"), Spectrum(Blackbody{3200.0}));
}

TEST(Spectrum, OtherNamesAreRefusedWithTheKnownOnes) {
    for (const char* text : {"", "D50", "550", "5500 F", "-5 K", "nan K", "inf nm", "1e9 K", "0 nm",
                             "nm", "550 nm x"}) {
        const Error::Parts error = error_of([&] { parse_spectrum(text); });
        EXPECT_THAT(error.expected, testing::HasSubstr("D65, A, E")) << text;
    }
}

}  // namespace
}  // namespace ghostlight
