#include "core/io/varied_cells.h"

#include <gtest/gtest.h>

#include "core/fit/fit_parameters.h"
#include "core/io/lens_file.h"
#include "core/optics/reverse.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

Prescription tessar() { return read_lens(lens_folder() / "tessar_brendel_100_f2.8.json").lens; }

TEST(VariedCellsTest, MarksAreWhatFitsTake) {
    Prescription lens = tessar();
    EXPECT_EQ(vary_text(lens), "");
    set_varied(lens.surfaces[0], "radius", true);
    set_varied(lens.surfaces[0], "gap", true);
    set_varied(lens.surfaces[4], "radius", true);
    EXPECT_EQ(vary_text(lens), "gap@1,radius@1,radius@5");
    const auto parameters = parse_vary(vary_text(lens), lens);
    ASSERT_EQ(parameters.size(), 3U);
    EXPECT_EQ(parameters[2].kind, FitKind::radius);
    EXPECT_EQ(parameters[2].rows, std::vector<std::size_t>{4});
}

TEST(VariedCellsTest, MarksAreSavedAndFollowTheirRow) {
    Prescription lens = tessar();
    set_varied(lens.surfaces[1], "radius", true);
    const LensFile back = lens_from_json(lens_to_json(lens), "lens.json");
    EXPECT_EQ(back.lens, lens);
    EXPECT_TRUE(back.notes.empty());
    EXPECT_EQ(vary_text(reversed(lens)), "radius@7");
    set_varied(lens.surfaces[1], "radius", false);
    EXPECT_EQ(lens, tessar());
}

TEST(VariedCellsTest, WhatIsNoListIsNoMark) {
    Surface surface;
    surface.unknown["vary"] = "{\"radius\": tr";
    EXPECT_TRUE(varied(surface).empty());
    set_varied(surface, "gap", true);
    EXPECT_EQ(varied(surface), std::set<std::string>{"gap"});
}

}  // namespace
}  // namespace ghostlight
