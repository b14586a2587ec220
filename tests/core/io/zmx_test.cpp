#include "core/io/zmx.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/io/read_text.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "tests/support/error_of.h"
#include "tests/support/import_kit.h"
#include "tests/support/optics_kit.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

constexpr double rounding_mm = 1e-9;  ///< mm: radii written as curvatures of 16 digits

LensFile read_text_as_zmx(const std::string& text) {
    return complete_import(import_zmx({text, "test.zmx"}), "test.zmx");
}

/// Header and object, rows as given, an image; "5" surfaces are what a test needs at most.
std::string zmx_of(const std::string& rows, const std::string& system = "ENPD 5\n") {
    return "MODE SEQ\nUNIT MM\n" + system + "SURF 0\n  TYPE STANDARD\n  DISZ INFINITY\n" + rows;
}
const std::string singlet =
    "SURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n  GLAS N-BK7 0 0 1.5 40\n  DIAM 6 1\n"
    "SURF 2\n  CURV -0.02\n  DISZ 48\n  DIAM 6 1\nSURF 3\n  CURV 0\n  DISZ 0\n";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const auto at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    return text.replace(at, what.size(), by);
}

TEST(Zmx, ReadsWhatIsThere) {
    const LensFile file = read_sample("zmx/triplet.zmx");
    const Prescription& lens = file.lens;
    ASSERT_EQ(lens.surfaces.size(), 7U);
    EXPECT_EQ(lens.name, "Triplet, written by hand");
    EXPECT_EQ(lens.notes, "First line of the notes\nsecond line");
    EXPECT_EQ(lens.surfaces[0].curve, BaseCurve(Curvature{4.542648063491688e-2}));
    EXPECT_EQ(lens.surfaces[0].medium_after.name, "N-SK16");
    EXPECT_EQ(lens.surfaces[5].medium_after, lens.surfaces[0].medium_after) << "a pick-up";
    EXPECT_EQ(lens.surfaces[2].conic, 0.1);
    EXPECT_EQ(lens.surfaces[2].aspheric, (std::vector<double>{-1e-6, 2e-9}));
    EXPECT_EQ(lens.surfaces[3].semi_diameter_mm, 4.9) << "CLAP is narrower than DIAM";
    EXPECT_EQ(lens.surfaces[4].comment, "the stop");
    EXPECT_EQ(lens.stop.surface, 4U);
    EXPECT_EQ(lens.stop.f_number, 5.0);
    EXPECT_EQ(lens.surfaces[6].thickness_mm, 42.20778);
    EXPECT_TRUE(lens.surfaces[6].semi_diameter_sized) << "DIAM … 0 is the program's own";
    EXPECT_FALSE(lens.surfaces[0].semi_diameter_sized);
    EXPECT_NEAR(0.5 * std::hypot(lens.sensor.width_mm, lens.sensor.height_mm), 18.2, rounding_mm);
    EXPECT_EQ(lens.published.half_field_deg, 20.0);
    // Every word that is not used is named.
    EXPECT_EQ(note_with(file.notes, "\"XYZW\"")->where, "line 90");
    EXPECT_EQ(note_with(file.notes, "\"XYZW\"")->fate, Note::Fate::left_out);
    EXPECT_NE(note_with(file.notes, "486.133, 587.562, 656.273 nm"), nullptr) << "3 of 5 waves";
}

