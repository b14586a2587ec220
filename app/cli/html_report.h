#pragma once

#include <string>

#include "app/cli/ghost_states.h"
#include "app/cli/report.h"
#include "core/ghosts/ghost_table.h"

namespace ghostlight::cli {

/// What a page is made of.
struct HtmlReport {
    const GhostState* state = nullptr;
    const GhostTable* ghosts = nullptr;  ///< all of them
    std::size_t shown = 0;               ///< rows of the table; 0 = all
    std::string command;                 ///< as it was typed
    JsonFields settings;                 ///< named values, as JSON
};

/// One self-contained HTML page: lens, layout, reflectances, ghosts, sums, picture, settings.
std::string html_report(const HtmlReport& report);

}  // namespace ghostlight::cli
