#pragma once

#include <string>
#include <string_view>

namespace ghostlight {

/// True when the names differ in nothing but the case of their ASCII letters.
bool is_same_name(std::string_view a, std::string_view b);

/// ASCII letters in capitals.
std::string upper_case(std::string_view text);

}  // namespace ghostlight
