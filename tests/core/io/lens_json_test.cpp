#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/io/lens_file.h"
#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

constexpr const char* small_lens = R"({
  "ghostlight_lens": 1,
  "name": "small",
  "stop": {"surface": 2},
  "sensor": {"distance_mm": 40},
  "surfaces": [
    {"radius_mm": 50, "thickness_mm": 5, "model": {"nd": 1.5, "vd": 60}, "semi_diameter_mm": 10},
    {"thickness_mm": 3, "semi_diameter_mm": 8},
    {"radius_mm": -50, "semi_diameter_mm": 10}
  ],
  "configurations": [{"name": "near", "thickness_mm": {"3": 45}}]
})";

std::string with(std::string_view from, std::string_view to) {
    std::string text = small_lens;
    const auto at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
}

Prescription read(const std::string& text) { return lens_from_json(text, "test.json").lens; }

/// A lens that uses everything the schema has.
Prescription rich_lens() {
    Prescription lens = read(small_lens);
    lens.source = "a patent\nwith \"quotes\", a tab\t and Ångström";
    lens.notes = "notes";
    lens.published.efl_mm = 50.0;
    lens.published.half_field_deg = 20.5;
    lens.surfaces[0].conic = -1.25;
    lens.surfaces[0].aspheric = {1e-5, 0.0, -3.25e-9, 0.0};
    lens.surfaces[0].curve = Curvature{0.1};
    lens.surfaces[0].comment = "front";
    lens.surfaces[0].coating = QuarterWave{.center_nm = 520.0, .thickness_factor = 0.95};
    lens.surfaces[1].medium_after = *bundled_glasses().find("N-SF11");
    lens.surfaces[1].coating = QuarterWave{.center_nm = 550.0, .layer = IdealIndex{}};
    lens.surfaces[2].coating = LayerStack{{{magnesium_fluoride(), 96.4, 0.0},
                                           {Medium{"", ConstantIndex{0.05}}, 10.0, 4.2},
                                           {Medium{}, 100.0, 0.0},
                                           {Medium{"mine", ModelGlass{2.1, 20.0}}, 1e-3, 0.0}}};
    lens.surfaces.push_back(lens.surfaces[2]);
    lens.surfaces[2].medium_after = Medium{
        "melt 7",
        FormulaGlass{
            .formula = 2, .coefficients = {0.0, 1.04, 0.006}, .min_nm = 310.0, .max_nm = 2325.5}};
    lens.surfaces[3].coating = QuarterWave{.layer = Medium{"", ConstantIndex{1.38}}};
    lens.surfaces[3].thickness_mm = 1.0 / 3.0;
    lens.stop.f_number = 2.8;
    lens.stop.semi_diameter_mm = 7.5;
    lens.stop.blades = 7;
    lens.stop.rotation_deg = 12.5;
    lens.stop.blade_curvature = 0.25;
    lens.sensor = {.width_mm = 23.6,
                   .height_mm = 15.7,
                   .at_paraxial_focus = false,
                   .reflectance = {},
                   .unknown = {}};
    lens.configurations[0].f_number = 4.0;
    lens.configurations[0].stop_semi_diameter_mm = 7.5;
    lens.configurations[0].published.efl_mm = 51.0;
    return lens;
}

TEST(LensJson, ReadsAsWritten) {
    const Prescription lens = rich_lens();
    const std::string text = lens_to_json(lens);
    const Prescription again = read(text);
    EXPECT_EQ(again, lens) << text;
    EXPECT_EQ(lens_to_json(again), text);
}

TEST(LensJson, SensorAtTheFocusKeepsTheLastThickness) {
    Prescription lens = rich_lens();
    lens.sensor.at_paraxial_focus = true;
    const std::string text = lens_to_json(lens);
    EXPECT_THAT(text, testing::HasSubstr("\"distance_mm\": \"paraxial focus\""));
    EXPECT_EQ(read(text), lens);
    lens.surfaces.back().thickness_mm = 0.0;
    EXPECT_EQ(read(lens_to_json(lens)), lens);
}

