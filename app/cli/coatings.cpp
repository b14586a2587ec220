#include <fmt/format.h>

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/report.h"
#include "core/io/coating_library.h"

namespace ghostlight::cli {
namespace {

std::int64_t layer_count(const Coating& coating) {
    if (const auto* stack = std::get_if<LayerStack>(&coating))
        return static_cast<std::int64_t>(stack->layers.size());
    return std::holds_alternative<QuarterWave>(coating) ? 1 : 0;
}

void run(const OutputOptions& output) {
    Report report;
    report.request = {{"command", json_string("coatings")}};
    report.table.columns = {"coating", "layers", "design_nm", "substrate_index", "title", "source"};
    auto given = [](double value) { return value > 0.0 ? Cell(value) : Cell(std::monostate{}); };
    for (const LibraryCoating& each : coating_library())
        report.table.rows.push_back({each.name, layer_count(each.coating), given(each.design_nm),
                                     given(each.substrate_index), each.title, each.source});
    write_report(report, output);
}

}  // namespace

void add_coatings(CLI::App& program) {
    const auto output = std::make_shared<OutputOptions>();
    CLI::App* command = program.add_subcommand("coatings", "list the coating library");
    add_output(*command, *output);
    command->footer("Any of the names works in --coating, in coating --library and in lens files.");
    command->callback([output] { run(*output); });
}

}  // namespace ghostlight::cli
