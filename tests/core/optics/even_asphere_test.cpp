#include "core/optics/even_asphere.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

double sag(double c, double k, const std::map<int, double>& terms, double r) {
    double z = c * r * r / (1.0 + std::sqrt(1.0 - (1.0 + k) * c * c * r * r));
    for (const auto& [power, term] : terms) z += term * std::pow(r, power);
    return z;
}

double sag(const EvenAsphere& surface, double r) {
    std::map<int, double> terms;
    for (std::size_t i = 0; i < surface.aspheric.size(); ++i)
        terms[4 + 2 * static_cast<int>(i)] = surface.aspheric[i];
    return sag(curvature_per_mm(surface.curve), surface.conic, terms, r);
}

TEST(EvenAsphere, EvenTermsAreTakenAsTheyAre) {
    const EvenAsphere even = even_asphere({0.02, -0.5, {{4, 1e-6}, {8, -2e-11}}}, 12.0);
    EXPECT_TRUE(even.exact);
    EXPECT_EQ(even.curve, BaseCurve(Curvature{0.02}));
    EXPECT_EQ(even.conic, -0.5);
    EXPECT_EQ(even.aspheric, (std::vector<double>{1e-6, 0.0, -2e-11}));
}

/// A term in r² adds twice itself to the vertex curvature; that of a plane is then a paraboloid.
TEST(EvenAsphere, SquareTermsBendTheVertex) {
    const EvenAsphere even = even_asphere({0.02, 0.0, {{2, 1e-3}}}, 10.0);
    EXPECT_FALSE(even.exact);
    constexpr double fit_per_mm = 1e-9;  // of a series cut after r²⁴, (0.22)² per term
    EXPECT_NEAR(curvature_per_mm(even.curve), 0.022, fit_per_mm);
    EXPECT_LT(even.sag_error_mm, 1e-10);
}

/// The published 35 mm f/1.4 asphere of US 7,663,816, surface 1: an r³ term of some micrometres.
TEST(EvenAsphere, OddTermsAreFollowed) {
    const double c = 1.0 / -224.2964, rim = 14.73;
    const std::map<int, double> terms = {{3, -2.0873e-7},  {4, -1.2426e-5},  {6, 2.7998e-9},
                                         {8, -5.1736e-11}, {10, 1.7973e-13}, {12, -8.9748e-17}};
    const EvenAsphere even = even_asphere({c, 195.0, terms}, rim);
    EXPECT_FALSE(even.exact);
    double worst = 0.0;
    for (double r = 0.05; r <= rim; r += 0.0917)
        worst = std::max(worst, std::abs(sag(even, r) - sag(c, 195.0, terms, r)));
    // What it says of itself holds between its own samples too, and is below a nanometre.
    EXPECT_LE(worst, 1.2 * even.sag_error_mm);
    EXPECT_LT(even.sag_error_mm, 1e-6);
    EXPECT_LT(even.slope_error, 2e-6);
}

TEST(EvenAsphere, AConeCannotBeFollowedAndSaysSo) {
    const EvenAsphere even = even_asphere({0.0, 0.0, {{1, 0.01}}}, 10.0);
    // At its tip the slope jumps by 0.02, and no even polynomial does.
    EXPECT_GT(even.slope_error, 1e-3);
}

TEST(EvenAsphere, BadInputIsRefused) {
    error_of([] { even_asphere({0.0, 0.0, {{3, 1.0}}}, 0.0); });
    error_of([] { even_asphere({0.0, 0.0, {{0, 1.0}}}, 1.0); });
}

}  // namespace
}  // namespace ghostlight
