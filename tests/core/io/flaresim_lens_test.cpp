#include "core/io/flaresim_lens.h"

#include <gmock/gmock.h>

#include "core/io/stated_heights.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "tests/support/error_of.h"
#include "tests/support/import_kit.h"

namespace ghostlight {
namespace {

constexpr double rounding_mm = 1e-9;  ///< two ways of the same sum

ImportedLens import(const std::string& text) { return import_flaresim_lens({text, "test.lens"}); }

TEST(FlareSimLens, NumbersAsPrintedAndDiametersHalved) {
    const LensFile file = read_sample("flaresim/double_gauss.lens");
    expect_rows(file.lens, double_gauss_rows, double_gauss_clear_radii);
    EXPECT_EQ(file.lens.name, "Double Gauss 100mm f/2");
    EXPECT_EQ(file.lens.stop.surface, 5u);
    EXPECT_EQ(file.lens.published.efl_mm, 100.0);
    EXPECT_EQ(file.lens.published.f_number, 2.0);
    EXPECT_EQ(file.lens.surfaces.back().thickness_mm, 72.228);
    EXPECT_FALSE(file.lens.sensor.at_paraxial_focus);
    EXPECT_EQ(file.lens.surfaces[0].medium_after, (Medium{"", ModelGlass{1.67, 47.1}}));
    EXPECT_EQ(file.lens.surfaces[0].coating, Coating(QuarterWave{}));
    EXPECT_EQ(file.lens.surfaces[3].coating, Coating(Uncoated{}));
    const Note* halved = note_with(file.notes, "diameters: halved");
    ASSERT_NE(halved, nullptr);
    EXPECT_EQ(halved->fate, Note::Fate::converted);
    EXPECT_TRUE(halved->matters_for_flare);
    EXPECT_EQ(note_with(file.notes, "3 layers")->where, "line 18");
}

TEST(FlareSimLens, FirstOrderByAnotherWay) {
    const FirstOrder order =
        first_order(compile(read_sample("flaresim/double_gauss.lens").lens, d_line_nm));
    EXPECT_NEAR(order.efl_mm, book_focus(double_gauss_rows).efl_mm, rounding_mm);
    EXPECT_NEAR(order.bfd_mm, book_focus(double_gauss_rows).bfd_mm, rounding_mm);
}

/// A biconvex lens of f near 50: at f/2.5 its beam is 10 mm high, so the stop says what heights
/// are.
std::string singlet(const std::string& name, const std::string& stop, const std::string& rim) {
    return "name: " + name + "\nsurfaces:\nstop 1 1 0 " + stop + " 0\n50 4 1.5 60 " + rim +
           " 0\n-50 48 1 0 " + rim + " 0\n";
}

TEST(FlareSimLens, HeightsAreJudgedByTheStopAndBySpheres) {
    EXPECT_EQ(import(singlet("a F2.5", "10", "12")).surfaces[1].semi_diameter_mm, 12.0);
    EXPECT_EQ(import(singlet("a F2.5", "20", "24")).surfaces[1].semi_diameter_mm, 12.0);
    EXPECT_EQ(import(singlet("a F2.5", "1.0", "1.2")).surfaces[1].semi_diameter_mm, 12.0);
    // No f-number: only what no sphere can be is evidence.
    EXPECT_EQ(import(singlet("a", "20", "24")).surfaces[1].semi_diameter_mm, 24.0);
    EXPECT_EQ(import(singlet("a", "20", "60")).surfaces[1].semi_diameter_mm, 30.0);
    EXPECT_EQ(import("# Converted from photonstophotos.net\n" + singlet("a", "20", "24"))
                  .surfaces[1]
                  .semi_diameter_mm,
              12.0);
    // Neither right nor twice: taken as it is, and said.
    const ImportedLens odd = import(singlet("a F2.5", "14", "16"));
    EXPECT_EQ(odd.surfaces[1].semi_diameter_mm, 16.0);
    EXPECT_TRUE(note_with(odd.notes, "taken as semi-diameters")->matters_for_flare);
}

TEST(FlareSimLens, FNumbersInNames) {
    EXPECT_EQ(f_number_in("Double Gauss 100mm f/2"), 2.0);
    EXPECT_EQ(f_number_in("AI Nikkor 28mm F1.4D"), 1.4);
    EXPECT_EQ(f_number_in("AF Zoom 70-180mm F4.5-5.6D ED"), 4.5);
    EXPECT_EQ(f_number_in("FS 200, LEAF9, f/900"), std::nullopt);
    EXPECT_EQ(f_number_in("f/"), std::nullopt);
    EXPECT_EQ(f_number_in(""), std::nullopt);
}

TEST(FlareSimLens, UnknownLinesAndErrorsNameTheLine) {
    const ImportedLens odd =
        import("vendor: me\nname: x\nsurfaces:\n50 4 1.5 60 9 0\n-50 48 1 0 9 0\n");
    EXPECT_EQ(note_with(odd.notes, "\"vendor\"")->fate, Note::Fate::left_out);
    const auto line = [](const char* row) {
        return error_of([&] { import(std::string("surfaces:\n") + row + "\n"); });
    };
    EXPECT_EQ(line("50 4 1.5 60").where, "line 2");
    EXPECT_THAT(line("50 4 1.5 60 9 1 cyl_x").problem, testing::HasSubstr("cylinder"));
    EXPECT_THAT(line("50 4 1.5 60 9 1 toric 80").problem, testing::HasSubstr("toroid"));
    EXPECT_THAT(line("50 4 1.5 60 9 1 blob").problem, testing::HasSubstr("type"));
    EXPECT_THAT(line("x 4 1.5 60 9 1").found, testing::HasSubstr("x"));
    EXPECT_THAT(line("").problem, testing::HasSubstr("no surfaces"));
    error_of([] { import("name: x\n"); });
}

}  // namespace
}  // namespace ghostlight
