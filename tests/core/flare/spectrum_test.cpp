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

TEST(Spectrum, LedB3IsTheCies) {
    // CIE 15:2018 table 12.2; its spectrum has two decimals.
    const Chromaticity led = chromaticity(StandardLight{Illuminant::led_b3});
    EXPECT_NEAR(led.x, 0.3756, 1.5e-4);
    EXPECT_NEAR(led.y, 0.3723, 1.5e-4);
}

TEST(Spectrum, SodiumIsItsTwoLines) {
    const Spectrum sodium = parse_spectrum("sodium");
    EXPECT_EQ(name(sodium), "sodium");
    EXPECT_TRUE(is_of_lines(sodium));
    for (const int count : {1, 16}) {
        const auto samples = sample(sodium, count);
        ASSERT_EQ(samples.size(), 2U);
        EXPECT_NEAR(samples[0].wavelength_nm, 589.0, 0.05);
        EXPECT_NEAR(samples[1].wavelength_nm, 589.6, 0.05);
        EXPECT_NEAR(samples[0].weight + samples[1].weight, 1.0, 1e-12);
    }
    EXPECT_NEAR(line_nm(sodium).value(), 589.19, 0.05);
    EXPECT_EQ(nested_samples(sodium, 5).size(), 2U);
    EXPECT_FALSE(line_nm(StandardLight{}));
    EXPECT_THROW(passed_color(sodium, {1.0, 1.0}), Error);
}

TEST(Spectrum, ATableOfALightIsThatLight) {
    SpectralTable table;
    for (int nm = 380; nm <= 780; nm += 10)
        table.push_back({static_cast<double>(nm), relative_power(StandardLight{}, nm)});
    const Spectrum measured = tabulated_light("d65.csv", table);
    EXPECT_EQ(name(measured), "d65.csv");
    const Chromaticity of = chromaticity(measured);
    EXPECT_NEAR(of.x, 0.31272, 2e-5);
    EXPECT_NEAR(of.y, 0.32903, 2e-5);
    EXPECT_EQ(relative_power(measured, 300.0), 0.0);
    EXPECT_EQ(relative_power(measured, 800.0), 0.0);
}

TEST(Spectrum, SamplesOfANarrowBandHoldItsPower) {
    // A band of 4 nm between the midpoints of 16 bands: midpoints alone would miss it.
    const Spectrum narrow = tabulated_light("laser", {{508, 0}, {510, 1}, {512, 0}});
    double weight = 0.0, mean = 0.0;
    for (const SpectralSample& s : sample(narrow, 16)) {
        weight += s.weight;
        mean += s.weight * s.wavelength_nm;
    }
    EXPECT_NEAR(weight, 1.0, 1e-12);
    EXPECT_NEAR(mean, 510.0, 300.0 / 16 / 2);  // half a band
}

TEST(Spectrum, RefusesTablesThatAreNone) {
    const auto refusal = [](SpectralTable table) {
        return error_of([&] { tabulated_light("t", std::move(table)); });
    };
    EXPECT_THAT(refusal({{500, 1}}).problem, testing::HasSubstr("too short"));
    EXPECT_THAT(refusal({{500, 1}, {490, 1}}).problem, testing::HasSubstr("do not rise"));
    EXPECT_EQ(refusal({{500, 1}, {500, 1}}).where, "entry 2");
    EXPECT_THAT(refusal({{500, 1}, {510, -0.1}}).found, testing::HasSubstr("-0.1"));
    EXPECT_THAT(refusal({{-5, 1}, {510, 1}}).problem, testing::HasSubstr("wavelength"));
    EXPECT_THAT(refusal({{500, 1}, {510, std::nan("")}}).problem, testing::HasSubstr("power"));
    EXPECT_THAT(refusal({{800, 1}, {1000, 1}}).found, testing::HasSubstr("800 to 1000"));
    EXPECT_THAT(refusal({{400, 0}, {700, 0}}).expected, testing::HasSubstr("400 and 700"));
    EXPECT_THAT(refusal({{400, 0}, {700, 0}}).found, testing::HasSubstr("no power"));
}

TEST(Spectrum, OneLightBalancedForAnother) {
    const Rgb same = balanced_for(StandardLight{}, StandardLight{});
    EXPECT_EQ(same.r, 1.0);
    // Lamplight under daylight's balance is red, daylight under lamplight's blue; the two undo one
    // another, and luminance stays.
    const Rgb warm = balanced_for(StandardLight{Illuminant::d65}, StandardLight{Illuminant::a});
    const Rgb cold = balanced_for(StandardLight{Illuminant::a}, StandardLight{Illuminant::d65});
    EXPECT_GT(warm.r, 1.5);
    EXPECT_LT(warm.b, 0.5);
    EXPECT_NEAR(warm.r * cold.r, 1.0, 1e-9);
    EXPECT_NEAR(warm.b * cold.b, 1.0, 1e-9);
    // D65 is very nearly Rec.709's white: its balance is none, and luminances are kept.
    EXPECT_NEAR(0.2126 * warm.r + 0.7152 * warm.g + 0.0722 * warm.b, 1.0, 0.01);
    // A line shown alone is neutral; beside daylight it has its colour, outside the gamut.
    const Rgb line = balanced_for(StandardLight{}, Monochromatic{589.2});
    EXPECT_GT(line.r, 1.0);
    EXPECT_LT(line.b, 0.0);
}

}  // namespace
}  // namespace ghostlight
