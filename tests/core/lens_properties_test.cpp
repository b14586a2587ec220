// A slice of ./dev properties.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/error.h"
#include "tests/kits/random_lens.h"

namespace ghostlight {
namespace {

LawCounts hold_laws(LensKind kind, std::uint64_t lenses) {
    LawCounts counts;
    for (std::uint64_t number = 1; number <= lenses; ++number) {
        try {
            for (const Violation& each : broken_laws(random_lens(kind, number), number, counts))
                ADD_FAILURE() << "lens " << number << ": " << each.law << ": " << each.what;
        } catch (const Error&) {
            // Refused with words: that is a lawful end too.
        }
    }
    return counts;
}

TEST(LensProperties, HoldForPlausibleLenses) {
    const LawCounts counts = hold_laws(LensKind::plausible, 120);
    EXPECT_GT(counts.energy, 3000U);
    EXPECT_GT(counts.reversed, 200U);
    EXPECT_GT(counts.unfolded, 200U);
    EXPECT_GT(counts.scaled, 200U);
}

TEST(LensProperties, HoldForHostileLenses) {
    const LawCounts counts = hold_laws(LensKind::hostile, 200);
    EXPECT_GT(counts.finite, 50'000U);
    EXPECT_GT(counts.films, 5000U);
    EXPECT_GT(counts.energy, 1000U);
}

TEST(LensProperties, CanBeBroken) {
    LawCounts counts;
    std::set<std::string> broken;
    for (std::uint64_t number = 1; number <= 40; ++number)
        for (const Violation& each :
             broken_laws(random_lens(LensKind::plausible, number), number, counts, 1e6))
            broken.insert(each.law);
    for (const char* law : {"rotation", "unfolded", "reversal"})
        EXPECT_TRUE(broken.contains(law)) << law;
}

}  // namespace
}  // namespace ghostlight