/// By hand from the file's numbers: Gauss' step by step, with the indices of the makers.
TEST(Zmx, FocalLengthIsThatOfTheNumbers) {
    const Prescription lens = read_sample("zmx/triplet.zmx").lens;
    constexpr double sk16 = 1.62041, f2 = 1.62004;  // Schott's tables
    const BookFocus book = book_focus({{1.0 / 4.542648063491688e-2, 3.25896, sk16},
                                       {1.0 / -2.294838923737495e-3, 6.00755, 1.0},
                                       {1.0 / -4.501811347894594e-2, 0.99997, f2},
                                       {1.0 / 4.928069841193814e-2, 4.75041, 1.0},
                                       {1.0 / 1.254963379967271e-2, 2.95208, sk16},
                                       {1.0 / -5.436166794346983e-2, 0.0, 1.0}});
    constexpr double index_digits_mm = 2e-3;  // five decimals of three indices
    EXPECT_NEAR(first_order(compile(lens, d_line_nm)).efl_mm, book.efl_mm, index_digits_mm);
    EXPECT_NEAR(first_order(compile(lens, d_line_nm)).bfd_mm, book.bfd_mm, index_digits_mm);
}

TEST(Zmx, EncodingsAreTheSameLens) {
    const Prescription plain = read_sample("zmx/triplet.zmx").lens;
    Prescription utf16 = read_sample("zmx/triplet_utf16.zmx").lens;
    EXPECT_EQ(utf16.name, "Triplet, 日本語");
    utf16.name = plain.name;
    EXPECT_EQ(utf16, plain);
}

TEST(Zmx, VendorsFileWithoutTypes) {
    const LensFile file = read_sample("zmx/vendor_latin1.zmx");
    EXPECT_EQ(file.lens.name, "AB1234 Ø25 mm, f=60 mm, Bi-convex");
    EXPECT_EQ(file.lens.stop.surface, 0U);
    EXPECT_NEAR(file.lens.surfaces[1].thickness_mm, 0.2 * 25.4, rounding_mm);
    EXPECT_NEAR(curvature_per_mm(file.lens.surfaces[1].curve), 0.4 / 25.4, rounding_mm);
    EXPECT_EQ(file.lens.surfaces[1].medium_after.name, "N-BK7") << "NBK7, not the placeholder";
    EXPECT_NEAR(first_order(compile(file.lens, d_line_nm)).entrance_pupil_radius_mm, 0.25 * 25.4,
                rounding_mm);
    EXPECT_TRUE(note_with(file.notes, "rectangular opening")->matters_for_flare);
}

TEST(Zmx, ZoomPositionsFollowTheirSolve) {
    const LensFile file = read_sample("zmx/zoom.zmx");
    ASSERT_EQ(file.lens.configurations.size(), 3U);
    const Configuration& tele = file.lens.configurations[2];
    EXPECT_EQ(tele.name, "tele");
    EXPECT_EQ(tele.thickness_mm.at(1), 5.0);
    EXPECT_EQ(tele.thickness_mm.at(4), 63.0 - 5.0 - 20.0 - 3.0) << "TOLE: the sum of four is 63";
    EXPECT_TRUE(note_with(file.notes, "\"CRVT\" changes")->matters_for_flare);
    EXPECT_FALSE(note_with(file.notes, "\"YFIE\" changes")->matters_for_flare);
}

TEST(Zmx, OddThingsAreOpenedAndNamed) {
    const LensFile file = read_sample("zmx/tricky.zmx");
    const Surface& odd = file.lens.surfaces[0];
    // r³ and r⁴ as printed, against the even polynomial in their place.
    const auto printed = [](double r) {
        return r * r * 0.02 / (1.0 + std::sqrt(1.0 - 0.0004 * r * r)) + 1e-5 * r * r * r -
               1e-7 * r * r * r * r;
    };
    constexpr double fit_mm = 2e-6;  // the note states it in nm
    for (const double r : {0.0, 2.0, 5.0, 8.0}) EXPECT_NEAR(sag_mm(odd, r), printed(r), fit_mm);
    const Note* glass = note_with(file.notes, "MYSTERY1");
    EXPECT_EQ(glass->severity, Note::Severity::error);
    EXPECT_FALSE(glass->proposal.empty());
    EXPECT_TRUE(std::holds_alternative<UnknownGlass>(odd.medium_after.dispersion));
    EXPECT_EQ(file.lens.surfaces[3].medium_after.dispersion, Dispersion(ModelGlass{1.8, 46.5}));
    // XASPHERE: 0.05 (r/10)⁴ is 5e-6 r⁴.
    ASSERT_EQ(file.lens.surfaces[3].aspheric.size(), 1U);
    EXPECT_NEAR(file.lens.surfaces[3].aspheric[0], 5e-6, 1e-18);
    EXPECT_EQ(file.lens.surfaces[2].semi_diameter_mm, 5.0) << "FLOA: the stop's DIAM";
}

