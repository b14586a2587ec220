#include "core/io/pbrt_lens.h"

#include <gmock/gmock.h>

#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "tests/support/error_of.h"
#include "tests/support/import_kit.h"

namespace ghostlight {
namespace {

constexpr double rounding_mm = 1e-9;  ///< two ways of the same sum

ImportedLens import(const std::string& text) { return import_pbrt_lens({text, "test.dat"}); }

TEST(PbrtLens, NumbersAsPrinted) {
    const LensFile file = read_sample("pbrt/double_gauss.dat");
    expect_rows(file.lens, double_gauss_rows, double_gauss_clear_radii);
    EXPECT_EQ(file.lens.name, "Double Gauss f/2, 22 degrees half field");
    EXPECT_THAT(file.lens.source, testing::HasSubstr("US patent 2,673,491"));
    EXPECT_EQ(file.lens.stop.surface, 5u);
    for (const Surface& surface : file.lens.surfaces)
        EXPECT_EQ(surface.coating, Coating(Uncoated{}));
}

TEST(PbrtLens, FirstOrderByAnotherWay) {
    const LensFile file = read_sample("pbrt/double_gauss.dat");
    const FirstOrder order = first_order(compile(file.lens, d_line_nm));
    const BookFocus book = book_focus(double_gauss_rows);
    EXPECT_NEAR(order.efl_mm, book.efl_mm, rounding_mm);
    EXPECT_NEAR(order.bfd_mm, book.bfd_mm, rounding_mm);
    EXPECT_NEAR(order.efl_mm, 100.0, 1.0);  // the patent's, whose indices have three decimals
    EXPECT_TRUE(file.lens.sensor.at_paraxial_focus);
}

TEST(PbrtLens, ReportSaysWhatIsMissing) {
    const LensFile file = read_sample("pbrt/double_gauss.dat");
    const Note* dispersion = note_with(file.notes, "no dispersion");
    ASSERT_NE(dispersion, nullptr);
    EXPECT_EQ(dispersion->fate, Note::Fate::assumed);
    EXPECT_TRUE(dispersion->matters_for_flare);
    const Note* last = note_with(file.notes, "72.228");
    ASSERT_NE(last, nullptr);
    EXPECT_EQ(last->where, "line 14");
    EXPECT_EQ(note_with(file.notes, "halved")->fate, Note::Fate::converted);
}

TEST(PbrtLens, ACountOfRowsIsNotAFocalLength) {
    const LensFile counted = read_sample("pbrt/double_gauss_counted.dat");
    expect_rows(counted.lens, double_gauss_rows, double_gauss_clear_radii);
    EXPECT_FALSE(counted.lens.published.efl_mm);
    const ImportedLens focal = import("50\n30 4 1.5 20\n0 2 0 10\n-30 40 1 20\n");
    EXPECT_EQ(focal.stated_efl_mm, 50.0);
}

/// pbrt takes each radius 0 for the stop; glass beside it says otherwise.
TEST(PbrtLens, FlatGlassIsNotTheStop) {
    const ImportedLens lens = import("0 4 1.5 20\n-30 2 1 20\n0 2 0 10\n0 3 1 30\n30 9 1.5 20\n");
    EXPECT_EQ(lens.stop, 2u);
    EXPECT_NE(note_with(lens.notes, "glass beside it"), nullptr);
    EXPECT_NE(note_with(lens.notes, "narrower row"), nullptr);
}

TEST(PbrtLens, ErrorsNameTheLine) {
    const Error::Parts row = error_of([] { import("50 4 1.5 20\n-50 50 1.0\n"); });
    EXPECT_EQ(row.where, "line 2");
    EXPECT_EQ(row.file, "test.dat");
    const Error::Parts word = error_of([] { import("# x\n50 4 1,5 20\n"); });
    EXPECT_EQ(word.where, "line 2");
    EXPECT_EQ(word.found, "\"1,5\"");
    EXPECT_THAT(error_of([] { import("50 4 0.5 20\n"); }).problem, testing::HasSubstr("index"));
    EXPECT_THAT(error_of([] { import("50 4e7 1.5 20\n-1 0 1 2\n"); }).problem,
                testing::HasSubstr("thickness"));
    error_of([] { import("# nothing\n"); });
}

}  // namespace
}  // namespace ghostlight