TEST(LensJson, OneSurfaceALineAndPlainNumbers) {
    const std::string text = lens_to_json(read(small_lens));
    EXPECT_EQ(text,
              "{\n"
              "  \"ghostlight_lens\": 1,\n"
              "  \"name\": \"small\",\n"
              "  \"stop\": {\"surface\": 2, \"blades\": 0},\n"
              "  \"sensor\": {\"width_mm\": 36, \"height_mm\": 24, \"distance_mm\": 40},\n"
              "  \"surfaces\": [\n"
              "    {\"radius_mm\": 50, \"thickness_mm\": 5, \"model\": {\"nd\": 1.5, \"vd\": 60}, "
              "\"semi_diameter_mm\": 10},\n"
              "    {\"thickness_mm\": 3, \"semi_diameter_mm\": 8},\n"
              "    {\"radius_mm\": -50, \"semi_diameter_mm\": 10}\n"
              "  ],\n"
              "  \"configurations\": [\n"
              "    {\"name\": \"near\", \"thickness_mm\": {\"3\": 45}}\n"
              "  ]\n"
              "}\n");
}

TEST(LensJson, NumbersReadBackExactly) {
    Prescription lens = read(small_lens);
    for (const double value :
         {0.1, 1.0 / 3.0, 1e-300, 123456.789, 1e5, 2.0 / 3e7, 5e-324, std::nextafter(1.0, 2.0)}) {
        lens.surfaces[0].conic = -value;
        lens.surfaces[1].thickness_mm = value;
        EXPECT_EQ(read(lens_to_json(lens)), lens) << value;
    }
}

TEST(LensJson, UnknownFieldsAreKeptAtEveryLevel) {
    const std::string text = R"({
  "ghostlight_lens": 1,
  "name": "x",
  "published": {"efl_mm": 50, "designer": "N. N."},
  "stop": {"surface": 1, "blades": 0, "maker": [1, 2, {"deep": null}]},
  "sensor": {"width_mm": 36, "height_mm": 24, "distance_mm": 40, "pixels": 6000},
  "surfaces": [
    {"radius_mm": 50, "thickness_mm": 5, "model": {"nd": 1.5, "vd": 60, "melt": 3}, "semi_diameter_mm": 10, "coating": {"quarter_wave": {"center_nm": 550, "layer": {"glass": "MgF2", "porosity": 0.1}, "bath": "A"}, "date": "1953"}, "tilt_deg": 0.5},
    {"radius_mm": -50, "semi_diameter_mm": 10, "coating": {"layers": [{"index": 1.38, "thickness_nm": 96.4, "a/b~c": true}]}}
  ],
  "configurations": [
    {"name": "near", "distance_m": 1.5}
  ],
  "zz_extra": {"é": [true, false, 1.5e-7]}
}
)";
    const Prescription lens = read(text);
    EXPECT_EQ(lens.unknown.at("zz_extra"), "{\"é\": [true, false, 1.5e-07]}");
    EXPECT_EQ(lens.published.unknown.at("designer"), "\"N. N.\"");
    EXPECT_EQ(lens.surfaces[0].unknown.size(), 5u);
    const std::string written = lens_to_json(lens);
    EXPECT_EQ(read(written), lens) << written;
    EXPECT_EQ(lens_to_json(read(written)), written);
    for (const char* kept :
         {"\"designer\": \"N. N.\"", "\"maker\": [1, 2, {\"deep\": null}]", "\"pixels\": 6000",
          "\"vd\": 60, \"melt\": 3", "\"layer\": {\"glass\": \"MgF2\", \"porosity\": 0.1}",
          "\"bath\": \"A\"", "\"date\": \"1953\"", "\"tilt_deg\": 0.5", "\"a/b~c\": true",
          "\"distance_m\": 1.5", "\"zz_extra\": {\"é\": [true, false, 1.5e-07]}"})
        EXPECT_THAT(written, testing::HasSubstr(kept));
}

