#pragma once

#include <string>
#include <vector>

#include "core/flare/accuracy.h"
#include "core/io/log_chart_svg.h"
#include "core/io/table.h"

namespace ghostlight {

/// One lens with one light and one stop, measured.
struct AccuracyCase {
    std::string heading;  ///< the lens and its configuration, for people
    std::string short_name, configuration, file;
    std::size_t surfaces = 0;
    double field_deg = 0.0, closed_stops = 0.0;
    AccuracyReport report;
};

/// What the pages say of a run beside its numbers.
struct AccuracyRun {
    std::string command, spectrum, machine, date;
    std::vector<AccuracyCase> cases;
};

/// The lens, its field and how far it is stopped down.
std::string title_of(const AccuracyCase& one);
/// A share in percent to three digits, without the sign; a dash where it is not known.
std::string percent_text(double share);

/// One row a point of a case; tidy, every digit.
Table accuracy_rows(const AccuracyRun& run);
/// One row a ghost by a method.
Table ghost_accuracy_rows(const AccuracyRun& run);

/// Error against time of a case.
LogChart error_time_chart(const AccuracyCase& one);
/// The error asked of the plan against the one it has, all cases.
LogChart promise_chart(const AccuracyRun& run);

/// How often the plan kept what it was asked, over the cases where that can be told.
struct Promises {
    std::size_t kept = 0, broken = 0, unresolved = 0;
    /// Cases in which the plan's own account, with the reference's error, covers the true error.
    std::size_t accounted = 0, counted = 0;
};
Promises promises_of(const AccuracyRun& run);

/// Least median time of a method within an error, ms; infinite where none of its points is.
double time_within_ms(const AccuracyReport& report, const std::string& method, double error);

/// A self-contained page with charts and tables.
std::string accuracy_html(const AccuracyRun& run);
/// What the same says in words and tables, for docs/.
struct MarkdownSettings {
    std::string chart_folder = ".";  ///< where the charts' files are, from the page
    std::string name = "accuracy";   ///< of the page: its chart of promises is NAME_promised.svg
    bool case_charts = true;         ///< a chart for each case
};
std::string accuracy_markdown(const AccuracyRun& run, const MarkdownSettings& settings);

/// The name of a case's chart, without a folder.
std::string chart_file(const AccuracyCase& one);

}  // namespace ghostlight
