#include "core/flare/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/flare/aperture_outline.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;

TEST(FresnelIntegrals, AreThoseOfTheTables) {
    // Abramowitz and Stegun, table 7.7.
    const double table[][3] = {{0.5, 0.4923442, 0.0647324}, {1.0, 0.7798934, 0.4382591},
                               {1.5, 0.4452612, 0.6975050}, {2.0, 0.4882534, 0.3434157},
                               {3.0, 0.6057208, 0.4963130}, {5.0, 0.5636312, 0.4991914}};
    for (const auto& [x, c, s] : table) {
        EXPECT_NEAR(fresnel_integrals(x).c, c, 6e-8) << x;
        EXPECT_NEAR(fresnel_integrals(x).s, s, 6e-8) << x;
        EXPECT_EQ(fresnel_integrals(-x).c, -fresnel_integrals(x).c);
    }
    // The two ways of working them out meet without a step; the slope is cos(πx²/2).
    const double x = 1.8, step = 1e-9;
    EXPECT_NEAR(fresnel_integrals(x + step).c, fresnel_integrals(x - step).c, 1e-8);
    for (double at = 0.1; at < 8.0; at += 0.173)
        EXPECT_NEAR((fresnel_integrals(at + 1e-4).s - fresnel_integrals(at - 1e-4).s) / 2e-4,
                    std::sin(0.5 * pi * at * at), 1e-5);
}

TEST(StraightEdge, IsCornus) {
    EXPECT_DOUBLE_EQ(straight_edge(0.0), 0.25);
    double brightest = 0.0, where = 0.0;
    for (double w = 0.0; w < 3.0; w += 1e-4)
        if (straight_edge(w) > brightest) {
            brightest = straight_edge(w);
            where = w;
        }
    // Born and Wolf 8.7.3: 1.370 at 1.217; first minimum 0.778 at 1.872.
    EXPECT_NEAR(brightest, 1.3704, 1e-4);
    EXPECT_NEAR(where, 1.2172, 1e-3);
    EXPECT_NEAR(where / std::sqrt(2.0), 0.861, 1e-3) << "of √(λz)";
    EXPECT_NEAR(straight_edge(1.8725), 0.7782, 1e-3);
    EXPECT_LT(straight_edge(-4.0), 0.01);
}

MaskRaster stop_raster(int blades, double fresnel_number, double rotation_rad = 0.0) {
    StopMask mask;
    mask.semi_diameter_mm = 1.0;
    mask.blades = blades;
    mask.rotation_rad = rotation_rad;
    return mask_raster(mask, {}, propagation_raster(fresnel_number));
}

TEST(Propagated, MiddleOfADiscSwingsBetweenNoneAndFourfold) {
    // On the axis behind a round stop: 4 sin²(πN/2), exactly (Born and Wolf 8.8, the disc).
    for (const double number : {0.5, 1.0, 2.0, 3.0, 4.5, 7.0}) {
        const auto field = propagated(stop_raster(0, number), number, 2);
        ASSERT_TRUE(field);
        const double expected = 4.0 * std::pow(std::sin(0.5 * pi * number), 2);
        // The rim's pixels are off its circle by 0.1 of one; the padding's repeats: 0.1 of 4.
        EXPECT_NEAR(field->at(0.0, 0.0), expected, 0.12) << number;
    }
}

TEST(Propagated, EdgeOfALargeSquareIsCornus) {
    // N = 40, a side's middle part averaged along it: the sides across it then count as open.
    const double number = 40.0, half = std::sqrt(0.5);
    const auto field = propagated(stop_raster(4, number, 0.25 * pi), number, 2);
    double brightest = 0.0, where = 0.0;
    for (double depth = -0.1; depth < 0.3; depth += 0.005) {
        double mean = 0.0;
        constexpr int places = 121;
        for (int k = 0; k < places; ++k)
            mean += field->at(half - depth, 0.6 * half * (2.0 * k / (places - 1.0) - 1.0)) / places;
        // The far side is 1.4 away: 1/(π w) of the amplitude, 0.025, or 5 % of the light; and as
        // much from what the average leaves of the sides across.
        EXPECT_NEAR(mean, straight_edge(depth * std::sqrt(2.0 * number)), 0.1) << depth;
        if (mean > brightest) {
            brightest = mean;
            where = depth;
        }
    }
    EXPECT_NEAR(brightest, 1.37, 0.08);
    EXPECT_NEAR(where * std::sqrt(2.0 * number), 1.217, 0.1);  // steps of 0.045
}

TEST(Propagated, SquareIsTheProductOfItsSlits) {
    // Exact for a square: the slit's amplitude by Fresnel's integrals, once for each direction.
    const double number = 6.0, half = std::sqrt(0.5);
    const auto field = propagated(stop_raster(4, number, 0.25 * pi), number, 2);
    auto slit = [&](double x) {
        const double scale = std::sqrt(2.0 * number);
        const auto low = fresnel_integrals((-half - x) * scale);
        const auto high = fresnel_integrals((half - x) * scale);
        return 0.5 * (std::pow(high.c - low.c, 2) + std::pow(high.s - low.s, 2));
    };
    for (double y = -0.9; y < 0.9; y += 0.13)
        for (double x = -0.9; x < 0.9; x += 0.11)
            // The raster's edges to a tenth of a pixel of 1/256, fringes of 0.2: 2 % of the slope.
            EXPECT_NEAR(field->at(x, y), slit(x) * slit(y), 0.05) << x << ", " << y;
}

TEST(Propagated, LightIsKept) {
    for (const double number : {0.5, 2.0, 8.0, 40.0}) {
        const MaskRaster raster = stop_raster(6, number);
        const auto field = propagated(raster, number, 2);
        double sum = 0.0;
        for (const float value : field->irradiance) sum += static_cast<double>(value);
        // What lands outside of the part that is kept: 1/(π² N reach) of it about.
        EXPECT_NEAR(sum * raster.pitch() * raster.pitch() / raster.area(), 1.0,
                    number < 4.0 ? 0.06 : 0.02)
            << number;
    }
}

TEST(Propagated, NearFocusItTendsToAiry) {
    // N → 0: Fraunhofer's pattern in k = 2πNρ; at N = 0.3 to the phase that is left, 0.3 π at the
    // rim: the first minimum is no longer dark, but where Airy's is.
    const double number = 0.3;
    const auto field = propagated(stop_raster(0, number), number, 2);
    double least = 1e9, where = 0.0;
    for (double r = 0.5; r < 3.0; r += 0.01)
        if (field->at(r, 0.0) < least) {
            least = field->at(r, 0.0);
            where = r;
        }
    EXPECT_NEAR(where * 2.0 * pi * number, 3.8317, 0.25);
    // On the axis π²N² of the open beam to first order, 4 sin² exactly.
    EXPECT_NEAR(field->at(0.0, 0.0), std::pow(pi * number, 2), 0.1 * std::pow(pi * number, 2));
}

}  // namespace
}  // namespace ghostlight
