#pragma once

#include <string>

#include "core/fit/flare_fit.h"
#include "core/io/table.h"

namespace ghostlight {

/// The fitted numbers, one a row.
Table fit_table(const FitReport& report);
/// The visible ghosts, one a row.
Table fit_ghost_table(const FitReport& report);

/// Profiles and bootstrap of the numbers that they were asked of.
Table fit_interval_table(const FitReport& report);
/// Kinds of coating that were tried, surface by surface, the best first.
Table fit_kind_table(const FitReport& report);

/// One self-contained HTML page: verdict, numbers, pictures, residuals, ghosts, reflectances,
/// correlations, what is not determined, settings.
std::string fit_page(const FitReport& report, const std::string& lens, const std::string& command);

}  // namespace ghostlight
