#include "widgets/fuzzy_match.h"

#include <gtest/gtest.h>

namespace ghostlight {
namespace {

TEST(FuzzyMatch, AllLettersInTheirOrderMustBeThere) {
    EXPECT_TRUE(fuzzy_score("rsp", "Restore Panels"));
    EXPECT_TRUE(fuzzy_score("RESTORE", "Restore Panels"));
    EXPECT_TRUE(fuzzy_score("", "Restore Panels"));
    EXPECT_FALSE(fuzzy_score("psr", "Restore"));
    EXPECT_FALSE(fuzzy_score("restorez", "Restore Panels"));
    EXPECT_FALSE(fuzzy_score("ee", "Undo e"));
    EXPECT_FALSE(fuzzy_score("a", ""));
}

TEST(FuzzyMatch, WordsMayComeInAnyOrder) {
    EXPECT_TRUE(fuzzy_score("panel next", "View ▸ Next Panel"));
    EXPECT_FALSE(fuzzy_score("panel last", "View ▸ Next Panel"));
}

TEST(FuzzyMatch, WordBeginningsAndRunsArePreferred) {
    EXPECT_GT(fuzzy_score("ep", "Export PNG"), fuzzy_score("ep", "Keep"));
    EXPECT_GT(fuzzy_score("undo", "Undo"), fuzzy_score("undo", "Unfolded node"));
    EXPECT_GT(fuzzy_score("png", "File ▸ Export as PNG"), fuzzy_score("png", "Open in big"));
}

}  // namespace
}  // namespace ghostlight
