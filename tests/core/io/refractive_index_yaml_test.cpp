#include "core/io/refractive_index_yaml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/error_of.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

using testing::HasSubstr;

const std::filesystem::path folder = test_data_folder() / "materials";

TEST(RefractiveIndexYaml, ReadsAFormulaWithExtinctionAndProperties) {
    const GlassFile file = read_material_yaml(folder / "J-BK7A.yml");
    ASSERT_EQ(file.glasses.size(), 1U);
    const CataloguedGlass& glass = file.glasses[0];
    EXPECT_EQ(glass.medium.name, "J-BK7A");
    EXPECT_EQ(glass.catalog, "MATERIALS");
    EXPECT_EQ(glass.comment, "A crown");
    EXPECT_EQ(glass.listed_nd, 1.5168);
    EXPECT_NEAR(glass.nd.value(), 1.5168, 5e-7);    // as printed
    EXPECT_NEAR(glass.vd.value(), 64.12995, 1e-4);  // as printed, of a small difference
    EXPECT_TRUE(file.notes.empty());
    ASSERT_EQ(glass.extinction.size(), 3U);
    EXPECT_NEAR(glass.extinction[1].wavelength_nm, 500.0, 1e-9);
    // τ = exp(−4π k d/λ), here for 10 mm at 500 nm.
    EXPECT_NEAR(internal_transmittance(glass.medium, 500.0, 10.0),
                std::exp(-4.0 * std::numbers::pi * 1.5947e-8 * 10.0 / 500e-6), 1e-12);
}

TEST(RefractiveIndexYaml, ReadsATableOfNAndK) {
    const CataloguedGlass silver = read_material_yaml(folder / "Ag.yml").glasses.at(0);
    EXPECT_EQ(refractive_index(silver.medium, 548.6), 0.06);
    EXPECT_EQ(linear_at(silver.extinction, 548.6), 3.586);
    EXPECT_EQ(std::get<TabulatedGlass>(silver.medium.dispersion).index.size(), 4U);
}

struct Fault {
    const char* text;
    const char* where;
    const char* problem;
};

class RefractiveIndexYamlFaults : public testing::TestWithParam<Fault> {};

TEST_P(RefractiveIndexYamlFaults, AreNamedWithTheirLine) {
    const Error::Parts error = error_of([] { material_from_yaml(GetParam().text, "glass/x.yml"); });
    EXPECT_EQ(error.file, "glass/x.yml");
    EXPECT_EQ(error.where, GetParam().where);
    EXPECT_THAT(error.problem, HasSubstr(GetParam().problem));
}

INSTANTIATE_TEST_SUITE_P(
    All, RefractiveIndexYamlFaults,
    testing::Values(
        Fault{"a: 1\n", "line 1", "no material"},
        Fault{"DATA:\n  - type: formula 12\n    coefficients: 1\n", "line 2", "formula 12"},
        Fault{"DATA:\n  - type: formula 2\n    coefficients: 1 x\n", "line 3", "'x'"},
        Fault{"DATA:\n  - type: formula 2\n", "line 2", "coefficients"},
        Fault{"DATA:\n  - type: tabulated n\n    data: |\n        0.4 1.5\n        0.5\n", "line 5",
              "not a row"},
        Fault{"DATA:\n  - type: tabulated k\n    data: |\n        0.4 1.5\n", "line 2", "only k"},
        Fault{"DATA: [}\n", "line 1", "YAML"},
        Fault{"a: &x [1, 2]\nDATA: [*x, *x]\n", "line 2", "alias"},
        Fault{"DATA: [[[[[[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]]]]]\n", "line 1", "too deeply"}));

TEST(RefractiveIndexYaml, ABombOfAliasesIsRefusedAtOnce) {
    std::string bomb = "a: &a [x, x, x, x, x, x, x, x, x]\n";
    for (char c = 'b'; c < 'k'; ++c) {
        bomb += std::string(1, c) + ": &" + c + " [";
        for (int i = 0; i < 9; ++i) bomb += std::string(i > 0 ? ", *" : "*") + char(c - 1);
        bomb += "]\n";
    }
    EXPECT_THAT(error_of([&] { material_from_yaml(bomb, "x.yml"); }).problem, HasSubstr("alias"));
    EXPECT_THAT(error_of([] { material_from_yaml(std::string(100'000, '['), "x.yml"); }).problem,
                HasSubstr("too deeply"));
}

TEST(RefractiveIndexYaml, EveryTruncationIsReadOrRefused) {
    const std::string text =
        "DATA:\n  - type: tabulated nk\n    data: |\n        0.4 1.5 0\n        0.5 1.4 1e-3\n"
        "  - type: tabulated k\n    data: |\n        0.4 1.5\nPROPERTIES:\n    nd: 1.5\n";
    for (std::size_t size = 0; size <= text.size(); ++size) {
        try {
            material_from_yaml(text.substr(0, size), "x.yml");
        } catch (const Error&) {
        }
    }
}

}  // namespace
}  // namespace ghostlight
