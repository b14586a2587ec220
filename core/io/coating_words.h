#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/fit/flare_fit.h"

namespace ghostlight {

/// "none", "qw:NM" (MgF2) or "qw:NM:INDEX", or a name of the coating library; nothing for other
/// words. Throws Error where the library's files are wrong.
std::optional<Coating> coating_in_words(std::string_view text);

/// What coating_in_words() reads, for people.
std::string coating_words();

/// Kinds of coating separated by commas, each named by its words; none for an empty text. Throws
/// Error.
std::vector<CoatingKind> parse_kinds(std::string_view text);

/// Surfaces from 1 separated by commas, as rows from 0; none for an empty text. Throws Error for
/// those that a lens of `count` surfaces has not.
std::vector<std::size_t> parse_kind_rows(std::string_view text, std::size_t count);

}  // namespace ghostlight
