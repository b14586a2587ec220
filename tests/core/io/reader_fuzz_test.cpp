#include "tests/kits/reader_fuzz.h"

#include <gtest/gtest.h>

namespace ghostlight {
namespace {

constexpr double longest_s = 2.0;  ///< for one file, of this thread's own time

void expect_fine(const FuzzedReader& reader, const std::string& bytes, const std::string& what) {
    const double begin_s = thread_seconds();
    try {
        read_fuzzed(reader, bytes);
    } catch (const FuzzDefect& defect) {
        ADD_FAILURE() << reader.name << ", " << what << ": " << defect.what;
    }
    EXPECT_LT(thread_seconds() - begin_s, longest_s) << reader.name << ", " << what;
}

/// Each reader reads its own samples: else the rest would test nothing.
TEST(ReaderFuzz, SamplesAreRead) {
    for (const FuzzedReader& reader : fuzzed_readers()) {
        ASSERT_FALSE(reader.samples.empty()) << reader.name;
        for (const std::string& sample : reader.samples)
            EXPECT_EQ(read_fuzzed(reader, sample), FuzzOutcome::read) << reader.name;
    }
}

/// A slice of what ./dev fuzz does for hours.
TEST(ReaderFuzz, MutatedFiles) {
    constexpr std::uint64_t count = 250;
    for (const FuzzedReader& reader : fuzzed_readers())
        for (std::uint64_t number = 0; number < count; ++number)
            expect_fine(reader, mutated(reader, number), std::to_string(number));
}

TEST(ReaderFuzz, CutAnywhere) {
    constexpr std::size_t step = 13;
    for (const FuzzedReader& reader : fuzzed_readers())
        for (const std::string& sample : reader.samples)
            for (std::size_t end = 0; end < std::min<std::size_t>(sample.size(), 3000); end += step)
                expect_fine(reader, sample.substr(0, end), "cut at " + std::to_string(end));
}

TEST(ReaderFuzzSlow, CutAtEveryByte) {
    for (const FuzzedReader& reader : fuzzed_readers())
        for (std::size_t end = 0; end < reader.samples.front().size(); ++end)
            expect_fine(reader, reader.samples.front().substr(0, end),
                        "cut at " + std::to_string(end));
}

/// Ten megabytes of a sample again and again, of one character, of nested brackets, of junk.
TEST(ReaderFuzzSlow, TenMegabytes) {
    constexpr std::size_t size = std::size_t{10} << 20;
    for (const FuzzedReader& reader : fuzzed_readers()) {
        std::string again, words;
        while (again.size() < size) again += reader.samples.front();
        expect_fine(reader, again, "repeated");
        for (std::size_t i = 0; words.size() < size; ++i) words += "W" + std::to_string(i) + " 1\n";
        expect_fine(reader, reader.samples.front() + words, "strange words behind");
        expect_fine(reader, words + reader.samples.front(), "strange words before");
        for (const std::string_view piece :
             {"1", " ", "\n", "\t", "[", "{\"a\":", "<a>", "\"", "\xff", "1 ", "1 1 1 1\n", "NXT\n",
              "[lens data]\n", "{},"}) {
            std::string many;
            many.reserve(size + piece.size());
            while (many.size() < size) many += piece;
            expect_fine(reader, many, "ten megabytes of " + std::string(piece));
            expect_fine(reader, reader.samples.front() + many, "and behind a sample");
            if (piece == "{},")
                expect_fine(reader, "{\"lens_elements\": [" + many, "and in an array");
        }
    }
}

}  // namespace
}  // namespace ghostlight
