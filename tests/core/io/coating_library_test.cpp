// The library's designs against what the literature says of them, with R computed by Rouard's
// recursion of Fresnel coefficients, which shares nothing with the characteristic matrix.
#include "core/io/coating_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>

#include "core/error.h"
#include "core/io/coating_json.h"
#include "core/io/lens_file.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double design_nm = 550.0;
constexpr double crown = 1.52;
constexpr double rounding = 1e-14;

/// R at normal incidence of layers from the air side.
double rouard(const std::vector<FilmLayer>& layers, double substrate, double nm) {
    using Number = std::complex<double>;
    auto fresnel = [](double a, double b) { return (a - b) / (a + b); };
    double n_below = substrate;
    Number r = 0.0;
    bool first = true;
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
        const Number below = first ? Number(fresnel(layer->n, n_below)) : r;
        const Number turn =
            std::polar(1.0, 4.0 * std::numbers::pi * layer->n * layer->thickness_nm / nm);
        // Seen from just above the layer's upper face, in the medium above.
        const double n_above = std::next(layer) == layers.rend() ? 1.0 : std::next(layer)->n;
        const double upper = fresnel(n_above, layer->n);
        r = (upper + below * turn) / (1.0 + upper * below * turn);
        n_below = layer->n;
        first = false;
    }
    return layers.empty() ? std::pow(fresnel(1.0, substrate), 2) : std::norm(r);
}

double reflectance(std::string_view name, double nm, double substrate = crown) {
    const Coating* coating = find_coating(name);
    if (coating == nullptr) {
        ADD_FAILURE() << name << " is not in the library";
        return 1.0;
    }
    return reflectances(film_at(*coating, medium(1.0), medium(substrate), nm), 1.0).r();
}

TEST(CoatingLibrary, HasWhatTheLensesNeedAndEachItsSource) {
    for (const char* name : {"uncoated", "mgf2-quarter-wave", "ideal-quarter-wave", "v-coat",
                             "two-layer-quarter-quarter", "two-layer-quarter-half",
                             "three-layer-quarter-half-quarter", "four-layer-two-materials"})
        EXPECT_NE(find_coating(name), nullptr) << name;
    EXPECT_EQ(find_coating("nothing"), nullptr);
    EXPECT_EQ(find_coating("V-COAT"), find_coating("v-coat"));
    for (const LibraryCoating& each : coating_library()) {
        EXPECT_FALSE(each.source.empty()) << each.name;
        EXPECT_FALSE(each.title.empty()) << each.name;
        EXPECT_EQ(each.name, each.file.stem().string());
        Prescription lens = lens_of({row(50.0, 5.0, 1.5), row(-50.0, 90.0, 1.0)});
        lens.surfaces[0].coating = each.coating;
        EXPECT_NO_THROW(validate(lens)) << each.name;
    }
}

TEST(CoatingLibrary, CurvesAgreeWithRouardsRecursion) {
    for (const LibraryCoating& each : coating_library())
        for (double nm = 380.0; nm <= 780.0; nm += 5.0) {
            const Film film = film_at(each.coating, medium(1.0), medium(crown), nm);
            EXPECT_NEAR(reflectances(film, 1.0).r(), rouard(film.layers, crown, nm), rounding)
                << each.name << " at " << nm;
        }
}

TEST(CoatingLibrary, BothFacesOfALensHaveTheSameCoating) {
    for (const LibraryCoating& each : coating_library()) {
        const Film front = film_at(each.coating, medium(1.0), medium(crown), 500.0);
        const Film rear = film_at(each.coating, medium(crown), medium(1.0), 500.0);
        EXPECT_EQ(rear, reversed(front)) << each.name;
    }
}

TEST(CoatingLibrary, BareGlassIsFresnels) {
    EXPECT_NEAR(reflectance("uncoated", 500.0), std::pow(0.52 / 2.52, 2), rounding);
}

TEST(CoatingLibrary, QuarterWavesAreTheirClosedForm) {
    const double n1 = refractive_index(magnesium_fluoride(), design_nm);
    for (const double n : {1.52, 1.8}) {
        EXPECT_NEAR(reflectance("mgf2-quarter-wave", design_nm, n),
                    std::pow((n - n1 * n1) / (n + n1 * n1), 2), rounding);
        EXPECT_NEAR(reflectance("ideal-quarter-wave", design_nm, n), 0.0, rounding);
    }
}

TEST(CoatingLibrary, VCoatHasItsZero) {
    EXPECT_NEAR(reflectance("v-coat", design_nm), 0.0, rounding);
    // And no other: it rises on both sides, beyond the single layer's 1.3 % within 100 nm.
    double before = 0.0;
    for (double nm = 555.0; nm <= 700.0; nm += 5.0) {
        EXPECT_GT(reflectance("v-coat", nm), before) << nm;
        before = reflectance("v-coat", nm);
    }
    before = 0.0;
    for (double nm = 545.0; nm >= 450.0; nm -= 5.0) {
        EXPECT_GT(reflectance("v-coat", nm), before) << nm;
        before = reflectance("v-coat", nm);
    }
    EXPECT_GT(reflectance("v-coat", 450.0), 0.013);
}

