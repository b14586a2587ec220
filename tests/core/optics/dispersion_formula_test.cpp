#include "core/optics/dispersion_formula.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/units.h"
#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

Medium agf(int formula, std::vector<double> coefficients) {
    return {"test", AgfGlass{formula, std::move(coefficients)}};
}
Medium database(int formula, std::vector<double> coefficients) {
    return {"test", FormulaGlass{formula, std::move(coefficients)}};
}

struct Published {
    const char* source;
    int formula;
    std::vector<double> coefficients;
    double nd, vd;
};

// nd and Vd beside the coefficients, as the makers print them. J-BK7A, E-BAK1 and SF1 (Nikon's
// catalogue of 2017) through refractiveindex.info, whose formula 3 lists the powers.
const std::vector<Published> glasses{
    {"BK7, Schott 1980s",
     1,
     {2.2718929, -1.0108077e-2, 1.0592509e-2, 2.0816965e-4, -7.6472538e-6, 4.9240991e-7},
     1.51680,
     64.17},
    {"TAF1, Hoya 2017",
     1,
     {3.0736378, -0.015501284, 0.023627699, 0.00066300852, -2.8353438e-05, 2.2090799e-06},
     1.77250,
     49.62},
    {"E-BAK1, Nikon 2017",
     1,
     {2.44353274, -0.0161455184, 0.00881927898, 0.00144687542, -0.000136331798, 6.03309808e-06},
     1.572500,
     57.738955},
    {"N-BK7, Schott",
     2,
     {1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653},
     1.51680,
     64.17},
    // The last power of the extended forms is 0 in these two: as formulas 10 and 12 they are the
    // same glasses.
    {"SF1, Nikon 2017, as Extended",
     10,
     {2.839803, -0.004469128, 0.03464028, 0.001334322, -5.451762e-05, 1.214724e-05, 0.0, 0.0},
     1.717360,
     29.486634},
    {"SF1, Nikon 2017, as Extended 2",
     12,
     {2.839803, -0.004469128, 0.03464028, 0.001334322, -5.451762e-05, 1.214724e-05, 0.0, 0.0},
     1.717360,
     29.486634},
    {"J-BK7A, Nikon 2017",
     13,
     {2.27110883, -0.00938988354, -0.000100277081, 0.0109572221, 0.000120210067, 3.31079774e-06,
      -1.48235581e-08},
     1.516800,
     64.129950},
};

TEST(AgfFormula, GivesThePublishedIndexAndAbbeNumber) {
    constexpr double printed_nd = 5.1e-6;  // half of the last digit of those with five
    constexpr double printed_vd = 5.1e-3;  // half of the last digit of those with two
    for (const Published& glass : glasses) {
        const Medium medium = agf(glass.formula, glass.coefficients);
        EXPECT_NEAR(refractive_index(medium, d_line_nm), glass.nd, printed_nd) << glass.source;
        EXPECT_NEAR(abbe_number(medium), glass.vd, printed_vd) << glass.source;
    }
}

TEST(AgfFormula, HerzbergerIsSiliconsOfEdwardsAndOchoa) {
    // Appl. Opt. 19 (1980) 4130; Salzberg and Villa measured 3.4257 at 3.9980 µm and 3.4223 at
    // 4.9 to 5 µm (J. Opt. Soc. Am. 47 (1957) 244); Edwards' samples differ by less than 3e-3.
    const std::vector<double> silicon{3.41983, 0.159906, -0.123109, 1.26878e-6, -1.95104e-9};
    constexpr double between_samples = 4e-3;
    EXPECT_NEAR(refractive_index(agf(3, silicon), 3998.0), 3.4257, between_samples);
    EXPECT_EQ(refractive_index(agf(3, silicon), 3998.0),
              refractive_index(database(7, silicon), 3998.0));
}