TEST(Zmx, GlassByTheRules) {
    const auto glass_of = [](const std::string& line) {
        return read_text_as_zmx(zmx_of(replaced(singlet, "GLAS N-BK7 0 0 1.5 40", line)))
            .lens.surfaces[0]
            .medium_after;
    };
    EXPECT_EQ(glass_of("GLAS ___BLANK 1 0 1.6 45.5").dispersion, Dispersion(ModelGlass{1.6, 45.5}));
    EXPECT_EQ(glass_of("GLAS ___BLANK 1 0 1.6 0").dispersion, Dispersion(ConstantIndex{1.6}));
    EXPECT_EQ(glass_of("GLAS LABEL 1 0 1.6 45.5").name, "LABEL");
    EXPECT_EQ(glass_of("GLAS NOBODYS1 0 0 1.7 30").dispersion, Dispersion(ModelGlass{1.7, 30.0}));
    for (const char* unreal : {"GLAS NOBODYS1 0 0 1.5 40", "GLAS NOBODYS1 0 0 0 0", "GLAS NOBODYS1",
                               "GLAS NOBODYS1 0 0 1.7 0"})
        EXPECT_TRUE(std::holds_alternative<UnknownGlass>(glass_of(unreal).dispersion)) << unreal;
    EXPECT_EQ(glass_of("GLAS n-bk7").name, "N-BK7");
}

TEST(Zmx, WhatCannotBeIsRefusedWithItsPlace) {
    const struct {
        std::string what, by, where, problem;
    } cases[] = {
        {"MODE SEQ", "MODE NSC", "line 1", "non-sequential"},
        {"UNIT MM", "UNIT PARSEC", "line 2", "unit"},
        {"GLAS N-BK7 0 0 1.5 40", "GLAS MIRROR 0 0 1.5 40", "line 11", "mirror"},
        {"  CURV 0.02", "  TYPE TOROIDAL\n  CURV 0.02", "SURF 1 (line 7)", "toroid"},
        {"  CURV 0.02", "  TYPE PARAXIAL\n  CURV 0.02", "SURF 1 (line 7)", "ideal"},
        {"  CURV 0.02", "  TYPE DGRATING\n  PARM 1 0.5\n  CURV 0.02", "SURF 1 (line 7)", "grating"},
        {"  CURV 0.02", "  TYPE COORDBRK\n  PARM 3 10\n  CURV 0", "SURF 1 (line 7)", "tilts"},
        {"  CURV 0.02", "  TYPE NEWKIND\n  CURV 0.02", "SURF 1 (line 7)", "not known"},
        {"CURV 0.02", "CURV x", "line 9", "not a number"},
        {"DISZ 4", "DISZ -4", "SURF 1 (line 7)", "out of order"},
        {"DISZ 4", "DISZ INFINITY", "SURF 1 (line 7)", "infinite"},
        {"GLAS N-BK7 0 0 1.5 40", "GLAS P 2 7", "line 11", "picked up"},
    };
    for (const auto& each : cases) {
        const std::string text = replaced(zmx_of(singlet), each.what, each.by);
        const Error::Parts parts = error_of([&] { read_text_as_zmx(text); });
        EXPECT_EQ(parts.file, "test.zmx") << each.by;
        EXPECT_EQ(parts.where, each.where) << each.by;
        EXPECT_NE(parts.problem.find(each.problem), std::string::npos) << parts.problem;
    }
    EXPECT_NE(error_of([] { read_text_as_zmx("MODE SEQ\nSURF 0\n"); }).problem.find("no lens"),
              std::string::npos);
}

