#include "core/io/import_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/io/lens_file.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

Prescription lens_of(std::size_t surfaces) {
    Prescription lens;
    lens.surfaces.resize(surfaces);
    return lens;
}

std::optional<std::size_t> surface_named(std::string where, std::string text) {
    const Note note{Note::Severity::info, std::move(where), std::move(text)};
    return surface_of(note, {note}, lens_of(6));
}

TEST(ImportReport, ANoteNamesItsSurface) {
    EXPECT_EQ(surface_named("SURF 3 (line 47)", "asphere"), 2U);
    EXPECT_EQ(surface_named("surfaces[1].nd", "odd"), 0U);
    EXPECT_EQ(surface_named("lens_elements[6]", "odd"), 5U);
    EXPECT_EQ(surface_named("line 12", "surface 4: circular aperture"), 3U);
    EXPECT_EQ(surface_named("", "no semi-diameter for surface 2: sized"), 1U);
}

TEST(ImportReport, ANoteAboutNoOneSurfaceNamesNone) {
    EXPECT_EQ(surface_named("line 3", "wavelengths"), std::nullopt);
    EXPECT_EQ(surface_named("", "the semi-diameters of surfaces 2, 3 are sized"), std::nullopt);
    EXPECT_EQ(surface_named("", "5 surfaces between object and image"), std::nullopt);
    EXPECT_EQ(surface_named("SURF 0", "the object"), std::nullopt);
    EXPECT_EQ(surface_named("SURF 7", "the image"), std::nullopt) << "not one of six surfaces";
    EXPECT_EQ(surface_named("SURF 99999999999999999999999", "x"), std::nullopt);
}

TEST(ImportReport, ALineIsThatOfTheSurfaceOnIt) {
    const Note glass{Note::Severity::info, "line 11", "glass N-SK16 (SCHOTT)"};
    const Note surface{Note::Severity::info, "line 11", "surface 5: radius 22 mm"};
    const Note other{Note::Severity::info, "line 1", "surface 2: radius 3 mm"};
    EXPECT_EQ(surface_of(glass, {other, glass, surface}, lens_of(6)), 4U);
    EXPECT_EQ(surface_of(glass, {other, glass}, lens_of(6)), std::nullopt);
}

TEST(ImportReport, AnUnknownGlassIsFoundByItsName) {
    const LensFile file = read_lens(test_data_folder() / "zmx" / "unknown_glass.zmx");
    const auto note = std::ranges::find(file.notes, Note::Severity::error, &Note::severity);
    ASSERT_NE(note, file.notes.end());
    EXPECT_EQ(surface_of(*note, file.notes, file.lens), 2U) << "SF2X follows surface 3";
}

TEST(ImportReport, TextMarksWhatMattersAndWhatToMend) {
    const Notes notes = {{Note::Severity::info, "line 1", "units", Note::Fate::read},
                         {Note::Severity::warning, "", "sized", Note::Fate::assumed, true, "do it"},
                         {Note::Severity::error, "line 9", "glass", Note::Fate::noticed}};
    EXPECT_EQ(notes_text(notes),
              "  line 1: read: units\n"
              "* assumed: sized\n"
              "      -> do it\n"
              "! line 9: noticed: glass\n");
}

}  // namespace
}  // namespace ghostlight