TEST(LensJson, AnUnknownFieldOfASurfaceIsNoted) {
    const LensFile file =
        lens_from_json(with("\"radius_mm\": 50", "\"radius_mm\": 50, \"coatng\": 1"), "t.json");
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(file.notes[0].where, "surfaces[1]");
    EXPECT_THAT(file.notes[0].text, testing::HasSubstr("coatng"));
}

TEST(LensJson, FieldsWhoseObjectIsGoneAreDropped) {
    Prescription lens = read(with("\"nd\": 1.5,", "\"nd\": 1.5, \"melt\": 3,"));
    EXPECT_EQ(lens.surfaces[0].unknown.size(), 1u);
    lens.surfaces[0].medium_after = {};
    EXPECT_THAT(lens_to_json(lens), testing::Not(testing::HasSubstr("melt")));
}

TEST(LensJson, MediaAndCoatingsInAllTheirForms) {
    const auto first = [](const std::string& fields) {
        return read(with("\"model\": {\"nd\": 1.5, \"vd\": 60}", fields)).surfaces[0];
    };
    EXPECT_EQ(first(R"("glass": "n-bk7")").medium_after, *bundled_glasses().find("N-BK7"));
    EXPECT_EQ(first(R"("glass": "air")").medium_after, Medium{});
    EXPECT_EQ(first(R"("index": 1.7)").medium_after, (Medium{"", ConstantIndex{1.7}}));
    EXPECT_EQ(first(R"("glass": "N-BK7", "index": 1.5)").medium_after,
              (Medium{"N-BK7", ConstantIndex{1.5}}));
    EXPECT_EQ(first(R"("formula": {"number": 5, "coefficients": [1.5]})").medium_after,
              (Medium{"", FormulaGlass{.formula = 5, .coefficients = {1.5}}}));
    EXPECT_EQ(first(R"("coating": "none")").coating, Coating(Uncoated{}));
    EXPECT_EQ(first(R"("coating": null)").coating, Coating(Uncoated{}));
    EXPECT_EQ(first(R"("coating": {"quarter_wave": {}})").coating, Coating(QuarterWave{}));
    EXPECT_EQ(first(R"("coating": {"quarter_wave": {"layer": "IDEAL"}})").coating,
              Coating(QuarterWave{.layer = IdealIndex{}}));
    EXPECT_EQ(first(R"("coating": {"quarter_wave": {"layer": 1.45}})").coating,
              Coating(QuarterWave{.layer = Medium{"", ConstantIndex{1.45}}}));
    EXPECT_EQ(first(R"("coating": {"layers": []})").coating, Coating(LayerStack{}));
    EXPECT_EQ(first(R"("aspheric": {"A8": 2e-9, "A4": 1e-5})").aspheric,
              (std::vector<double>{1e-5, 0.0, 2e-9}));
    EXPECT_EQ(first(R"("aspheric_mm": [1e-5, 2e-9])").aspheric, (std::vector<double>{1e-5, 2e-9}));
}

TEST(LensJson, ByteOrderMarkIsSkipped) {
    EXPECT_EQ(read(std::string("\xEF\xBB\xBF") + small_lens), read(small_lens));
}

TEST(LensJson, TheSemiDiameterBeyondTheEdgeIsNoted) {
    const LensFile file =
        lens_from_json(with("\"semi_diameter_mm\": 10}", "\"semi_diameter_mm\": 60}"), "test.json");
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(file.notes[0].severity, Note::Severity::warning);
    EXPECT_EQ(file.notes[0].where, "surfaces[1]");
}

struct Fault {
    const char* from;
    const char* to;
    const char* where;     ///< the field that the error names
    const char* found;     ///< what it says was there
    const char* expected;  ///< part of what it says should be
};

class LensJsonFaults : public testing::TestWithParam<Fault> {};

TEST_P(LensJsonFaults, AreNamed) {
    const Fault& fault = GetParam();
    const Error::Parts error = error_of([&] { read(with(fault.from, fault.to)); });
    EXPECT_EQ(error.file, "test.json");
    EXPECT_EQ(error.where, fault.where);
    EXPECT_THAT(error.found, testing::HasSubstr(fault.found));
    EXPECT_THAT(error.expected, testing::HasSubstr(fault.expected));
    EXPECT_FALSE(error.problem.empty());
}

