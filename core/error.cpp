#include "core/error.h"

#include <utility>

namespace ghostlight {
namespace {

std::string one_line(const Error::Parts& parts) {
    std::string text;
    if (!parts.file.empty()) text += parts.file + ": ";
    if (!parts.where.empty()) text += parts.where + ": ";
    text += parts.problem;
    if (!parts.found.empty()) text += "; found " + parts.found;
    if (!parts.expected.empty()) text += "; expected " + parts.expected;
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';
    return text;
}

}  // namespace

Error::Error(Parts parts) : std::runtime_error(one_line(parts)), parts_(std::move(parts)) {}

}  // namespace ghostlight
