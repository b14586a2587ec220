#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/io/lens_file.h"
#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

constexpr const char* singlet = R"({
 "name": "singlet", "units": "mm", "source": "made up", "notes": "none",
 "published": {"efl": 50.0, "f_number": 2.8, "bfd": 48, "half_field_deg": 20, "year": 1900},
 "computed": {"efl": 51},
 "stop_index": 1,
 "surfaces": [
  {"radius": 50, "thickness": 5, "nd": 1.5168, "vd": 64.17, "semi_diameter": 10},
  {"radius": null, "thickness": 3, "nd": 1.0, "vd": null, "semi_diameter": 8, "stop": true},
  {"radius": -50, "thickness": 40, "nd": 1, "vd": 0, "semi_diameter": 10}
 ]
})";

std::string with(std::string_view from, std::string_view to) {
    std::string text = singlet;
    const auto at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
}

LensFile read(const std::string& text) { return lens_from_json(text, "list.json"); }

TEST(LensListing, EveryFieldFindsItsPlace) {
    const LensFile file = read(singlet);
    const Prescription& lens = file.lens;
    EXPECT_EQ(lens.name, "singlet");
    EXPECT_EQ(lens.source, "made up");
    EXPECT_EQ(lens.notes, "none");
    EXPECT_EQ(lens.published.efl_mm, 50.0);
    EXPECT_EQ(lens.published.f_number, 2.8);
    EXPECT_EQ(lens.published.bfd_mm, 48.0);
    EXPECT_EQ(lens.published.half_field_deg, 20.0);
    EXPECT_EQ(lens.published.unknown.at("year"), "1900");
    EXPECT_EQ(lens.unknown.at("computed"), "{\"efl\": 51}");
    EXPECT_EQ(lens.stop.surface, 1u);
    EXPECT_EQ(lens.stop.blades, 0);
    EXPECT_FALSE(lens.stop.f_number);
    EXPECT_EQ(lens.sensor, Sensor{});
    ASSERT_EQ(lens.surfaces.size(), 3u);
    EXPECT_EQ(lens.surfaces[0].curve, BaseCurve(Radius{50.0}));
    EXPECT_EQ(lens.surfaces[0].medium_after, (Medium{"", ModelGlass{1.5168, 64.17}}));
    EXPECT_EQ(lens.surfaces[1].curve, BaseCurve(Plane{}));
    EXPECT_TRUE(is_air(lens.surfaces[1].medium_after));
    EXPECT_EQ(lens.surfaces[2].thickness_mm, 40.0);
    for (const Surface& surface : lens.surfaces) EXPECT_EQ(surface.coating, Coating(Uncoated{}));
    EXPECT_TRUE(file.notes.empty());
    EXPECT_EQ(lens_from_json(lens_to_json(lens), "again").lens, lens);
}

TEST(LensListing, StopByMarkOrByIndex) {
    EXPECT_EQ(read(with("\"stop_index\": 1,", "")).lens.stop.surface, 1u);
    EXPECT_EQ(read(with(", \"stop\": true", "")).lens.stop.surface, 1u);
    EXPECT_EQ(read(with("\"stop\": true", "\"stop\": false")).lens.stop.surface, 1u);
    // On a row that is nothing but the stop the radius may be left out.
    EXPECT_EQ(read(with("\"radius\": null, ", "")).lens.surfaces[1].curve, BaseCurve(Plane{}));
}

TEST(LensListing, CatalogueGlassByItsFormula) {
    const LensFile file = read(with("\"vd\": 64.17", "\"vd\": 64.17, \"glass\": \"N-BK7\""));
    EXPECT_EQ(file.lens.surfaces[0].medium_after, *bundled_glasses().find("N-BK7"));
    EXPECT_TRUE(file.notes.empty());
    const LensFile bare =
        read(with("\"nd\": 1.5168, \"vd\": 64.17", "\"glass\": \"N-BK7\", \"nd\": null"));
    EXPECT_EQ(bare.lens.surfaces[0].medium_after, *bundled_glasses().find("N-BK7"));
    const LensFile other = read(with("\"vd\": 64.17", "\"vd\": 64.17, \"glass\": \"N-SF11\""));
    ASSERT_EQ(other.notes.size(), 1u);
    EXPECT_THAT(other.notes[0].text, testing::HasSubstr("N-SF11"));
}

