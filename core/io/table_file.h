#pragma once

#include <string>

#include "core/ghosts/ghost_table.h"
#include "core/io/table.h"

namespace ghostlight {

/// The ghost table with the columns of docs/command-line.md, the direct path's row first.
Table ghost_rows(const GhostTable& table);

/// The same as CSV: round-trip digits, C locale.
std::string ghost_table_csv(const GhostTable& table);

/// The same as JSON, one object per row.
std::string ghost_table_json(const GhostTable& table);

}  // namespace ghostlight
