#include "core/io/same_name.h"

#include <algorithm>

namespace ghostlight {
namespace {

// Not std::toupper, which depends on the locale.
char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

}  // namespace

bool is_same_name(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, {}, capital, capital);
}

std::string upper_case(std::string_view text) {
    std::string capitals(text);
    std::ranges::transform(capitals, capitals.begin(), capital);
    return capitals;
}

}  // namespace ghostlight