const Fault faults[] = {
    // the whole
    {"\"ghostlight_lens\": 1", "\"ghostlight_lens\": 2", "ghostlight_lens", "2", "version 1"},
    {"\"ghostlight_lens\": 1", "\"ghostlight_lens\": 0", "ghostlight_lens", "0", "1"},
    {"\"ghostlight_lens\": 1", "\"ghostlight_lens\": \"1\"", "ghostlight_lens", "\"1\"", "number"},
    {"\"name\": \"small\"", "\"name\": 3", "name", "3", "text"},
    {"\"name\": \"small\"", "\"source\": []", "source", "[]", "text"},
    {"\"name\": \"small\"", "\"published\": 3", "published", "3", "object"},
    {"\"name\": \"small\"", "\"published\": {\"efl_mm\": \"50\"}", "published.efl_mm", "\"50\"",
     "number"},
    // surfaces
    {"\"surfaces\":", "\"surface_list\":", "surfaces", "nothing", "at least one surface"},
    {"\"surfaces\": [", "\"surfaces\": 3, \"rest\": [", "surfaces", "3", "array"},
    {"\"surfaces\": [", "\"surfaces\": [], \"rest\": [", "surfaces", "[]", "at least one"},
    {"\"surfaces\": [", "\"surfaces\": [7,", "surfaces[1]", "7", "a surface"},
    {"\"radius_mm\": 50", "\"radius_mm\": \"50\"", "surfaces[1].radius_mm", "\"50\"", "radius"},
    {"\"radius_mm\": 50", "\"radius_mm\": 0", "surfaces[1].radius_mm", "0", "plane"},
    {"\"radius_mm\": 50", "\"radius_mm\": 50, \"curvature_per_mm\": 0.02",
     "surfaces[1].curvature_per_mm", "0.02", "neither"},
    {"\"radius_mm\": 50", "\"curvature_per_mm\": true", "surfaces[1].curvature_per_mm", "true",
     "1/mm"},
    {"\"radius_mm\": 50", "\"conic\": \"k\"", "surfaces[1].conic", "\"k\"", "number"},
    {"\"radius_mm\": 50", "\"aspheric\": [1]", "surfaces[1].aspheric", "[1]", "A4"},
    {"\"radius_mm\": 50", "\"aspheric\": {\"A5\": 1}", "surfaces[1].aspheric", "A5", "even powers"},
    {"\"radius_mm\": 50", "\"aspheric\": {\"A44\": 1}", "surfaces[1].aspheric", "A44", "A42"},
    {"\"radius_mm\": 50", "\"aspheric\": {\"A4\": null}", "surfaces[1].aspheric.A4", "null",
     "number"},
    {"\"radius_mm\": 50", "\"aspheric_mm\": [1, \"2\"]", "surfaces[1].aspheric_mm[2]", "\"2\"",
     "number"},
    {"\"radius_mm\": 50", "\"aspheric_mm\": 1", "surfaces[1].aspheric_mm", "1", "array"},
    {"\"radius_mm\": 50", "\"aspheric_mm\": [1], \"aspheric\": {\"A4\": 1}",
     "surfaces[1].aspheric_mm", "[1]", "aspheric or"},
    {"\"thickness_mm\": 5, ", "", "surfaces[1].thickness_mm", "nothing", "next surface"},
    {"\"thickness_mm\": 5", "\"thickness_mm\": null", "surfaces[1].thickness_mm", "null", "mm"},
    {"\"thickness_mm\": 5", "\"thickness_mm\": -5", "surfaces[1].thickness_mm", "-5", "mirrors"},
    {", \"semi_diameter_mm\": 8", "", "surfaces[2].semi_diameter_mm", "nothing", "clear radius"},
    {"\"semi_diameter_mm\": 8", "\"semi_diameter_mm\": 0", "surfaces[2].semi_diameter_mm", "0",
     "above 0"},
    {"\"semi_diameter_mm\": 8", "\"semi_diameter_mm\": 8, \"comment\": 1", "surfaces[2].comment",
     "1", "text"},
    // media
    {"\"model\": {", "\"index\": 1.5, \"model\": {", "surfaces[1]", "1.5", "one of them"},
    {"{\"nd\": 1.5, \"vd\": 60}", "1.5", "surfaces[1].model", "1.5", "nd"},
    {"\"nd\": 1.5, ", "", "surfaces[1].model.nd", "nothing", "index at d"},
    {"\"nd\": 1.5", "\"nd\": 0.5", "surfaces[1].model.nd", "0.5", "1 to 10"},
    {"\"vd\": 60", "\"vd\": null", "surfaces[1].model.vd", "null", "Abbe"},
    {"\"vd\": 60", "\"vd\": -60", "surfaces[1].model.vd", "-60", "above 0"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}", "\"index\": \"x\"", "surfaces[1].index", "\"x\"",
     "index"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}", "\"index\": 0.9", "surfaces[1].index", "0.9", "1 to"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}", "\"glass\": 7", "surfaces[1].glass", "7", "name"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}", "\"glass\": \"BK7\"", "surfaces[1].glass", "\"BK7\"",
     "catalogue"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}", "\"formula\": [1]", "surfaces[1].formula", "[1]",
     "coefficients"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}", "\"formula\": {\"coefficients\": [1]}",
     "surfaces[1].formula.number", "nothing", "1 to 9"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}", "\"formula\": {\"number\": 10, \"coefficients\": [1]}",
     "surfaces[1].formula.number", "10", "1 to 9"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}",
     "\"formula\": {\"number\": 2.5, \"coefficients\": [1]}", "surfaces[1].formula.number", "2.5",
     "1 to 9"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}", "\"formula\": {\"number\": 2}",
     "surfaces[1].formula.coefficients", "nothing", "array"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}",
     "\"formula\": {\"number\": 2, \"coefficients\": [1, 2]}", "surfaces[1].formula.coefficients",
     "[1, 2]", "odd number"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}",
     "\"formula\": {\"number\": 4, \"coefficients\": [1, 2, 3]}",
     "surfaces[1].formula.coefficients", "[1, 2, 3]", "1, 5, 9"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}",
     "\"formula\": {\"number\": 2, \"coefficients\": [1], \"range_nm\": [500]}",
     "surfaces[1].formula.range_nm", "[500]", "longest"},
    {"\"model\": {\"nd\": 1.5, \"vd\": 60}",
     "\"formula\": {\"number\": 2, \"coefficients\": [1], \"range_nm\": [500, 400]}",
     "surfaces[1].formula.range_nm", "[500, 400]", "longest"},
    // coatings
    {"\"radius_mm\": 50", "\"coating\": 3", "surfaces[1].coating", "3", "quarter_wave"},
    {"\"radius_mm\": 50", "\"coating\": \"MgF2\"", "surfaces[1].coating", "\"MgF2\"", "none"},
    {"\"radius_mm\": 50", "\"coating\": {\"magic\": 1}", "surfaces[1].coating", "magic", "layers"},
    {"\"radius_mm\": 50", "\"coating\": {\"quarter_wave\": {}, \"layers\": []}",
     "surfaces[1].coating", "layers", "or"},
    {"\"radius_mm\": 50", "\"coating\": {\"quarter_wave\": 550}",
     "surfaces[1].coating.quarter_wave", "550", "object"},
    {"\"radius_mm\": 50", "\"coating\": {\"quarter_wave\": {\"center_nm\": \"green\"}}",
     "surfaces[1].coating.quarter_wave.center_nm", "green", "nm"},
    {"\"radius_mm\": 50", "\"coating\": {\"quarter_wave\": {\"center_nm\": -1}}",
     "surfaces[1].coating.quarter_wave.center_nm", "-1", "above 0"},
    {"\"radius_mm\": 50", "\"coating\": {\"quarter_wave\": {\"layer\": \"cheese\"}}",
     "surfaces[1].coating.quarter_wave.layer", "cheese", "glass"},
    {"\"radius_mm\": 50", "\"coating\": {\"quarter_wave\": {\"layer\": [1]}}",
     "surfaces[1].coating.quarter_wave.layer", "[1]", "ideal"},
    {"\"radius_mm\": 50", "\"coating\": {\"quarter_wave\": {\"layer\": -1}}",
     "surfaces[1].coating.quarter_wave.layer.index", "-1", "above 0"},
    {"\"radius_mm\": 50", "\"coating\": {\"layers\": 3}", "surfaces[1].coating.layers", "3",
     "array"},
    {"\"radius_mm\": 50", "\"coating\": {\"layers\": [3]}", "surfaces[1].coating.layers[1]", "3",
     "layer"},
    {"\"radius_mm\": 50", "\"coating\": {\"layers\": [{\"thickness_nm\": 3}]}",
     "surfaces[1].coating.layers[1]", "thickness_nm", "glass"},
    {"\"radius_mm\": 50", "\"coating\": {\"layers\": [{\"index\": 1.4}]}",
     "surfaces[1].coating.layers[1].thickness_nm", "nothing", "nm"},
    {"\"radius_mm\": 50",
     "\"coating\": {\"layers\": [{\"index\": 1.4, \"thickness_nm\": 9, \"k\": -1}]}",
     "surfaces[1].coating.layers[1].k", "-1", "0 or more"},
    // stop
    {"\"stop\":", "\"halt\":", "stop", "nothing", "surface"},
    {"\"stop\": {\"surface\": 2}", "\"stop\": 2", "stop", "2", "object"},
    {"\"stop\": {\"surface\": 2}", "\"stop\": {}", "stop.surface", "nothing", "1 to 3"},
    {"\"stop\": {\"surface\": 2}", "\"stop\": {\"surface\": 0}", "stop.surface", "0", "1 to 3"},
    {"\"stop\": {\"surface\": 2}", "\"stop\": {\"surface\": 4}", "stop.surface", "4", "1 to 3"},
    {"\"stop\": {\"surface\": 2}", "\"stop\": {\"surface\": 1.5}", "stop.surface", "1.5", "1 to 3"},
    {"\"stop\": {\"surface\": 2}", "\"stop\": {\"surface\": \"2\"}", "stop.surface", "\"2\"",
     "1 to 3"},
    {"\"surface\": 2", "\"surface\": 2, \"f_number\": 0", "stop.f_number", "0", "above 0"},
    {"\"surface\": 2", "\"surface\": 2, \"f_number\": \"f/2\"", "stop.f_number", "f/2", "number"},
    {"\"surface\": 2", "\"surface\": 2, \"semi_diameter_mm\": -1", "stop.semi_diameter_mm", "-1",
     "above 0"},
    {"\"surface\": 2", "\"surface\": 2, \"blades\": 2", "stop.blades", "2", "3"},
    {"\"surface\": 2", "\"surface\": 2, \"blades\": 6.5", "stop.blades", "6.5", "3"},
    {"\"surface\": 2", "\"surface\": 2, \"rotation_deg\": {}", "stop.rotation_deg", "{}", "number"},
    {"\"surface\": 2", "\"surface\": 2, \"blade_curvature\": 2", "stop.blade_curvature", "2",
     "0 (straight edges) to 1"},
    // sensor
    {"\"sensor\":", "\"chip\":", "sensor", "nothing", "distance_mm"},
    {"\"sensor\": {\"distance_mm\": 40}", "\"sensor\": 40", "sensor", "40", "object"},
    {"\"distance_mm\": 40", "\"width_mm\": 40", "sensor.distance_mm", "nothing", "focus"},
    {"\"distance_mm\": 40", "\"distance_mm\": \"focus\"", "sensor.distance_mm", "\"focus\"",
     "paraxial focus"},
    {"\"distance_mm\": 40", "\"distance_mm\": []", "sensor.distance_mm", "[]", "mm"},
    {"\"distance_mm\": 40", "\"distance_mm\": -40", "sensor.distance_mm", "-40", "0 mm or more"},
    {"\"distance_mm\": 40", "\"distance_mm\": 40, \"width_mm\": 0", "sensor.width_mm", "0",
     "above 0"},
    {"\"distance_mm\": 40", "\"distance_mm\": 40, \"height_mm\": \"24\"", "sensor.height_mm",
     "\"24\"", "number"},
    {"\"radius_mm\": -50", "\"radius_mm\": -50, \"thickness_mm\": 41", "sensor.distance_mm", "40",
     "only one"},
    // configurations
    {"\"configurations\": [", "\"configurations\": 1, \"rest\": [", "configurations", "1", "array"},
    {"\"configurations\": [", "\"configurations\": [1,", "configurations[1]", "1", "configuration"},
    {"\"name\": \"near\", ", "", "configurations[1].name", "nothing", "text"},
    {"\"name\": \"near\"", "\"name\": \"\"", "configurations[1].name", "empty", "name"},
    {"\"thickness_mm\": {\"3\": 45}", "\"thickness_mm\": 45", "configurations[1].thickness_mm",
     "45", "row from 1 to 3"},
    {"\"thickness_mm\": {\"3\": 45}", "\"thickness_mm\": {\"4\": 45}",
     "configurations[1].thickness_mm", "4", "row from 1 to 3"},
    {"\"thickness_mm\": {\"3\": 45}", "\"thickness_mm\": {\"x\": 45}",
     "configurations[1].thickness_mm", "x", "row from 1 to 3"},
    {"\"thickness_mm\": {\"3\": 45}", "\"thickness_mm\": {\"3\": \"45\"}",
     "configurations[1].thickness_mm.3", "\"45\"", "mm"},
    {"\"thickness_mm\": {\"3\": 45}", "\"thickness_mm\": {\"3\": -45}",
     "configurations[1].thickness_mm.3", "-45", "0 to"},
    {"\"thickness_mm\": {\"3\": 45}", "\"f_number\": 0", "configurations[1].f_number", "0",
     "above 0"},
    {"{\"name\": \"near\",", "{\"name\": \"near\"}, {\"name\": \"near\",", "configurations[2].name",
     "near", "of its own"},
};

