#include "core/io/stated_glass.h"

#include <gmock/gmock.h>

#include "tests/support/error_of.h"
#include "tests/support/import_kit.h"

namespace ghostlight {
namespace {

const Place place{"f.txt", "line 3"};

TEST(StatedGlass, NumbersNamesAndBoth) {
    Notes notes;
    EXPECT_TRUE(is_air(medium_of({}, place, notes)));
    EXPECT_TRUE(is_air(medium_of({.name = "Air", .nd = 1.0}, place, notes)));
    EXPECT_EQ(medium_of({.nd = 1.6, .vd = 50.0}, place, notes),
              (Medium{"", ModelGlass{1.6, 50.0}}));
    EXPECT_TRUE(notes.empty());
    // N-BK7 has nd 1.51680 in Schott's catalogue: within 2e-4, then beyond it.
    const Medium& bk7 = *bundled_glasses().find("N-BK7");
    EXPECT_EQ(medium_of({.name = "N-BK7", .nd = 1.5169, .vd = 64.2}, place, notes), bk7);
    EXPECT_EQ(medium_of({.name = "N-BK7"}, place, notes), bk7);
    EXPECT_EQ(medium_of({.name = "N-BK7", .nd = 1.5171, .vd = 64.2}, place, notes),
              (Medium{"N-BK7", ModelGlass{1.5171, 64.2}}));
    EXPECT_EQ(note_with(notes, "but 1.5171 in the file")->where, "line 3");
}

TEST(StatedGlass, WhatIsMissingIsSaid) {
    Notes notes;
    EXPECT_EQ(medium_of({.nd = 1.6, .vd = 0.0}, place, notes), (Medium{"", ConstantIndex{1.6}}));
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0].fate, Note::Fate::assumed);
    notes.clear();
    const Medium unknown = medium_of({.name = "NO-SUCH-GLASS"}, place, notes);
    EXPECT_TRUE(std::holds_alternative<UnknownGlass>(unknown.dispersion));
    ASSERT_FALSE(notes.empty());
    EXPECT_EQ(notes.back().severity, Note::Severity::error);
    EXPECT_FALSE(notes.back().proposal.empty());
}

TEST(StatedGlass, UnusableNumbersAreRefused) {
    Notes notes;
    for (const double nd : {0.0, 0.5, -1.5, 11.0})
        EXPECT_EQ(error_of([&] { medium_of({.nd = nd}, place, notes); }).where, "line 3");
    error_of([&] { medium_of({.nd = 1.5, .vd = 0.01}, place, notes); });
}

}  // namespace
}  // namespace ghostlight
