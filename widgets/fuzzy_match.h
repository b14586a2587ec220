#pragma once

#include <QString>

#include <optional>

namespace ghostlight {

/// How well `text` answers to what was typed: all its letters in their order, whatever lies
/// between; nothing if one is missing. Larger is better: letters in a row and beginnings of words
/// count, letters in between cost. Words of the pattern may come in any order.
std::optional<int> fuzzy_score(const QString& pattern, const QString& text);

}  // namespace ghostlight
