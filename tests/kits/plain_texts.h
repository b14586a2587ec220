#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ghostlight::test {

/// A string literal of C++ source: what it says, the call that it is an argument of ("" if none)
/// and the line that it begins in, from 1. Literals that follow each other are one.
struct SourceText {
    std::string text;
    std::string call;
    int line = 0;
};

/// All of a source's literals but raw ones and the names of included files.
std::vector<SourceText> source_texts(std::string_view source);

/// Those that people would read, and that no translator is shown: words outside of tr(),
/// translate() and the like.
std::vector<SourceText> plain_texts(std::string_view source);

}  // namespace ghostlight::test
