#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/io/lens_file.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

TEST(BundledLenses, AreListedByName) {
    const auto lenses = bundled_lenses();
    EXPECT_GE(lenses.size(), 10u);
    EXPECT_TRUE(std::ranges::is_sorted(lenses, {}, &BundledLens::name));
}

TEST(BundledLenses, AreAsTheWriterWritesThem) {
    for (const BundledLens& bundled : bundled_lenses()) {
        SCOPED_TRACE(bundled.file.string());
        std::ostringstream text;
        text << std::ifstream(bundled.file).rdbuf();
        const LensFile file = read_lens(bundled.file);
        EXPECT_EQ(lens_to_json(file.lens), text.str());
        EXPECT_EQ(lens_from_json(lens_to_json(file.lens), "again").lens, file.lens);
    }
}

TEST(BundledLenses, SayWhereTheyComeFrom) {
    for (const BundledLens& bundled : bundled_lenses()) {
        const LensFile file = read_lens(bundled.file);
        EXPECT_FALSE(file.lens.name.empty()) << bundled.file;
        EXPECT_FALSE(file.lens.source.empty()) << bundled.file;
        EXPECT_THAT(file.lens.notes, testing::HasSubstr("coatings are this collection's choice"));
        for (const Note& note : file.notes)
            ADD_FAILURE() << bundled.file << ": " << note.where << ": " << note.text;
    }
}

TEST(BundledLenses, AreCoatedWhereGlassMeetsAir) {
    for (const BundledLens& bundled : bundled_lenses()) {
        const Prescription lens = read_lens(bundled.file).lens;
        EXPECT_EQ(with_air_coating(lens, QuarterWave{}), lens) << bundled.file;
    }
}

TEST(BundledLenses, CompileInEveryConfigurationAcrossTheVisible) {
    for (const BundledLens& bundled : bundled_lenses()) {
        const Prescription lens = read_lens(bundled.file).lens;
        std::vector<std::string> names = {""};
        for (const Configuration& each : lens.configurations) names.push_back(each.name);
        for (const std::string& name : names)
            for (const double nm : {400.0, d_line_nm, 700.0})
                EXPECT_NO_THROW(compile(lens, nm, name)) << bundled.file << " " << name;
    }
}

TEST(BundledLenses, SomeAreAspheric) {
    int aspheric = 0, conic = 0;
    for (const BundledLens& bundled : bundled_lenses()) {
        const Prescription lens = read_lens(bundled.file).lens;
        aspheric += std::ranges::any_of(
            lens.surfaces, [](const Surface& surface) { return !surface.aspheric.empty(); });
        conic += std::ranges::any_of(lens.surfaces,
                                     [](const Surface& surface) { return surface.conic != 0.0; });
    }
    EXPECT_GE(aspheric, 2);
    EXPECT_GE(conic, 1);
}

/// What a lens's source publishes, what its listing computes to, and how far the two may be apart.
/// Where the listing deviates, lenses/SOURCES.md says so, and its own value is held instead.
struct Expectation {
    const char* file;
    const char* configuration;
    double efl_mm;
    double efl_tolerance;  ///< relative
    double f_number;
    double f_tolerance;  ///< relative
    double defocus_mm;   ///< sensor − paraxial focus
};