TEST(LensListing, UnknownGlassFallsBackToItsIndexWithAWarning) {
    const LensFile file = read(with("\"vd\": 64.17", "\"vd\": 64.17, \"glass\": \"BK7\""));
    EXPECT_EQ(file.lens.surfaces[0].medium_after, (Medium{"BK7", ModelGlass{1.5168, 64.17}}));
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(file.notes[0].severity, Note::Severity::warning);
    EXPECT_EQ(file.notes[0].where, "surfaces[1].glass");
    EXPECT_THAT(file.notes[0].text, testing::HasSubstr("N-BK7"));
}

TEST(LensListing, IndexWithoutAbbeNumberIsConstantWithANote) {
    for (const char* vd : {"\"vd\": null", "\"vd\": 0", "\"x\": 1"}) {
        const LensFile file = read(with("\"vd\": 64.17", vd));
        EXPECT_EQ(file.lens.surfaces[0].medium_after, (Medium{"", ConstantIndex{1.5168}}));
        EXPECT_FALSE(file.notes.empty());
    }
}

TEST(LensListing, ConicAsphereAndOwnFormula) {
    const LensFile file = read(with(
        "\"vd\": 64.17",
        "\"vd\": 64.17, \"conic\": -0.5, \"asph\": [1e-5, -2e-8], \"sellmeier\": {\"formula\": 2, "
        "\"coefficients\": [0.0, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144, "
        "1.01046945, 103.560653]}"));
    const Surface& surface = file.lens.surfaces[0];
    EXPECT_EQ(surface.conic, -0.5);
    EXPECT_EQ(surface.aspheric, (std::vector<double>{1e-5, -2e-8}));
    EXPECT_NEAR(refractive_index(surface.medium_after, d_line_nm), 1.5168, 1e-6);
    EXPECT_TRUE(file.notes.empty());
    EXPECT_EQ(lens_from_json(lens_to_json(file.lens), "again").lens, file.lens);
    EXPECT_TRUE(read(with("\"vd\": 64.17", "\"vd\": 64.17, \"asph\": null"))
                    .lens.surfaces[0]
                    .aspheric.empty());
}

TEST(LensListing, CoatingWhereTheFileNamesOne) {
    const LensFile file = read(with(
        "\"vd\": 64.17", "\"vd\": 64.17, \"coating\": {\"quarter_wave\": {\"center_nm\": 500}}"));
    EXPECT_EQ(file.lens.surfaces[0].coating, Coating(QuarterWave{.center_nm = 500.0}));
}

TEST(LensListing, OddThingsAreNoted) {
    EXPECT_EQ(read(with("\"units\": \"mm\", ", "")).notes.at(0).where, "units");
    EXPECT_EQ(read(with("\"units\": \"mm\"", "\"units\": \"Millimeters\"")).notes.size(), 0u);
    const LensFile spelled = read(with("\"vd\": 64.17", "\"vd\": 64.17, \"aspheric\": [1e-5]"));
    ASSERT_EQ(spelled.notes.size(), 1u);
    EXPECT_THAT(spelled.notes[0].text, testing::HasSubstr("aspheric"));
    const LensFile wide = read(with("\"semi_diameter\": 10}", "\"semi_diameter\": 51}"));
    ASSERT_EQ(wide.notes.size(), 1u);
    EXPECT_EQ(wide.notes[0].where, "surfaces[1]");
}

