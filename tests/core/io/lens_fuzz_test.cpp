#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "core/error.h"
#include "core/io/lens_file.h"

namespace ghostlight {
namespace {

std::vector<std::string> lens_texts() {
    std::vector<std::string> texts;
    for (const char* folder : {GHOSTLIGHT_LENS_DIR, GHOSTLIGHT_TEST_DATA_DIR "/listings"})
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (entry.path().extension() == ".json") {
                std::ostringstream text;
                text << std::ifstream(entry.path()).rdbuf();
                texts.push_back(text.str());
            }
    return texts;
}

/// Either it is a lens, which can be written and read again, or there is one Error.
void read_or_refuse(const std::string& text) {
    try {
        const Prescription lens = lens_from_json(text, "fuzz").lens;
        const std::string written = lens_to_json(lens);
        EXPECT_EQ(lens_from_json(written, "again").lens, lens) << written;
    } catch (const Error& error) {
        EXPECT_EQ(error.parts().file, "fuzz") << error.what();
    }
}

TEST(LensFuzz, CutAnywhere) {
    for (const std::string& text : lens_texts())
        for (std::size_t end = 0; end < text.size(); end += 37) read_or_refuse(text.substr(0, end));
}

TEST(LensFuzz, BytesChanged) {
    std::mt19937 random(20);
    const auto below = [&](std::size_t limit) { return random() % limit; };
    constexpr std::string_view likely = "0123456789-.eE\"{}[],: ntfNI\\";
    for (const std::string& text : lens_texts())
        for (int round = 0; round < 150; ++round) {
            std::string changed = text;
            for (std::size_t count = 1 + below(3); count > 0; --count)
                changed[below(changed.size())] =
                    round % 2 == 0 ? likely[below(likely.size())] : static_cast<char>(below(256));
            read_or_refuse(changed);
        }
}

/// Each value replaced in turn by things of other kinds.
TEST(LensFuzz, ValuesReplaced) {
    const char* others[] = {"null", "true", "\"x\"", "-1", "0", "1e300", "[]", "{}", "[[1]]"};
    for (const std::string& text : lens_texts()) {
        std::size_t which = 0;
        for (auto at = text.find(": "); at != text.npos; at = text.find(": ", at + 1)) {
            const auto end = text.find_first_of(",}\n", at);
            if (end == text.npos) break;
            std::string changed = text;
            changed.replace(at + 2, end - at - 2, others[which++ % std::size(others)]);
            read_or_refuse(changed);
        }
    }
}

}  // namespace
}  // namespace ghostlight
