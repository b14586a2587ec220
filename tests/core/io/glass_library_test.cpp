#include "core/io/glass_library.h"
#include "tests/support/test_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ghostlight {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

GlassLibrary with_samples() {
    const std::vector<std::filesystem::path> folders{test_data_folder() / "agf",
                                                     test_data_folder() / "materials"};
    return read_glass_library(folders);
}

const std::vector<std::string> schott{"SCHOTT"};

TEST(GlassLibrary, TheUsersFoldersComeBeforeWhatIsBundled) {
    const GlassLibrary library = with_samples();
    ASSERT_GE(library.catalogs.size(), 5U);
    EXPECT_EQ(library.catalogs[0].name, "SAMPLE");
    std::vector<std::string> names;
    std::size_t bundled = 0;
    for (const GlassFile& catalog : library.catalogs) {
        names.push_back(catalog.name);
        if (catalog.file.extension() == ".json") bundled += catalog.glasses.size();
    }
    EXPECT_THAT(names, testing::IsSupersetOf({"SCHOTT", "OHARA", "HOYA", "CRYSTAL"}));
    EXPECT_EQ(bundled, 108U);
    const std::vector<std::filesystem::path> nowhere{"/nowhere/at/all"};
    const GlassLibrary missing = read_glass_library(nowhere);
    ASSERT_EQ(missing.notes.size(), 1U);
    EXPECT_EQ(missing.notes[0].where, "/nowhere/at/all");
}

TEST(GlassLibrary, NamesAreTheSameWithoutHyphensAndInAnyCase) {
    const GlassLibrary library = with_samples();
    for (const char* name : {"N-BK7", "n-bk7", "NBK7", "nbk7", "N BK7"}) {
        const auto match = find_glass(library, name, schott);
        ASSERT_TRUE(match) << name;
        EXPECT_EQ(match->glass.medium.name, "N-BK7") << name;
        EXPECT_EQ(match->glass.catalog, "SCHOTT") << name;
        EXPECT_TRUE(match->in_requested);
    }
    EXPECT_FALSE(find_glass(library, "UNOBTAINIUM", {}));
    EXPECT_FALSE(find_glass(library, "", {}));
    EXPECT_FALSE(find_glass(library, "-", {}));
}

TEST(GlassLibrary, CataloguesAreSearchedInTheOrderAskedFor) {
    const GlassLibrary library = with_samples();
    const std::vector<std::string> sample_first{"SAMPLE", "SCHOTT"};
    EXPECT_EQ(find_glass(library, "N-BK7", sample_first)->glass.catalog, "SAMPLE");
    const std::vector<std::string> schott_first{"SCHOTT", "SAMPLE"};
    EXPECT_EQ(find_glass(library, "N-BK7", schott_first)->glass.catalog, "SCHOTT");
    // None of those asked for has it: found elsewhere, and said so.
    const auto elsewhere = find_glass(library, "S-FPL53", schott);
    ASSERT_TRUE(elsewhere);
    EXPECT_EQ(elsewhere->glass.catalog, "OHARA");
    EXPECT_FALSE(elsewhere->in_requested);
    // CODE V's spelling names the catalogue itself.
    EXPECT_EQ(find_glass(library, "NBK7_SCHOTT", {})->glass.catalog, "SCHOTT");
}

TEST(GlassLibrary, HomonymsWithAnotherIndexAreReported) {
    GlassLibrary library = with_samples();
    // The same N-BK7 twice is no homonym.
    EXPECT_TRUE(find_glass(library, "N-BK7", schott)->homonyms.empty());
    CataloguedGlass other;
    other.medium = {"N-BK7", ModelGlass{1.5300, 60.0}};
    other.catalog = "OTHER";
    complete_glass(other);
    library.catalogs.push_back({"OTHER", {}, {other}, {}});
    const auto match = find_glass(library, "N-BK7", schott);
    ASSERT_EQ(match->homonyms.size(), 1U);
    EXPECT_EQ(match->homonyms[0].catalog, "OTHER");
}

TEST(GlassLibrary, SimilarNamesAreSuggested) {
    const GlassLibrary library = read_glass_library({});
    EXPECT_THAT(similar_glasses(library, "BK7"), ElementsAre("N-BK7"));
    EXPECT_THAT(similar_glasses(library, "bk7"), ElementsAre("N-BK7"));
    EXPECT_THAT(similar_glasses(library, "nbk7"), Contains("N-BK7"));
    EXPECT_THAT(similar_glasses(library, "FPL53"), ElementsAre("S-FPL53"));
    EXPECT_TRUE(similar_glasses(library, "XYZZY").empty());
    EXPECT_TRUE(similar_glasses(library, "").empty());
}

TEST(GlassLibrary, NearestAreByIndexAndAbbeNumber) {
    const GlassLibrary library = read_glass_library({});
    const auto nearest = nearest_glasses(library, 1.5168, 64.17, 3);
    ASSERT_EQ(nearest.size(), 3U);
    EXPECT_EQ(nearest[0].glass.medium.name, "N-BK7");
    EXPECT_LE(nearest[0].distance, nearest[1].distance);
    EXPECT_LE(nearest[1].distance, nearest[2].distance);
    EXPECT_NEAR(nearest[0].distance,
                std::hypot(*nearest[0].glass.nd - 1.5168, 0.01 * (*nearest[0].glass.vd - 64.17)),
                1e-15);
    EXPECT_EQ(nearest_glasses(library, 1.5, 60.0, 10'000).size(), 108U);
    EXPECT_TRUE(nearest_glasses(library, 1.5, 60.0, 0).empty());
}

TEST(GlassCode, IsReadInItsSpellings) {
    for (const char* text :
         {"517642", "517.642", "517-642", "517/642", "517:642", "517000.642000", "517642.251"}) {
        const auto glass = glass_code(text);
        ASSERT_TRUE(glass) << text;
        EXPECT_NEAR(glass->nd, 1.517, 1e-12) << text;
        EXPECT_NEAR(glass->vd, 64.2, 1e-12) << text;
    }
    // 2.003, 19.3: the code has no place for the 1 before the point.
    EXPECT_NEAR(glass_code("003193")->nd, 2.003, 1e-12);
    EXPECT_NEAR(glass_code("516800.641700")->nd, 1.5168, 1e-12);
    for (const char* text :
         {"", "N-BK7", "51764", "5176423", "517.64", "517642x", "517000", ".", "517.", "517.642.1"})
        EXPECT_FALSE(glass_code(text)) << text;
}

TEST(GlassCode, FindsTheGlassesOfThatCode) {
    const GlassLibrary library = read_glass_library({});
    const auto found = glasses_by_code(library, "517642");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].medium.name, "N-BK7");
    EXPECT_EQ(glasses_by_code(library, "516641").at(0).medium.name, "S-BSL7");
    EXPECT_TRUE(glasses_by_code(library, "999999").empty());
    EXPECT_TRUE(glasses_by_code(library, "nonsense").empty());
}

TEST(GlassLibrary, FoldersMayBeSetAndTheLibraryFollows) {
    set_glass_folders({test_data_folder() / "agf"});
    const auto with = glass_library();
    EXPECT_EQ(find_glass("J-BK7A", {})->glass.catalog, "SAMPLE");
    set_glass_folders({});
    EXPECT_FALSE(find_glass("J-BK7A", {}));
    // Whoever still holds the old one may go on using it.
    EXPECT_TRUE(find_glass(*with, "J-BK7A", {}));
}

}  // namespace
}  // namespace ghostlight