// Formulas of which no glass is at hand, against the same curve in refractiveindex.info's forms,
// whose powers are coefficients.
TEST(AgfFormula, AgreesWithTheOtherSetOfForms) {
    constexpr double rounding = 4e-15;  // two orders of summing the same terms
    struct Pair {
        Medium agf, database;
    };
    const std::vector<Pair> pairs{
        {agf(1, {2.3, -0.01, 0.011, 2e-4, -7e-6, 5e-7}),
         database(3, {2.3, -0.01, 2, 0.011, -2, 2e-4, -4, -7e-6, -6, 5e-7, -8})},
        {agf(2, {1.0, 0.006, 0.2, 0.02, 1.0, 103.0}),
         database(2, {0.0, 1.0, 0.006, 0.2, 0.02, 1.0, 103.0})},
        // Sellmeier 2: λ² over one pole, 1 over the other, both squared.
        {agf(4, {0.2, 1.1, 0.11, -0.9, 9.5}), database(4, {1.2, 1.1, 2, 0.11, 2, -0.9, 0, 9.5, 2})},
        {agf(5, {1.5, 0.012, 0.0004}), database(5, {1.5, 0.012, -1, 0.0004, -3.5})},
        {agf(6, {1.0, 0.006, 0.2, 0.02, 1.0, 103.0, 0.05, 0.01}),
         database(2, {0.0, 1.0, 0.006, 0.2, 0.02, 1.0, 103.0, 0.05, 0.01})},
        {agf(7, {2.3, 0.012, 0.02, 0.009}),
         database(4, {2.3, 0.012, 0, 0.02, 1, 0, 0, 0, 1, -0.009, 2})},
        {agf(8, {1.3, 1.0, 0.012, 0.009}),
         database(4, {1.3, 1.0, 2, 0.012, 1, 0, 0, 0, 1, -0.009, 2})},
        {agf(9, {1.3, 1.0, 0.012, 0.9, 100.0}),
         database(4, {1.3, 1.0, 2, 0.012, 1, 0.9, 2, 100.0, 1})},
        {agf(10, {2.3, -0.01, 0.011, 2e-4, -7e-6, 5e-7, -3e-8, 2e-9}),
         database(
             3, {2.3, -0.01, 2, 0.011, -2, 2e-4, -4, -7e-6, -6, 5e-7, -8, -3e-8, -10, 2e-9, -12})},
        {agf(11, {1.0, 0.006, 0.2, 0.02, 1.0, 103.0, 0.05, 0.01, 0.1, 0.03}),
         database(2, {0.0, 1.0, 0.006, 0.2, 0.02, 1.0, 103.0, 0.05, 0.01, 0.1, 0.03})},
        {agf(12, {2.3, -0.01, 0.011, 2e-4, -7e-6, 5e-7, -2e-4, 3e-5}),
         database(3, {2.3, -0.01, 2, 0.011, -2, 2e-4, -4, -7e-6, -6, 5e-7, -8, -2e-4, 4, 3e-5, 6})},
        {agf(13, {2.3, -0.01, -1e-4, 0.011, 2e-4, -7e-6, 5e-7, -3e-8, 2e-9}),
         database(3, {2.3, -0.01, 2, -1e-4, 4, 0.011, -2, 2e-4, -4, -7e-6, -6, 5e-7, -8, -3e-8, -10,
                      2e-9, -12})},
    };
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (const double nm : {400.0, 587.5618, 1000.0, 1550.0})
            EXPECT_NEAR(refractive_index(pairs[i].agf, nm), refractive_index(pairs[i].database, nm),
                        rounding)
                << "pair " << i << " at " << nm << " nm";
}

TEST(DatabaseFormula, LaterNumbersByHand) {
    // Rosker 1985, urea, extraordinary, formula 9: 2.51527 + 0.024/(λ² − 0.03) +
    // 0.02 (λ − 1.52)/((λ − 1.52)² + 0.8771), by hand at 1 µm.
    const Medium urea = database(9, {2.51527, 0.0240, 0.0300, 0.020, 1.52, 0.8771});
    EXPECT_NEAR(refractive_index(urea, 1000.0),
                std::sqrt(2.51527 + 0.024 / 0.97 - 0.02 * 0.52 / (0.2704 + 0.8771)), 1e-15);
    // Schröter 1931, TlCl, formula 8: the Lorentz–Lorenz fraction is 0.47856 + 0.07858 λ²/(λ² −
    // 0.08277) − 0.00881 λ².
    const Medium tlcl = database(8, {0.47856, 0.07858, 0.08277, -0.00881});
    const double n = refractive_index(tlcl, 600.0);
    EXPECT_NEAR((n * n - 1.0) / (n * n + 2.0),
                0.47856 + 0.07858 * 0.36 / (0.36 - 0.08277) - 0.00881 * 0.36, 1e-15);
    // A group of formula 4 that is all zero has no pole, not even where its denominator is 0.
    EXPECT_EQ(refractive_index(database(4, {2.25, 0, 0, 0, 1, 0, 0, 1, 1}), 1000.0), 1.5);
}

TEST(AgfFormula, OutsideItsRangeAnErrorNamesTheGlass) {
    Medium glass = agf(2, {1.0, 0.006, 0.2, 0.02, 1.0, 103.0});
    std::get<AgfGlass>(glass.dispersion).min_nm = 400.0;
    std::get<AgfGlass>(glass.dispersion).max_nm = 700.0;
    EXPECT_NO_THROW(refractive_index(glass, 400.0));
    const Error::Parts error = error_of([&] { refractive_index(glass, 399.0); });
    EXPECT_THAT(error.problem, testing::HasSubstr("test"));
    EXPECT_THAT(error.expected, testing::HasSubstr("400"));
    EXPECT_THAT(error_of([] { refractive_index(agf(14, {1.0}), 500.0); }).problem,
                testing::HasSubstr("14"));
    // The pole of a Sellmeier term.
    error_of([] { refractive_index(agf(2, {1.0, 0.25}), 500.0); });
}

}  // namespace
}  // namespace ghostlight