// Radii and indices of three or four digits hold an EFL to a few 1e-3. The f-number follows from
// the listed stop radius, of two or three digits, which is often a little more than is stated.
const Expectation expectations[] = {
    {"tessar_brendel_100_f2.8", "", 100.0, 1e-3, 2.8, 0.03, 0.022},
    // indices with 3 decimals: 0.7 % long
    {"double_gauss_tronnier_100_f2", "", 100.0, 8e-3, 2.0, 0.02, 0.016},
    {"heliar_tronnier_100", "", 100.0, 8e-3, 3.430, 1e-3, 1.542},  // no published f-number
    {"cooke_triplet_50_f5", "", 50.0, 1e-3, 5.0, 0.03, -0.229},
    {"angenieux_1953_100_f1.1", "", 100.0, 1e-3, 1.1, 0.04, -0.235},
    // Published 10.5 mm, f/2.8; the listing computes to 9.90 and its stop is an estimate.
    {"fisheye_nikkor_10.5_f2.8", "", 9.900, 1e-3, 1.749, 1e-3, 1.068},
    // Published f/2.8; the listed stop radius gives f/2.40 wide open.
    {"canon_zoom_70_200_f2.8", "wide", 72.10, 1e-3, 2.403, 1e-3, 2.054},
    {"canon_zoom_70_200_f2.8", "middle", 135.00, 1e-3, 2.403, 1e-3, 2.071},
    {"canon_zoom_70_200_f2.8", "tele", 194.01, 1e-3, 2.403, 1e-3, 2.079},
    // At the listing's own scale: 80 and 200 mm over the common factor 1.398.
    {"nikon_zoom_80_200_f2.8", "short", 57.206, 1e-4, 2.8, 0.05, 0.0},
    {"nikon_zoom_80_200_f2.8", "long", 143.076, 1e-4, 2.8, 0.05, 0.0},
    // Stop set to the stated f-number; no EFL is published with the listing.
    {"nikkor_z_58_f0.95_noct", "", 59.62, 1e-4, 0.98, 1e-9, 0.0075},
    {"nikkor_z_14_30_f4_wide", "", 14.42, 1e-4, 4.0, 0.01, 0.0006},
};

TEST(BundledLenses, HoldWhatIsPublished) {
    for (const Expectation& expected : expectations) {
        SCOPED_TRACE(std::string(expected.file) + " " + expected.configuration);
        const Prescription lens =
            read_lens(data_directory() / (std::string(expected.file) + ".json")).lens;
        const FirstOrder found = first_order(compile(lens, d_line_nm, expected.configuration));
        EXPECT_NEAR(found.efl_mm / expected.efl_mm, 1.0, expected.efl_tolerance);
        EXPECT_NEAR(found.f_number / expected.f_number, 1.0, expected.f_tolerance);
        EXPECT_NEAR(found.paraxial_defocus_mm, expected.defocus_mm, 1e-3);
    }
}

TEST(BundledLenses, TheNoctsFieldFillsItsFormat) {
    const Prescription lens = read_lens(data_directory() / "nikkor_z_58_f0.95_noct.json").lens;
    const double efl_mm = first_order(compile(lens, d_line_nm)).efl_mm;
    // Half the diagonal of 36 × 24 mm; a normal lens distorts by about 1 %.
    const double image_mm = efl_mm * std::tan(rad_from_deg(*lens.published.half_field_deg));
    EXPECT_NEAR(image_mm / std::hypot(18.0, 12.0), 1.0, 0.01);
}

TEST(BundledLenses, TheZoomsEndsAreTheListings) {
    const Prescription listed =
        read_lens(test_data_folder() / "listings/canon_zoom_70_200_f2.8_tele.json").lens;
    const Prescription tele =
        configured(read_lens(data_directory() / "canon_zoom_70_200_f2.8.json").lens, "tele");
    ASSERT_EQ(tele.surfaces.size(), listed.surfaces.size());
    for (std::size_t row = 0; row < tele.surfaces.size(); ++row) {
        EXPECT_EQ(tele.surfaces[row].curve, listed.surfaces[row].curve) << row;
        EXPECT_EQ(tele.surfaces[row].thickness_mm, listed.surfaces[row].thickness_mm) << row;
        EXPECT_EQ(tele.surfaces[row].medium_after, listed.surfaces[row].medium_after) << row;
        EXPECT_EQ(tele.surfaces[row].semi_diameter_mm, listed.surfaces[row].semi_diameter_mm);
    }
}

}  // namespace
}  // namespace ghostlight
