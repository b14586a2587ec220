#include "core/optics/prescription.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <utility>

#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

Surface surface(BaseCurve curve, double thickness_mm, Medium medium = {}) {
    Surface made;
    made.curve = curve;
    made.thickness_mm = thickness_mm;
    made.medium_after = std::move(medium);
    return made;
}

Configuration configuration(const char* name, std::map<std::size_t, double> thickness_mm,
                            std::optional<double> f_number = {}) {
    Configuration made;
    made.name = name;
    made.thickness_mm = std::move(thickness_mm);
    made.f_number = f_number;
    return made;
}

/// A singlet, a stop and a cemented pair.
Prescription small_lens() {
    const Medium crown{"", ModelGlass{1.5168, 64.17}};
    const Medium flint{"", ModelGlass{1.62, 36.4}};
    Prescription lens;
    lens.name = "small";
    lens.surfaces = {surface(Radius{50.0}, 5.0, crown),
                     surface(Radius{-50.0}, 2.0),
                     surface(Plane{}, 3.0),
                     surface(Radius{40.0}, 4.0, crown),
                     surface(Curvature{-0.02}, 1.0, flint),
                     surface(Radius{-80.0}, 60.0)};
    lens.stop.surface = 2;
    lens.configurations = {configuration("near", {{1, 4.0}, {5, 70.0}}),
                           configuration("far", {}, 8.0)};
    return lens;
}

TEST(Prescription, CurvatureOfEachCurve) {
    EXPECT_EQ(curvature_per_mm(Plane{}), 0.0);
    EXPECT_EQ(curvature_per_mm(Radius{-50.0}), -0.02);
    EXPECT_EQ(curvature_per_mm(Curvature{0.0}), 0.0);
}

TEST(Prescription, MediumBeforeIsAirAtTheFront) {
    const Prescription lens = small_lens();
    EXPECT_TRUE(is_air(medium_before(lens, 0)));
    EXPECT_EQ(medium_before(lens, 1), lens.surfaces[0].medium_after);
    EXPECT_TRUE(is_air(medium_before(lens, 2)));
}

TEST(Prescription, ConfigurationOverridesThicknessesAndStop) {
    const Prescription near = configured(small_lens(), "near");
    EXPECT_EQ(near.surfaces[1].thickness_mm, 4.0);
    EXPECT_EQ(near.surfaces[5].thickness_mm, 70.0);
    EXPECT_EQ(near.surfaces[0].thickness_mm, 5.0);
    EXPECT_FALSE(near.stop.f_number);
    EXPECT_TRUE(near.configurations.empty());
    EXPECT_EQ(configured(small_lens(), "far").stop.f_number, 8.0);

    Prescription listed = small_lens();
    listed.configurations.clear();
    EXPECT_EQ(configured(small_lens(), ""), listed);
}

/// Its own width replaces the lens's f-number; its own f-number wins over both.
TEST(Prescription, ConfigurationStatesItsStopsWidthAndWhatIsPublished) {
    Prescription lens = small_lens();
    lens.stop.f_number = 4.0;
    lens.configurations[0].stop_semi_diameter_mm = 3.0;
    lens.configurations[0].published.efl_mm = 70.0;
    lens.configurations[1].stop_semi_diameter_mm = 3.0;
    EXPECT_FALSE(configured(lens, "near").stop.f_number);
    EXPECT_EQ(configured(lens, "near").stop.semi_diameter_mm, 3.0);
    EXPECT_EQ(configured(lens, "near").published.efl_mm, 70.0);
    EXPECT_EQ(configured(lens, "far").stop.f_number, 8.0);
    EXPECT_EQ(configured(lens, "far").published, lens.published);
}

TEST(Prescription, UnknownConfigurationNamesTheKnownOnes) {
    const Error::Parts error = error_of([] { configured(small_lens(), "tele"); });
    EXPECT_EQ(error.found, "'tele'");
    EXPECT_THAT(error.expected, testing::HasSubstr("'near', 'far'"));
    Prescription zoomless = small_lens();
    zoomless.configurations.clear();
    EXPECT_THAT(error_of([&] { configured(zoomless, "tele"); }).expected,
                testing::HasSubstr("no configurations"));
}

