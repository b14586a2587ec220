#include <fmt/format.h>

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "core/io/formats.h"
#include "core/io/import_report.h"
#include "core/io/imported_lens.h"
#include "core/io/lens_file.h"
#include "core/io/read_text.h"
#include "core/io/unfolded_ghost.h"
#include "core/optics/mend.h"

namespace ghostlight::cli {
namespace {

struct ConvertOptions {
    std::string in, out, config, scale, ghost;
    bool report = false, halve = false, invert = false;
    OutputOptions output;
};

void append(Table& table, std::string_view step, const Notes& notes) {
    for (const Note& note : notes)
        table.rows.push_back({std::string(step), note.where, std::string(fate_name(note.fate)),
                              std::string(severity_name(note.severity)),
                              std::string(note.matters_for_flare ? "yes" : "no"), note.text,
                              note.proposal});
}

Prescription mended(Prescription lens, const ConvertOptions& options) {
    if (options.invert) lens = sized_again(with_radii_as_curvatures(lens));
    if (options.halve) lens = with_halved_semi_diameters(lens);
    if (!options.scale.empty())
        lens = scaled(lens, number_value("--scale", options.scale, "a factor above 0",
                                         [](double factor) { return factor > 0.0; }));
    return lens;
}

std::string format_name(const std::filesystem::path& file) {
    const std::string text = utf8_text(read_text(file));
    return std::string(format_of({text, file}).name);
}

void run(const ConvertOptions& options) {
    if (options.out.empty() && !options.report)
        throw bad_value("OUT", "nothing", "a file to write, or --report alone");
    const std::filesystem::path in = find_lens(options.in);
    const LensFile file = read_lens(in);
    Prescription lens = mended(file.lens, options);
    if (!options.config.empty())
        lens = read_option("--config", [&] { return configured(lens, options.config); });
    Notes exported;
    std::string written_as;
    if (!options.out.empty()) {
        const LensFormat& format = writable_format(options.out);
        written_as = format.name;
        validate(lens);
        const std::string text =
            options.ghost.empty() ? format.write(lens, exported) : read_option("--ghost", [&] {
                return unfolded_ghost(lens, options.ghost, options.out, exported);
            });
        write_file_safely(options.out, text);
    } else if (!options.ghost.empty()) {
        throw bad_value("OUT", "nothing", "a .zmx to write the ghost to");
    }
    if (!options.report) {
        print_notes(file.notes, Note::Severity::warning);
        print_notes(exported, Note::Severity::warning);
        return;
    }
    if (!options.output.csv && !options.output.json) {
        std::string text = fmt::format("import: {} ({}): {}\n{}", in.string(), format_name(in),
                                       lens.name, notes_text(file.notes));
        if (!options.out.empty())
            text +=
                fmt::format("export: {} ({})\n{}", options.out, written_as, notes_text(exported));
        text += "* matters for flare   ! has to be mended before the lens can be traced\n";
        write_text(text, options.output);
        return;
    }
    Report report;
    report.lens = {{"name", json_string(lens.name)},
                   {"file", json_string(in.string())},
                   {"format", json_string(format_name(in))}};
    report.request = {{"command", json_string("convert")},
                      {"out", options.out.empty() ? "null" : json_string(options.out)}};
    report.table.columns = {"step", "where",   "fate", "severity", "matters_for_flare",
                            "text", "proposal"};
    append(report.table, "import", file.notes);
    append(report.table, "export", exported);
    write_report(report, options.output);
}

}  // namespace

void add_convert(CLI::App& program) {
    const auto options = std::make_shared<ConvertOptions>();
    CLI::App* command = program.add_subcommand("convert", "a lens from one file format to another");
    add_text(*command, "IN", options->in, "", "a lens file, or the name of a bundled lens")
        ->required();
    add_text(*command, "OUT", options->out, "",
             "file to write; its extension says the format: .json, .zmx, .seq, .lens");
    command->add_flag("--report", options->report,
                      "say what became of each thing in the file; OUT may then be missing");
    add_text(*command, "--config", options->config, "NAME",
             "write this zoom or focus position alone");
    add_text(*command, "--ghost", options->ghost, "I-J",
             "write the light's way along this ghost, unfolded, as a .zmx with mirrors");
    constexpr auto mending = "Mending what a report proposes";
    add_text(*command, "--scale", options->scale, "F", "every length times F")->group(mending);
    command
        ->add_flag("--halve-semi-diameters", options->halve,
                   "the file's semi-diameters are diameters")
        ->group(mending);
    command
        ->add_flag("--radii-are-curvatures", options->invert,
                   "the file's radii are curvatures, or the reverse")
        ->group(mending);
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli convert lens.zmx lens.json --report
  ghostlight-cli convert lens.seq --report --csv
  ghostlight-cli convert tessar_brendel_100_f2.8 ghost.zmx --ghost 5-3)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
