#include "core/io/agf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_of.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

using testing::HasSubstr;

const std::filesystem::path folder = test_data_folder() / "agf";

const CataloguedGlass* named(const GlassFile& catalog, std::string_view name) {
    for (const CataloguedGlass& glass : catalog.glasses)
        if (glass.medium.name == name) return &glass;
    return nullptr;
}

TEST(Agf, ReadsGlassesWithEverythingTheyCarry) {
    const GlassFile catalog = read_agf(folder / "SAMPLE.AGF");
    EXPECT_EQ(catalog.name, "SAMPLE");
    ASSERT_EQ(catalog.glasses.size(), 5U);
    const CataloguedGlass* crown = named(catalog, "BK7");
    ASSERT_NE(crown, nullptr);
    EXPECT_EQ(crown->catalog, "SAMPLE");
    EXPECT_EQ(crown->comment, "the old crown");
    EXPECT_EQ(crown->listed_nd, 1.5168);
    EXPECT_EQ(crown->listed_vd, 64.17);
    EXPECT_NEAR(crown->nd.value(), 1.5168, 1e-6);
    EXPECT_EQ(crown->status, GlassStatus::obsolete);
    EXPECT_EQ(crown->where, "line 3");
    const AgfGlass& formula = std::get<AgfGlass>(crown->medium.dispersion);
    EXPECT_EQ(formula.formula, 1);
    EXPECT_EQ(formula.coefficients.size(), 6U);
    EXPECT_NEAR(formula.min_nm, 330.0, 1e-9);
    EXPECT_NEAR(formula.max_nm, 2325.4, 1e-9);
    // By rising wavelength and thickness; what is '-' was not measured.
    const std::vector<InternalTransmittance> expected{
        {365.0, 0.988, 10.0}, {365.0, 0.97, 25.0}, {400.0, 0.998, 10.0}};
    EXPECT_EQ(crown->medium.transmittance, expected);
}

TEST(Agf, TakesAFormulaWrittenWithAnExponent) {
    const GlassFile catalog = read_agf(folder / "SAMPLE.AGF");
    const CataloguedGlass* glass = named(catalog, "N-BK7");
    ASSERT_NE(glass, nullptr);
    EXPECT_EQ(std::get<AgfGlass>(glass->medium.dispersion).formula, 2);
    EXPECT_EQ(glass->status, GlassStatus::preferred);
}

TEST(Agf, Utf16IsTheSameCatalogue) {
    const GlassFile plain = read_agf(folder / "SAMPLE.AGF");
    const GlassFile wide = read_agf(folder / "SAMPLE_UTF16.AGF");
    ASSERT_EQ(wide.glasses.size(), plain.glasses.size());
    for (std::size_t i = 0; i < plain.glasses.size(); ++i)
        EXPECT_EQ(wide.glasses[i].medium, plain.glasses[i].medium);
    EXPECT_EQ(wide.notes, plain.notes);
}

TEST(Agf, OneAndZeroMeanNotGiven) {
    const GlassFile catalog = read_agf(folder / "SAMPLE.AGF");
    const CataloguedGlass* glass = named(catalog, "NONAME");
    ASSERT_NE(glass, nullptr);
    EXPECT_FALSE(glass->listed_nd);
    EXPECT_FALSE(glass->listed_vd);
    EXPECT_TRUE(glass->nd);
}

TEST(Agf, AFormulaThatDisagreesWithItsOwnIndexIsFlagged) {
    const GlassFile catalog = read_agf(folder / "SAMPLE.AGF");
    ASSERT_NE(named(catalog, "WRONG"), nullptr);
    std::vector<std::string> flagged;
    for (const Note& note : catalog.notes)
        if (note.fate == Note::Fate::noticed) {
            flagged.push_back(note.text);
            EXPECT_TRUE(note.matters_for_flare);
        }
    ASSERT_EQ(flagged.size(), 1U);
    EXPECT_THAT(flagged[0], HasSubstr("WRONG"));
    EXPECT_THAT(flagged[0], HasSubstr("1.516800"));
    EXPECT_THAT(flagged[0], HasSubstr("1.5178"));
}

TEST(Agf, WhatCannotBeUsedIsLeftOutAndSaidSo) {
    const GlassFile catalog = read_agf(folder / "SAMPLE.AGF");
    EXPECT_EQ(named(catalog, "STRANGE"), nullptr);
    EXPECT_EQ(named(catalog, "EMPTY"), nullptr);
    std::string said;
    for (const Note& note : catalog.notes) said += note.where + ": " + note.text + "\n";
    EXPECT_THAT(said, HasSubstr("STRANGE: dispersion formula 17 is not known"));
    EXPECT_THAT(said, HasSubstr("EMPTY has no coefficients"));
}

TEST(Agf, NoCatalogueIsRefused) {
    for (const char* text : {"", "CC nothing\n", "{\"json\": 1}", "\x01\x02\x03"}) {
        const Error::Parts error = error_of([&] { agf_from_text(text, "x.agf"); });
        EXPECT_EQ(error.file, "x.agf");
        EXPECT_THAT(error.expected, HasSubstr("NM"));
    }
    EXPECT_THAT(error_of([] { read_agf("/nowhere/x.agf"); }).file, HasSubstr("x.agf"));
}

TEST(Agf, EveryTruncationIsReadOrRefused) {
    const std::string text =
        "NM A 2 517642 1.5168 64.17 0 1\nCD 1.04 0.006 0.23 0.02 1.0 103\nLD .3 2\nIT .4 .9 10\n";
    for (std::size_t size = 0; size <= text.size(); ++size) {
        try {
            agf_from_text(text.substr(0, size), "x.agf");
        } catch (const Error&) {
        }
    }
}

}  // namespace
}  // namespace ghostlight
