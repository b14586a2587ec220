#include "core/optics/glass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/io/lens_file.h"
#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

Medium with_formula(int number, std::vector<double> coefficients, double min_nm = 0.0,
                    double max_nm = 0.0) {
    return {"test", FormulaGlass{.formula = number,
                                 .coefficients = std::move(coefficients),
                                 .min_nm = min_nm,
                                 .max_nm = max_nm}};
}

TEST(Glass, BundledGlassesAgreeWithASeparateProgram) {
    // The table has 12 decimals; the formulas are evaluated in double.
    constexpr double tolerance = 1e-11;
    std::ifstream file(test_data_folder() / "glass_indices.csv");
    ASSERT_TRUE(file);
    std::string line;
    std::getline(file, line);
    int compared = 0;
    while (std::getline(file, line)) {
        std::istringstream fields(line);
        std::string name, wavelength, index;
        std::getline(fields, name, ',');
        std::getline(fields, wavelength, ',');
        std::getline(fields, index, ',');
        const Medium* glass = bundled_glasses().find(name);
        ASSERT_NE(glass, nullptr) << name;
        EXPECT_NEAR(refractive_index(*glass, std::stod(wavelength)), std::stod(index), tolerance)
            << name << " at " << wavelength << " nm";
        ++compared;
    }
    EXPECT_EQ(compared, 4 * 108);
}

TEST(Glass, ModelGlassReturnsItsNumbers) {
    for (const ModelGlass model : {ModelGlass{1.5168, 64.17}, ModelGlass{1.84666, 23.78},
                                   ModelGlass{1.43876, 94.99}, ModelGlass{2.001, 20.0}}) {
        const Medium glass{"", model};
        EXPECT_EQ(refractive_index(glass, d_line_nm), model.nd);
        // nF − nC is a small difference of two indices: 1 ulp of each is 2e-14 of it.
        EXPECT_NEAR(abbe_number(glass) / model.vd, 1.0, 1e-12);
    }
}

TEST(Glass, ModelGlassOfTheTessar) {
    const Medium glass{"", ModelGlass{1.691, 54.8}};
    EXPECT_NEAR(refractive_index(glass, f_line_nm), 1.6998140600963039, 1e-14);
    EXPECT_NEAR(refractive_index(glass, c_line_nm), 1.687204571045209, 1e-14);
}

TEST(Glass, ConstantIndexHasNoDispersion) {
    const Medium glass{"", ConstantIndex{1.5}};
    EXPECT_EQ(refractive_index(glass, 400.0), 1.5);
    EXPECT_TRUE(std::isinf(abbe_number(glass)));
    EXPECT_FALSE(is_air(glass));
    EXPECT_TRUE(is_air(Medium{}));
}

TEST(Glass, FormulasByHand) {
    // At 1 µm every power of the wavelength is 1.
    EXPECT_NEAR(refractive_index(with_formula(1, {0.1, 1.0, 0.5}), 1000.0),
                std::sqrt(1.0 + 0.1 + 1.0 / 0.75), 1e-15);
    EXPECT_NEAR(refractive_index(with_formula(2, {0.1, 1.0, 0.5}), 1000.0),
                std::sqrt(1.0 + 0.1 + 1.0 / 0.5), 1e-15);
    EXPECT_NEAR(refractive_index(with_formula(3, {2.0, 0.3, -2.0}), 2000.0),
                std::sqrt(2.0 + 0.3 / 4.0), 1e-15);
    EXPECT_NEAR(refractive_index(with_formula(4, {2.0, 0.5, 2.0, 0.3, 2.0}), 1000.0),
                std::sqrt(2.0 + 0.5 / (1.0 - 0.09)), 1e-15);
    EXPECT_NEAR(refractive_index(with_formula(5, {1.5, 0.01, -2.0}), 2000.0), 1.5 + 0.01 / 4.0,
                1e-15);
    EXPECT_NEAR(refractive_index(with_formula(6, {0.0, 0.05, 238.0}), 1000.0), 1.0 + 0.05 / 237.0,
                1e-15);
}

TEST(Glass, OutsideItsRangeAnErrorNamesGlassWavelengthAndRange) {
    const Medium* glass = bundled_glasses().find("N-SF11");
    ASSERT_NE(glass, nullptr);
    const Error::Parts error = error_of([&] { refractive_index(*glass, 300.0); });
    EXPECT_THAT(error.problem, testing::HasSubstr("N-SF11"));
    EXPECT_THAT(error.found, testing::HasSubstr("300"));
    EXPECT_THAT(error.expected, testing::HasSubstr("370"));
    error_of([&] { refractive_index(*glass, 3000.0); });
    EXPECT_NO_THROW(refractive_index(*glass, 370.0));
    EXPECT_NO_THROW(refractive_index(*glass, 2500.0));
}

TEST(Glass, NeverNaN) {
    const Medium pole = with_formula(2, {0.0, 1.0, 0.25});  // pole at 500 nm
    EXPECT_THAT(error_of([&] { refractive_index(pole, 500.0); }).problem,
                testing::HasSubstr("pole"));
    error_of([&] { refractive_index(pole, 499.0); });  // n² < 0
    EXPECT_GT(refractive_index(pole, 600.0), 1.0);
    error_of([&] { refractive_index(with_formula(3, {0.5}), 500.0); });  // n² < 1
    error_of([&] { refractive_index(with_formula(9, {0.5}), 500.0); });
    for (const double nm : {0.0, -500.0, std::nan(""), HUGE_VAL})
        error_of([&] { refractive_index(Medium{}, nm); });
    // A model glass far from visible light bends below 1.
    error_of([] { refractive_index({"", ModelGlass{1.01, 1.0}}, 5000.0); });
}

TEST(Glass, CatalogueIgnoresCase) {
    EXPECT_EQ(bundled_glasses().find("n-bk7")->name, "N-BK7");
    EXPECT_EQ(bundled_glasses().find("BK7"), nullptr);
    EXPECT_EQ(*bundled_glasses().find("mgf2"), magnesium_fluoride());
}

TEST(Glass, MagnesiumFluorideIsDodges) {
    // Dodge 1984 table: 1.3777 at 587.6 nm, ordinary ray.
    EXPECT_NEAR(refractive_index(magnesium_fluoride(), d_line_nm), 1.3777, 5e-5);
}

}  // namespace
}  // namespace ghostlight