TEST(Prescription, AirCoatingGoesWhereExactlyOneSideIsAir) {
    Prescription lens = small_lens();
    lens.surfaces[4].coating = QuarterWave{};  // cemented: to be removed
    const Prescription coated = with_air_coating(lens, QuarterWave{.center_nm = 500.0});
    const bool expected[] = {true, true, false, true, false, true};
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        EXPECT_EQ(coated.surfaces[row].coating,
                  expected[row] ? Coating(QuarterWave{.center_nm = 500.0}) : Coating(Uncoated{}))
            << row;
}

TEST(Prescription, SoundLensIsAccepted) {
    EXPECT_NO_THROW(validate(small_lens()));
    Prescription lens = small_lens();
    lens.surfaces[0].semi_diameter_mm = 60.0;  // beyond the sphere: odd, but not refused
    lens.surfaces[0].curve = Radius{1e9};
    lens.surfaces[3].thickness_mm = 0.0;
    lens.stop.surface = 5;
    lens.stop.f_number = 2.0;
    lens.stop.semi_diameter_mm = 1e-4;
    lens.stop.blades = 3;
    EXPECT_NO_THROW(validate(lens));
}

struct Refusal {
    const char* where;
    std::function<void(Prescription&)> spoil;
};

TEST(Prescription, EachFaultIsNamedByItsField) {
    const Medium absorbing_nothing{"", ConstantIndex{1.5}};
    const std::vector<Refusal> refusals = {
        {"surfaces", [](auto& lens) { lens.surfaces.clear(); }},
        {"surfaces", [](auto& lens) { lens.surfaces.resize(1001, lens.surfaces[1]); }},
        {"surfaces[1].radius_mm", [](auto& lens) { lens.surfaces[0].curve = Radius{0.0}; }},
        {"surfaces[1].radius_mm",
         [](auto& lens) { lens.surfaces[0].curve = Radius{not_a_number}; }},
        {"surfaces[2].radius_mm", [](auto& lens) { lens.surfaces[1].curve = Radius{infinite}; }},
        {"surfaces[5].curvature_per_mm",
         [](auto& lens) { lens.surfaces[4].curve = Curvature{not_a_number}; }},
        {"surfaces[3].conic", [](auto& lens) { lens.surfaces[2].conic = infinite; }},
        {"surfaces[3].aspheric", [](auto& lens) { lens.surfaces[2].aspheric = {not_a_number}; }},
        {"surfaces[3].aspheric", [](auto& lens) { lens.surfaces[2].aspheric.resize(21); }},
        {"surfaces[2].thickness_mm", [](auto& lens) { lens.surfaces[1].thickness_mm = -1.0; }},
        {"surfaces[2].thickness_mm", [](auto& lens) { lens.surfaces[1].thickness_mm = 1e7; }},
        {"surfaces[2].thickness_mm",
         [](auto& lens) { lens.surfaces[1].thickness_mm = not_a_number; }},
        {"surfaces[6].semi_diameter_mm",
         [](auto& lens) { lens.surfaces[5].semi_diameter_mm = 0.0; }},
        {"surfaces[6].semi_diameter_mm",
         [](auto& lens) { lens.surfaces[5].semi_diameter_mm = not_a_number; }},
        {"surfaces[1].model.nd",
         [](auto& lens) {
             lens.surfaces[0].medium_after.dispersion = ModelGlass{0.9, 60.0};
         }},
        {"surfaces[1].model.vd",
         [](auto& lens) {
             lens.surfaces[0].medium_after.dispersion = ModelGlass{1.5, 0.0};
         }},
        {"surfaces[1].index",
         [](auto& lens) { lens.surfaces[0].medium_after.dispersion = ConstantIndex{11.0}; }},
        {"surfaces[1].formula.number",
         [](auto& lens) {
             lens.surfaces[0].medium_after.dispersion =
                 FormulaGlass{.formula = 10, .coefficients = {1.0}};
         }},
        {"surfaces[1].formula.coefficients",
         [](auto& lens) { lens.surfaces[0].medium_after.dispersion = FormulaGlass{}; }},
        {"surfaces[1].formula.coefficients",
         [](auto& lens) {
             lens.surfaces[0].medium_after.dispersion =
                 FormulaGlass{.coefficients = {not_a_number}};
         }},
        {"surfaces[1].coating.quarter_wave.center_nm",
         [](auto& lens) { lens.surfaces[0].coating = QuarterWave{.center_nm = 0.0}; }},
        {"surfaces[1].coating.quarter_wave.thickness_factor",
         [](auto& lens) { lens.surfaces[0].coating = QuarterWave{.thickness_factor = -1.0}; }},
        {"surfaces[1].coating.quarter_wave.layer.index",
         [](auto& lens) {
             lens.surfaces[0].coating = QuarterWave{.layer = Medium{"", ConstantIndex{0.0}}};
         }},
        {"surfaces[1].coating.layers[2].thickness_nm",
         [&](auto& lens) {
             lens.surfaces[0].coating =
                 LayerStack{{{absorbing_nothing, 100.0, 0.0}, {absorbing_nothing, -100.0, 0.0}}};
         }},
        {"surfaces[1].coating.layers[1].k",
         [&](auto& lens) {
             lens.surfaces[0].coating = LayerStack{{{absorbing_nothing, 100.0, -0.1}}};
         }},
        {"stop.surface", [](auto& lens) { lens.stop.surface = 6; }},
        {"stop.f_number", [](auto& lens) { lens.stop.f_number = 0.0; }},
        {"stop.f_number", [](auto& lens) { lens.stop.f_number = not_a_number; }},
        {"stop.semi_diameter_mm", [](auto& lens) { lens.stop.semi_diameter_mm = -2.0; }},
        {"stop.blades", [](auto& lens) { lens.stop.blades = 1; }},
        {"stop.blades", [](auto& lens) { lens.stop.blades = 2; }},
        {"stop.blades", [](auto& lens) { lens.stop.blades = -5; }},
        {"stop.rotation_deg", [](auto& lens) { lens.stop.rotation_deg = infinite; }},
        {"stop.blade_curvature", [](auto& lens) { lens.stop.blade_curvature = 1.1; }},
        {"stop.blade_curvature", [](auto& lens) { lens.stop.blade_curvature = -0.1; }},
        {"sensor.width_mm", [](auto& lens) { lens.sensor.width_mm = 0.0; }},
        {"sensor.height_mm", [](auto& lens) { lens.sensor.height_mm = not_a_number; }},
        {"configurations[1].name", [](auto& lens) { lens.configurations[0].name.clear(); }},
        {"configurations[2].name", [](auto& lens) { lens.configurations[1].name = "near"; }},
        {"configurations[2].thickness_mm",
         [](auto& lens) { lens.configurations[1].thickness_mm[6] = 1.0; }},
        {"configurations[2].thickness_mm.1",
         [](auto& lens) { lens.configurations[1].thickness_mm[0] = -1.0; }},
        {"configurations[1].f_number", [](auto& lens) { lens.configurations[0].f_number = -1; }},
        {"configurations[1].stop_semi_diameter_mm",
         [](auto& lens) { lens.configurations[0].stop_semi_diameter_mm = 0.0; }},
    };
    for (const Refusal& refusal : refusals) {
        SCOPED_TRACE(refusal.where);
        Prescription lens = small_lens();
        refusal.spoil(lens);
        const Error::Parts error = error_of([&] { validate(lens); });
        EXPECT_EQ(error.where, refusal.where);
        EXPECT_FALSE(error.found.empty());
        EXPECT_FALSE(error.expected.empty());
    }
}

}  // namespace
}  // namespace ghostlight