/// A plane break that moves nothing, or only the image, does not stop the file.
TEST(Zmx, HarmlessBreaksAreOpened) {
    const std::string behind = replaced(zmx_of(singlet), "SURF 3",
                                        "SURF 3\n  TYPE COORDBRK\n  PARM 3 5\n  DISZ 0\nSURF 4");
    EXPECT_TRUE(note_with(read_text_as_zmx(behind).notes, "tilts or decentres")->matters_for_flare);
}

TEST(Zmx, ApertureKinds) {
    const auto order = [](const std::string& system) {
        return first_order(compile(
            read_text_as_zmx(zmx_of(replaced(singlet, "DIAM 6 1", "DIAM 6 0"), system)).lens,
            d_line_nm));
    };
    EXPECT_NEAR(order("ENPD 5\n").entrance_pupil_radius_mm, 2.5, rounding_mm);
    EXPECT_NEAR(order("FNUM 8 0\n").f_number, 8.0, rounding_mm);
    EXPECT_NEAR(order("FLOA\n").entrance_pupil_radius_mm, 6.0, rounding_mm);
    // NA 0.1 from an object 100 mm in front of the stop, which is the first surface.
    const std::string near =
        replaced(zmx_of(replaced(singlet, "DIAM 6 1", "DIAM 6 0"), "OBNA 0.1 0\n"), "DISZ INFINITY",
                 "DISZ 100");
    const double radius =
        first_order(compile(read_text_as_zmx(near).lens, d_line_nm)).entrance_pupil_radius_mm;
    EXPECT_NEAR(radius, 100.0 * std::tan(std::asin(0.1)), rounding_mm);
}

TEST(Zmx, ImageHeightsAndSolves) {
    const LensFile height = read_text_as_zmx(zmx_of(singlet, "ENPD 5\nFTYP 3 0 2 1\nYFLN 0 12\n"));
    EXPECT_NEAR(0.5 * std::hypot(height.lens.sensor.width_mm, height.lens.sensor.height_mm), 12.0,
                rounding_mm);
    const std::string solved = replaced(singlet, "DISZ 48", "DISZ 48\n  MAZH 0 0");
    EXPECT_TRUE(read_text_as_zmx(zmx_of(solved, "ENPD 5\nWAVM 1 0.5875618 1\nPWAV 1\n"))
                    .lens.sensor.at_paraxial_focus);
    EXPECT_FALSE(read_text_as_zmx(zmx_of(solved, "ENPD 5\nWAVM 1 0.7 1\nPWAV 1\n"))
                     .lens.sensor.at_paraxial_focus)
        << "another wavelength's focus";
}

TEST(Zmx, CutAnywhereIsALensOrAnError) {
    for (const char* name : {"zmx/triplet.zmx", "zmx/tricky.zmx", "zmx/zoom.zmx"}) {
        const std::string text = utf8_text(read_text(test_data_folder() / name));
        for (std::size_t end = 0; end < text.size(); ++end) {
            try {
                read_text_as_zmx(text.substr(0, end));
            } catch (const Error& error) {
                EXPECT_EQ(error.parts().file, "test.zmx") << error.what();
            }
        }
    }
}

TEST(Zmx, CoatingsByName) {
    const std::string coated =
        replaced(singlet, "CURV 0.02", "CURV 0.02\n  COAT mgf2-quarter-wave");
    const LensFile known = read_text_as_zmx(zmx_of(coated));
    EXPECT_FALSE(std::holds_alternative<Uncoated>(known.lens.surfaces[0].coating));
    const LensFile unknown =
        read_text_as_zmx(zmx_of(replaced(singlet, "CURV 0.02", "CURV 0.02\n  COAT NOBODYS")));
    EXPECT_TRUE(note_with(unknown.notes, "taken as uncoated")->matters_for_flare);
}

}  // namespace
}  // namespace ghostlight
