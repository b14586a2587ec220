#include "core/io/glass_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace ghostlight {
namespace {

struct GlassSearchTest : testing::Test {
    std::vector<MappedGlass> glasses = mapped_glasses(*glass_library());
    std::vector<std::string> names(std::string_view text) {
        std::vector<std::string> found;
        for (const std::size_t k : find_glasses(glasses, text))
            found.push_back(glasses[k].glass.medium.name);
        return found;
    }
};

TEST_F(GlassSearchTest, ByPartOfANameWithOrWithoutHyphens) {
    ASSERT_FALSE(names("nbk7").empty());
    EXPECT_EQ(names("nbk7").front(), "N-BK7");
    EXPECT_EQ(names("n-bk7").front(), "N-BK7");
    EXPECT_EQ(names("").size(), glasses.size());
    EXPECT_TRUE(names("unobtainium").empty());
}

TEST_F(GlassSearchTest, ByCodeAndByPlace) {
    const auto coded = names("517642");  // N-BK7's: nd 1.51680, Vd 64.17
    EXPECT_NE(std::ranges::find(coded, "N-BK7"), coded.end());
    EXPECT_LT(coded.size(), 10U);
    for (const MappedGlass& glass : glasses) {
        const auto text = std::to_string(glass.nd) + " / " + std::to_string(glass.vd);
        const std::size_t nearest = find_glasses(glasses, text).front();
        // The six digits of the text, in nd and a hundredth of Vd.
        EXPECT_NEAR(glasses[nearest].nd, glass.nd, 2e-6) << glass.glass.medium.name;
        EXPECT_NEAR(glasses[nearest].vd, glass.vd, 2e-4) << glass.glass.medium.name;
    }
}

/// Schott's data sheets: P_gF of N-BK7 0.5349, N-SF6 0.6158, N-FK51A 0.5359 (ΔP 0.0342); to the
/// last digit printed there.
TEST_F(GlassSearchTest, PartialDispersionsAreSchotts) {
    const std::pair<const char*, double> sheets[] = {
        {"N-BK7", 0.5349}, {"N-SF6", 0.6158}, {"N-FK51A", 0.5359}};
    int known = 0;
    for (const auto& [name, p_gf] : sheets) {
        const auto found = find_glasses(glasses, name);
        if (found.empty() || glasses[found.front()].glass.medium.name != name) continue;
        ASSERT_TRUE(glasses[found.front()].p_gf) << name;
        EXPECT_NEAR(*glasses[found.front()].p_gf, p_gf, 1e-4) << name;
        ++known;
    }
    EXPECT_GE(known, 1);
}

}  // namespace
}  // namespace ghostlight
