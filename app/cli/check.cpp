#include <fmt/format.h>

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/report.h"
#include "core/ghosts/lens_check.h"

namespace ghostlight::cli {
namespace {

struct CheckOptions {
    LensOptions lens;
    OutputOptions output;
};

const char* name_of(Note::Severity severity) {
    switch (severity) {
        case Note::Severity::error:
            return "error";
        case Note::Severity::warning:
            return "warning";
        case Note::Severity::info:
            break;
    }
    return "info";
}

void run(const CheckOptions& options) {
    const LoadedLens loaded = load_lens(options.lens);
    Table table;
    table.columns = {"severity", "surface", "cell", "finding", "proposal"};
    for (const Finding& finding : check_lens(loaded.lens))
        table.rows.push_back(
            {std::string(name_of(finding.severity)),
             finding.surface ? Cell(static_cast<std::int64_t>(*finding.surface + 1)) : Cell(),
             *name_of(finding.cell) != 0 ? Cell(std::string(name_of(finding.cell))) : Cell(),
             finding.text, finding.proposal.empty() ? Cell() : Cell(finding.proposal)});
    const std::size_t count = table.rows.size();
    write_report({.lens = lens_fields(loaded),
                  .request = {{"command", json_string("check")}},
                  .heading = fmt::format("{}: {} finding{}", lens_heading(loaded), count,
                                         count == 1 ? "" : "s"),
                  .table = std::move(table)},
                 options.output);
}

}  // namespace

void add_check(CLI::App& program) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command =
        program.add_subcommand("check", "what is suspicious in a lens, surface by surface");
    add_lens(*command, options->lens)->required();
    add_output(*command, options->output);
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
