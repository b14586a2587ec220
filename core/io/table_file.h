#pragma once

#include <string>

#include "core/ghosts/ghost_table.h"
#include "core/io/table.h"

namespace ghostlight {

/// Which columns of docs/command-line.md: the first fourteen, or all.
enum class GhostColumns { basic, all };

/// The ghost table, the direct path's row first; a last row "not traced" where ghosts of four
/// reflections are left, whose flux is what they have together at most.
Table ghost_rows(const GhostTable& table, GhostColumns columns = GhostColumns::basic);

/// The same as CSV: round-trip digits, C locale, UTF-8.
std::string ghost_table_csv(const GhostTable& table, GhostColumns columns = GhostColumns::basic);

/// The same as JSON, one object per row.
std::string ghost_table_json(const GhostTable& table, GhostColumns columns = GhostColumns::basic);

}  // namespace ghostlight
