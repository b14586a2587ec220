#include "core/error.h"

#include <utility>

namespace ghostlight {
namespace {

/// Files may hold words of a megabyte; what is quoted of them is cut, whole characters only.
std::string cut(const std::string& text) {
    constexpr std::size_t longest = 1000;
    if (text.size() <= longest) return text;
    std::size_t end = longest;
    // A character's later bytes are 10xxxxxx.
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
    return text.substr(0, end) + "…";
}

std::string one_line(const Error::Parts& parts) {
    std::string text;
    if (!parts.file.empty()) text += parts.file + ": ";
    if (!parts.where.empty()) text += cut(parts.where) + ": ";
    text += cut(parts.problem);
    if (!parts.found.empty()) text += "; found " + cut(parts.found);
    if (!parts.expected.empty()) text += "; expected " + parts.expected;
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';
    return text;
}

}  // namespace

Error::Error(Parts parts) : std::runtime_error(one_line(parts)), parts_(std::move(parts)) {}

}  // namespace ghostlight
