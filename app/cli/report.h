#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/cli/options.h"
#include "core/io/import_report.h"
#include "core/io/table.h"

namespace ghostlight::cli {

/// In which form an answer goes where.
struct OutputOptions {
    bool csv = false, json = false;
    std::string file;  ///< empty or "-" for standard output
};
void add_output(CLI::App& command, OutputOptions& options);

/// Named values; the second is already JSON.
using JsonFields = std::vector<std::pair<std::string, std::string>>;
JsonFields lens_fields(const LoadedLens& loaded);

/// A command's answer.
struct Report {
    JsonFields lens;      ///< empty: null, no lens was involved
    JsonFields request;   ///< what was asked, as understood
    std::string heading;  ///< above the table in its form for people
    Table table;
};
void write_report(const Report& report, const OutputOptions& options);

/// Readable text goes out as it is; for a command whose form for people is not a plain table.
void write_text(std::string_view text, const OutputOptions& options);

/// What a reader noticed, one line each on standard error: all of it, or warnings only.
void print_notes(const Notes& notes, Note::Severity least);

/// "name, f-number …" lines would be noise: the lens, its configuration and the light in one line.
std::string lens_heading(const LoadedLens& loaded);

}  // namespace ghostlight::cli