TEST(LensListing, ReadsTheListingsAsTheyStand) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test_data_folder() / "listings")) {
        SCOPED_TRACE(entry.path().string());
        const LensFile file = read_lens(entry.path());
        EXPECT_GT(file.lens.surfaces.size(), 5u);
        EXPECT_TRUE(file.lens.published.efl_mm);
        for (const Note& note : file.notes) ADD_FAILURE() << note.where << ": " << note.text;
        const std::string text = lens_to_json(file.lens);
        EXPECT_EQ(lens_from_json(text, "again").lens, file.lens);
        ++count;
    }
    EXPECT_EQ(count, 3);
}

struct Fault {
    const char* from;
    const char* to;
    const char* where;
    const char* found;
    const char* expected;
};

class LensListingFaults : public testing::TestWithParam<Fault> {};

TEST_P(LensListingFaults, AreNamed) {
    const Fault& fault = GetParam();
    const Error::Parts error = error_of([&] { read(with(fault.from, fault.to)); });
    EXPECT_EQ(error.file, "list.json");
    EXPECT_EQ(error.where, fault.where);
    EXPECT_THAT(error.found, testing::HasSubstr(fault.found));
    EXPECT_THAT(error.expected, testing::HasSubstr(fault.expected));
}

const Fault faults[] = {
    {"\"units\": \"mm\"", "\"units\": \"inch\"", "units", "inch", "mm"},
    {"\"units\": \"mm\"", "\"units\": 1", "units", "1", "mm"},
    {"\"name\": \"singlet\"", "\"name\": {}", "name", "{}", "text"},
    {"\"notes\": \"none\"", "\"notes\": 5", "notes", "5", "text"},
    {"\"efl\": 50.0", "\"efl\": \"50\"", "published.efl", "\"50\"", "number"},
    {"\"published\": {", "\"published\": 50, \"rest\": {", "published", "50", "object"},
    {"\"stop_index\": 1", "\"stop_index\": 3", "stop_index", "3", "0 to 2"},
    {"\"stop_index\": 1", "\"stop_index\": -1", "stop_index", "-1", "0 to 2"},
    {"\"stop_index\": 1", "\"stop_index\": 1.5", "stop_index", "1.5", "0 to 2"},
    {"\"stop_index\": 1", "\"stop_index\": \"1\"", "stop_index", "\"1\"", "0 to 2"},
    {"\"stop_index\": 1", "\"stop_index\": 0", "stop_index", "0", "1 (it counts from 0)"},
    {"\"stop\": true", "\"stop\": \"yes\"", "surfaces[2].stop", "yes", "true or false"},
    {"\"vd\": 0,", "\"vd\": 0, \"stop\": true,", "surfaces[3].stop", "true", "one aperture stop"},
    {"\"surfaces\": [", "\"surfaces\": {}, \"rest\": [", "surfaces", "{}", "array"},
    {"\"surfaces\": [", "\"surfaces\": [], \"rest\": [", "surfaces", "[]", "at least one"},
    {"\"surfaces\": [", "\"surfaces\": [null,", "surfaces[1]", "null", "a surface"},
    {"\"radius\": 50, ", "", "surfaces[1].radius", "nothing", "null for a plane"},
    {"\"radius\": 50", "\"radius\": 0", "surfaces[1].radius", "0", "other than 0"},
    {"\"radius\": 50", "\"radius\": \"50\"", "surfaces[1].radius", "\"50\"", "radius in mm"},
    {"\"radius\": 50", "\"radius\": \"inf\"", "surfaces[1].radius", "inf", "null for a plane"},
    {"\"thickness\": 5, ", "", "surfaces[1].thickness", "nothing", "next surface"},
    {"\"thickness\": 5", "\"thickness\": null", "surfaces[1].thickness", "null", "next surface"},
    {"\"thickness\": 5", "\"thickness\": -5", "surfaces[1].thickness", "-5", "0 to 1e6"},
    {"\"thickness\": 5", "\"thickness\": 1e9", "surfaces[1].thickness", "1000000000", "1e6"},
    {"\"nd\": 1.5168, ", "", "surfaces[1].nd", "nothing", "index at d"},
    {"\"nd\": 1.5168", "\"nd\": null", "surfaces[1].nd", "null", "index at d"},
    {"\"nd\": 1.5168", "\"nd\": 0.5", "surfaces[1].nd", "0.5", "from 1 to 10"},
    {"\"nd\": 1.5168", "\"nd\": \"1.5\"", "surfaces[1].nd", "\"1.5\"", "from 1 to 10"},
    {"\"vd\": 64.17", "\"vd\": -64", "surfaces[1].vd", "-64", "above 0"},
    {"\"vd\": 64.17", "\"vd\": \"64\"", "surfaces[1].vd", "\"64\"", "Abbe number"},
    {"\"semi_diameter\": 10}", "\"sd\": 10}", "surfaces[1].semi_diameter", "nothing", "clear"},
    {"\"semi_diameter\": 10}", "\"semi_diameter\": 0}", "surfaces[1].semi_diameter", "0", "above"},
    {"\"semi_diameter\": 10}", "\"semi_diameter\": [10]}", "surfaces[1].semi_diameter", "[10]",
     "clear"},
    {"\"vd\": 64.17", "\"glass\": 7", "surfaces[1].glass", "7", "text"},
    {"\"nd\": 1.5168, \"vd\": 64.17", "\"glass\": \"LAK9\"", "surfaces[1].glass", "LAK9",
     "catalogue"},
    {"\"vd\": 64.17", "\"glass\": \"air\"", "surfaces[1].nd", "1.5168", "1"},
    {"\"vd\": 64.17", "\"sellmeier\": 2", "surfaces[1].sellmeier", "2", "coefficients"},
    {"\"vd\": 64.17", "\"sellmeier\": {\"coefficients\": [1]}", "surfaces[1].sellmeier.formula",
     "nothing", "1 to 9"},
    {"\"vd\": 64.17", "\"sellmeier\": {\"formula\": 2, \"coefficients\": [0, 1]}",
     "surfaces[1].sellmeier.coefficients", "[0, 1]", "odd"},
    {"\"vd\": 64.17", "\"sellmeier\": {\"formula\": 2, \"coefficients\": [0, 1, \"x\"]}",
     "surfaces[1].sellmeier.coefficients[3]", "\"x\"", "number"},
    {"\"vd\": 64.17", "\"sellmeier\": {\"formula\": 2, \"coefficients\": [-5]}", "surfaces[1]",
     "sellmeier", "visible light"},
    {"\"vd\": 64.17",
     "\"sellmeier\": {\"formula\": 5, \"coefficients\": [1.5], \"wavelength_range_um\": [1]}",
     "surfaces[1].sellmeier.wavelength_range_um", "[1]", "µm"},
    {"\"vd\": 64.17", "\"conic\": \"k\"", "surfaces[1].conic", "\"k\"", "number"},
    {"\"vd\": 64.17", "\"asph\": 1e-5", "surfaces[1].asph", "1e-05", "[A4, A6"},
    {"\"vd\": 64.17", "\"asph\": [1e-5, null]", "surfaces[1].asph[2]", "null", "number"},
    {"\"vd\": 64.17", "\"asph\": [0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]", "surfaces[1].asph",
     "21 entries", "at most 20"},
    {"\"vd\": 64.17", "\"coating\": \"shiny\"", "surfaces[1].coating", "shiny", "none"},
};

INSTANTIATE_TEST_SUITE_P(All, LensListingFaults, testing::ValuesIn(faults));

TEST(LensListing, WithoutAStopItIsRefused) {
    std::string text = with("\"stop_index\": 1,", "");
    text.replace(text.find(", \"stop\": true"), 14, "");
    const Error::Parts error = error_of([&] { read(text); });
    EXPECT_THAT(error.problem, testing::HasSubstr("no aperture stop"));
    EXPECT_EQ(error.where, "surfaces");
}

}  // namespace
}  // namespace ghostlight
