#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/options.h"
#include "app/cli/output.h"
#include "core/error.h"
#include "core/freed_memory.h"

namespace ghostlight::cli {
namespace {

constexpr int bad_input = 2;

constexpr auto examples = R"(Examples:
  ghostlight-cli lenses
  ghostlight-cli info tessar_brendel_100_f2.8
  ghostlight-cli ghosts tessar_brendel_100_f2.8 --field 15 --top 10 --paraxial
  ghostlight-cli trace LENS --ghost 5-3 --field 15 --rays rays.csv --csv
  ghostlight-cli coating --stack "1.0 | 1.38:96.4 | 1.5" --wavelengths 400:700:10 --angles 0:80:20
  ghostlight-cli render LENS --field 15 -o flare.exr
  ghostlight-cli starburst LENS --field 5 --f-number 11 --blades 7 -o starburst.png
  ghostlight-cli convert lens.zmx lens.json --report
  ghostlight-cli glasses --nd 1.62 --vd 60

Units: lengths mm, wavelengths nm in standard air, angles degrees; fluxes mm2 (per unit irradiance
of the light). Surfaces count from 1, the stop included; ghost i-j turns first at i, then at j.
Exit status: 0, or 2 with one line on standard error.)";

// CLI11 says of an unknown command only that one is required.
void check_command(const CLI::App& program, const std::vector<std::string>& arguments) {
    constexpr std::array<std::string_view, 3> without_command = {"-h", "--help", "--version"};
    const std::string first = arguments.empty() ? "" : arguments.front();
    if (std::find(without_command.begin(), without_command.end(), first) != without_command.end())
        return;
    std::vector<std::string> names, aliases;
    for (const CLI::App* command : program.get_subcommands({})) {
        names.push_back(command->get_name());
        const auto& others = command->get_aliases();
        aliases.insert(aliases.end(), others.begin(), others.end());
    }
    const auto has = [&](const std::vector<std::string>& list) {
        return std::find(list.begin(), list.end(), first) != list.end();
    };
    if (arguments.empty() || !(has(names) || has(aliases)))
        throw Error({.problem = arguments.empty() ? "no command" : "unknown command",
                     .file = {},
                     .where = {},
                     .found = arguments.empty() ? "" : fmt::format("'{}'", first),
                     .expected = fmt::format("one of {}, or --help", joined(names, ", "))});
}

int run(std::vector<std::string> arguments) {
    CLI::App program("Ghostlight: ghosts and flare of a lens, from its prescription.",
                     "ghostlight-cli");
    program.set_help_flag("-h,--help", "print this help and exit");
    program.set_version_flag("--version", "ghostlight-cli " GHOSTLIGHT_VERSION,
                             "print the version and exit");
    program.require_subcommand(1);
    program.footer(examples);
    program.get_formatter()->column_width(32);
    add_info(program);
    add_trace(program);
    add_coating(program);
    add_ghosts(program);
    add_sweep(program);
    add_check(program);
    add_render(program);
    add_starburst(program);
    add_synth(program);
    add_fit(program);
    add_fit_study(program);
    add_plan(program);
    add_veil(program);
    add_composite(program);
    add_accuracy(program);
    add_stability(program);
    add_lenses(program);
    add_convert(program);
    add_glasses(program);
    add_coatings(program);
    try {
        check_command(program, arguments);
        std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
        program.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        const auto chosen = program.get_subcommands();
        write_standard_output(chosen.empty() ? program.help()
                                             : chosen.front()->help("ghostlight-cli"));
    } catch (const CLI::CallForVersion& version) {
        write_standard_output(std::string(version.what()) + "\n");
    }
    return 0;
}

}  // namespace
}  // namespace ghostlight::cli

int main(int argc, char** argv) {
    using namespace ghostlight::cli;
    prepare_streams();
    ghostlight::keep_freed_memory();
    try {
        return run({argv + std::min(argc, 1), argv + argc});
    } catch (const std::exception& error) {
        // Bad input of every kind: ghostlight::Error, CLI::ParseError, not enough memory for it.
        write_standard_error(fmt::format("ghostlight-cli: {}", error.what()));
        return bad_input;
    }
}