TEST(CoatingLibrary, TwoQuarterWavesAreTheirClosedForm) {
    const double y = 1.7 * 1.7, x = crown * 1.38 * 1.38;
    EXPECT_NEAR(reflectance("two-layer-quarter-quarter", design_nm), std::pow((y - x) / (y + x), 2),
                rounding);
}

// A quarter wave and a half wave are functions of the wave number about the design's alone.
void expect_symmetric(std::string_view name) {
    for (double detuning = 0.02; detuning <= 0.3; detuning += 0.02)
        EXPECT_NEAR(reflectance(name, design_nm / (1.0 + detuning)),
                    reflectance(name, design_nm / (1.0 - detuning)), rounding)
            << name << " " << detuning;
}

TEST(CoatingLibrary, QuarterHalfIsTheSingleLayerInTheMiddleAndLowerBeside) {
    const double single = std::pow((crown - 1.38 * 1.38) / (crown + 1.38 * 1.38), 2);
    EXPECT_NEAR(reflectance("two-layer-quarter-half", design_nm), single, rounding);
    expect_symmetric("two-layer-quarter-half");
    // The W: both minima lie below the middle.
    EXPECT_LT(reflectance("two-layer-quarter-half", 480.0), 0.5 * single);
    EXPECT_LT(reflectance("two-layer-quarter-half", 650.0), 0.5 * single);
}

TEST(CoatingLibrary, QuarterHalfQuarterIsBroad) {
    // The half wave is absent at the design wavelength: two quarter waves remain.
    const double y = 1.7 * 1.7, x = crown * 1.38 * 1.38;
    const double middle = std::pow((y - x) / (y + x), 2);
    EXPECT_NEAR(reflectance("three-layer-quarter-half-quarter", design_nm), middle, rounding);
    expect_symmetric("three-layer-quarter-half-quarter");
    for (double nm = 450.0; nm <= 700.0; nm += 2.0) {
        EXPECT_LT(reflectance("three-layer-quarter-half-quarter", nm), 0.005) << nm;
        // What it is for: the two-layer coating without the half wave is narrower.
        if (nm < 480.0 || nm > 660.0) {
            EXPECT_LT(reflectance("three-layer-quarter-half-quarter", nm),
                      reflectance("two-layer-quarter-quarter", nm))
                << nm;
        }
    }
}

TEST(CoatingLibrary, FourLayersOfTwoMaterialsStandInForThree) {
    EXPECT_NEAR(reflectance("four-layer-two-materials", design_nm),
                reflectance("three-layer-quarter-half-quarter", design_nm), 1e-12);
    const auto& stack = std::get<LayerStack>(*find_coating("four-layer-two-materials"));
    for (const Layer& layer : stack.layers) {
        const double n = refractive_index(layer.medium, design_nm);
        EXPECT_TRUE(n == 1.38 || n == 2.15) << n;
    }
    for (double nm = 450.0; nm <= 700.0; nm += 2.0)
        EXPECT_LT(reflectance("four-layer-two-materials", nm), 0.01) << nm;
}

TEST(CoatingLibrary, ALensKeepsTheName) {
    Prescription lens = lens_of({row(50.0, 5.0, 1.5), row(-50.0, 90.0, 1.0)});
    lens.surfaces[0].coating = *find_coating("v-coat");
    const std::string text = lens_to_json(lens);
    EXPECT_THAT(text, testing::HasSubstr("\"coating\": \"v-coat\""));
    EXPECT_EQ(lens_from_json(text, "x").lens, lens);
    EXPECT_EQ(describe(lens.surfaces[0].coating), "v-coat");
    // Once changed it is no longer the library's, and its layers go into the file.
    std::get<LayerStack>(lens.surfaces[0].coating).layers[0].thickness_nm += 1.0;
    const std::string changed = lens_to_json(lens);
    EXPECT_THAT(changed, testing::HasSubstr("\"layers\""));
    EXPECT_EQ(lens_from_json(changed, "x").lens, lens);
}

TEST(CoatingLibrary, AFileThatIsWrongIsNamed) {
    auto fault = [](const char* text) {
        return error_of([&] { library_coating_from_json(text, "a.json"); });
    };
    EXPECT_EQ(fault("{").file, "a.json");
    EXPECT_EQ(fault(R"({"ghostlight_coating": 2})").where, "ghostlight_coating");
    EXPECT_EQ(fault(R"({"ghostlight_coating": 1, "name": "a"})").where, "coating");
    EXPECT_THAT(
        fault(R"({"ghostlight_coating": 1, "name": "a", "coating": "none", "colour": 1})").problem,
        testing::HasSubstr("colour"));
    // A library coating cannot name another.
    EXPECT_EQ(fault(R"({"ghostlight_coating": 1, "name": "a", "coating": "v-coat"})").where,
              "coating");
}

}  // namespace
}  // namespace ghostlight