INSTANTIATE_TEST_SUITE_P(All, LensJsonFaults, testing::ValuesIn(faults));

TEST(LensJson, TextThatIsNotALensIsRefused) {
    EXPECT_EQ(error_of([] { read(""); }).problem, "the file is empty");
    EXPECT_EQ(error_of([] { read("[]"); }).found, "[]");
    EXPECT_THAT(error_of([] { read("{}"); }).problem, testing::HasSubstr("not a lens file"));
    const Error::Parts unfinished = error_of([] { read("{\n  \"name\": "); });
    EXPECT_THAT(unfinished.where, testing::HasSubstr("line 2"));
    EXPECT_THAT(unfinished.problem, testing::HasSubstr("not valid JSON"));
    EXPECT_THAT(error_of([] { read("{\"surfaces\": NaN}"); }).problem,
                testing::HasSubstr("not valid JSON"));
    EXPECT_THAT(error_of([] { read(with("\"name\"", "\"stop\"")); }).problem,
                testing::HasSubstr("\"stop\" twice"));
    EXPECT_THAT(error_of([] { read(std::string(100000, '[')); }).problem,
                testing::HasSubstr("nest too deeply"));
    EXPECT_THAT(error_of([] { read(std::string((16u << 20) + 1, ' ')); }).problem,
                testing::HasSubstr("too large"));
    std::string wide = "{\"a\": 0";
    for (int i = 0; i < 20000; ++i) wide += ", \"" + std::to_string(i) + "\": 0";
    EXPECT_THAT(error_of([&] { read(wide + "}"); }).problem, testing::HasSubstr("too many fields"));
}

}  // namespace
}  // namespace ghostlight
