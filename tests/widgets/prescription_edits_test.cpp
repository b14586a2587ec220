#include "widgets/prescription_edits.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/widgets/window_kit.h"

namespace ghostlight {
namespace {

/// Two traces of the same lens differ by rounding alone.
constexpr double rounding_mm = 1e-9;

double efl_mm(const Prescription& lens) { return first_order(compile(lens, d_line_nm)).efl_mm; }

Prescription zoom() { return read_lens(test::bundled("nikon_zoom_80_200_f2.8.json")).lens; }

TEST(PrescriptionEdits, AnInsertedRowChangesNoRay) {
    const Prescription lens = read_lens(test::tessar()).lens;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const Prescription longer = with_row_inserted_after(lens, row);
        EXPECT_EQ(longer.surfaces.size(), lens.surfaces.size() + 1);
        EXPECT_NEAR(efl_mm(longer), efl_mm(lens), rounding_mm);
        EXPECT_EQ(longer.stop.surface, lens.stop.surface + (row < lens.stop.surface ? 1 : 0));
    }
}

TEST(PrescriptionEdits, ConfigurationsFollowTheirRows) {
    const Prescription lens = zoom();
    ASSERT_FALSE(lens.configurations.empty());
    for (const Configuration& position : lens.configurations) {
        for (std::size_t row = 0; row < lens.surfaces.size(); row += 3) {
            const Prescription longer = with_row_inserted_after(lens, row);
            EXPECT_NEAR(efl_mm(configured(longer, position.name)),
                        efl_mm(configured(lens, position.name)), 1e-6);
        }
    }
}

TEST(PrescriptionEdits, InsertAndRemoveComeBack) {
    Prescription lens = zoom();
    // Halving and doubling is exact, but removal drops the new row's half of the gap.
    const Prescription longer = with_row_inserted_after(lens, 4);
    Prescription back = with_row_removed(longer, 5);
    back.surfaces[4].thickness_mm = lens.surfaces[4].thickness_mm;
    for (std::size_t k = 0; k < lens.configurations.size(); ++k) {
        if (lens.configurations[k].thickness_mm.contains(4)) {
            back.configurations[k].thickness_mm[4] = lens.configurations[k].thickness_mm[4];
        }
    }
    EXPECT_EQ(back, lens);
}

TEST(PrescriptionEdits, MovingThereAndBackIsNothing) {
    const Prescription lens = zoom();
    const std::size_t rows = lens.surfaces.size();
    for (const auto& [from, to] :
         {std::pair<std::size_t, std::size_t>{0, 5}, {9, 2}, {3, 4}, {rows - 1, 0}}) {
        EXPECT_EQ(with_row_moved(with_row_moved(lens, from, to), to, from), lens);
        EXPECT_EQ(with_row_moved(lens, from, to).surfaces[to], lens.surfaces[from]);
    }
}

TEST(PrescriptionEdits, Refusals) {
    Prescription lens = read_lens(test::tessar()).lens;
    EXPECT_THROW(with_row_removed(lens, lens.stop.surface), Error);
    EXPECT_THROW(with_row_moved(lens, 0, 8), Error);
    EXPECT_THROW(with_stop_at(lens, 8), Error);
    lens.surfaces.resize(1);
    lens.stop.surface = 0;
    EXPECT_THROW(with_row_removed(lens, 0), Error);
}

}  // namespace
}  // namespace ghostlight
