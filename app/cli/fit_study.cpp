#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/fit_study_cases.h"
#include "app/cli/options.h"
#include "app/cli/output.h"
#include "core/elapsed.h"
#include "core/io/lens_file.h"

namespace ghostlight::cli {
namespace {

struct FitStudyOptions {
    std::string folder, draws = "50", seed = "1", only;
    bool quick = false;
};

struct Part {
    const char* key;
    StudySection (*run)(const StudyRequest&);
};
constexpr Part parts[] = {
    {"coverage", study_coverage},
    {"radii", study_radii},
    {"undetermined", study_undetermined},
    {"clutter", study_clutter},
    {"wrong-lens", study_wrong_lens},
    {"derivatives", study_derivatives},
    {"kinds", study_kinds},
    {"speed", study_speed},
};

void run(const FitStudyOptions& options) {
    StudyRequest request;
    request.quick = options.quick;
    request.draws = static_cast<int>(
        integer_value("--draws", options.draws, "a whole number from 1 to 10000", 1, 10000));
    request.seed = static_cast<std::uint64_t>(
        integer_value("--seed", options.seed, "a whole number from 0", 0, 1'000'000'000));
    request.folder = options.folder;
    std::filesystem::create_directories(request.folder);
    std::vector<std::string> wanted;
    if (!options.only.empty())
        for (const auto part : split(options.only, ',')) {
            if (std::ranges::none_of(parts, [&](const Part& each) { return part == each.key; }))
                throw bad_value(
                    "--only", part,
                    "coverage, radii, undetermined, clutter, wrong-lens, derivatives, kinds, "
                    "speed");
            wanted.emplace_back(part);
        }
    std::string markdown = fmt::format(
        "# What fits to flare photographs have shown\n\n`ghostlight-cli fit-study{}{} --draws {} "
        "--seed {}`, {:%Y-%m-%d}\n",
        options.quick ? " --quick" : "", options.only.empty() ? "" : " --only " + options.only,
        request.draws, request.seed,
        fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
    for (const Part& part : parts) {
        if (!wanted.empty() && std::ranges::find(wanted, part.key) == wanted.end()) continue;
        const auto began = Clock::now();
        StudySection section;
        {
            ProgressLine progress(part.key);
            request.progress = [&](double share) { progress(share); };
            section = part.run(request);
        }
        write_file_safely(request.folder / (section.key + ".csv"), table_csv(section.table));
        std::string text = fmt::format("\n## {}\n\n{}\n", section.title, section.text);
        for (const std::string& each : section.pictures)
            text += fmt::format("\n![{0}]({0})\n", each);
        text += fmt::format("\n{:.0f} s.\n", 1e-3 * ms_since(began));
        markdown += text;
        write_standard_output(text);
        // What is done is kept, should the next part take too long.
        write_file_safely(request.folder / "fit-study.md", markdown);
    }
}

}  // namespace

void add_fit_study(CLI::App& program) {
    const auto options = std::make_shared<FitStudyOptions>();
    CLI::App* command = program.add_subcommand(
        "fit-study", "what fits to photographs can and cannot do, on made photographs");
    add_text(*command, "--out,-o", options->folder, "DIR",
             "folder for fit-study.md, tables, the fits' pages and pictures")
        ->required();
    add_text(*command, "--draws", options->draws, "N", "of the noise, for the intervals' coverage")
        ->capture_default_str();
    add_text(*command, "--seed", options->seed, "N", "of the first draw")->capture_default_str();
    add_text(*command, "--only", options->only, "LIST",
             "coverage, radii, undetermined, clutter, wrong-lens, derivatives, kinds, "
             "speed");
    command->add_flag("--quick", options->quick,
                      "small photographs, looser references, two lenses for derivatives");
    command->footer(R"(Examples:
  ghostlight-cli fit-study --out out/fit-study
  ghostlight-cli fit-study --quick --draws 3 --out out/fit-study)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
