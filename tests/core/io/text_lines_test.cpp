#include "core/io/text_lines.h"

#include <gmock/gmock.h>

#include "core/io/import_notes.h"
#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    std::size_t number = 0;
    for (const TextLine& line : text_lines(text)) {
        EXPECT_EQ(line.number, ++number);
        lines.emplace_back(line.text);
    }
    return lines;
}

TEST(TextLines, EveryEndingEndsALine) {
    using Lines = std::vector<std::string>;
    EXPECT_EQ(lines_of("a\nb\r\nc\rd"), (Lines{"a", "b", "c", "d"}));
    EXPECT_EQ(lines_of("a\n\n\r\n\rb\n"), (Lines{"a", "", "", "", "b"}));
    EXPECT_EQ(lines_of(""), Lines{});
    EXPECT_EQ(lines_of("\n"), Lines{""});
}

TEST(TextLines, Words) {
    EXPECT_THAT(words(" a \t bc  "), testing::ElementsAre("a", "bc"));
    EXPECT_TRUE(words(" \t").empty());
    EXPECT_EQ(trimmed("  a b\t"), "a b");
    EXPECT_TRUE(is_same_name("Stop", "sTOP"));
    EXPECT_FALSE(is_same_name("stop", "stops"));
}

TEST(TextLines, NumbersWhateverTheLocale) {
    EXPECT_EQ(parse_number("+1.5"), 1.5);
    EXPECT_EQ(parse_number("-1.5e-3"), -1.5e-3);
    EXPECT_EQ(parse_number("1.5D+02"), 150.0);
    EXPECT_EQ(parse_number("1."), 1.0);
    for (const char* word : {"", "+", "nan", "inf", "1,5", "1.5mm", "0x10", "1e400", "--1", "+-1"})
        EXPECT_EQ(parse_number(word), std::nullopt) << word;
    EXPECT_EQ(parse_number(std::string(100, '1')), std::nullopt);
}

/// "é" is two bytes, of which half a one is not text.
TEST(TextLines, CutsBetweenCharacters) {
    EXPECT_EQ(clipped("abc", 3), "abc");
    EXPECT_EQ(clipped("abcd", 3), "abc");
    EXPECT_EQ(clipped("ab\xc3\xa9", 3), "ab");
    EXPECT_EQ(in_quotes("a\"b"), "\"a\\\"b\"");
}

TEST(TextLines, APlaceNamesFileAndLine) {
    const Place place{"f.len", "line 3"};
    EXPECT_EQ(place.number("2", "a length"), 2.0);
    const Error::Parts error = error_of([&] { place.number("two", "a length"); });
    EXPECT_EQ(error.file, "f.len");
    EXPECT_EQ(error.where, "line 3");
    EXPECT_EQ(error.found, "\"two\"");
    EXPECT_EQ(error.expected, "a length");
}

TEST(ImportNotes, AWordIsReportedOnceHoweverOftenItIsThere) {
    UnusedWords unused;
    for (int i = 0; i < 5; ++i) unused.add("ABC", "line " + std::to_string(i + 1));
    for (int i = 0; i < 1000; ++i) unused.add("W" + std::to_string(i), "line 9");
    Notes notes;
    unused.report(notes);
    EXPECT_EQ(notes.size(), 101u);
    EXPECT_EQ(notes[0].where, "line 1");
    EXPECT_THAT(notes[0].text, testing::HasSubstr("5 times"));
    EXPECT_THAT(notes.back().text, testing::HasSubstr("901 further words"));
    EXPECT_EQ(notes[0].fate, Note::Fate::left_out);
}

}  // namespace
}  // namespace ghostlight
