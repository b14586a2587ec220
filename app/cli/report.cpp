#include "app/cli/report.h"

#include <fmt/format.h>

#include "app/cli/output.h"
#include "core/io/lens_file.h"

namespace ghostlight::cli {
namespace {

std::string json_object(const JsonFields& fields) {
    if (fields.empty()) return "null";
    std::string text = "{";
    for (const auto& [name, value] : fields)
        text += (text.size() > 1 ? ", " : "") + json_string(name) + ": " + value;
    return text + "}";
}

}  // namespace

void add_output(CLI::App& command, OutputOptions& options) {
    constexpr auto group = "Output";
    auto* csv = command.add_flag("--csv", options.csv, "CSV, every digit")->group(group);
    command.add_flag("--json", options.json, "JSON, every digit")->excludes(csv)->group(group);
    add_text(command, "--output", options.file, "FILE", "write to a file, not to standard output")
        ->group(group);
}

JsonFields lens_fields(const LoadedLens& loaded) {
    return {{"name", json_string(loaded.lens.name)},
            {"file", json_string(loaded.file.string())},
            {"configuration",
             loaded.configuration.empty() ? "null" : json_string(loaded.configuration)}};
}

std::string lens_heading(const LoadedLens& loaded) {
    return loaded.configuration.empty()
               ? loaded.lens.name
               : fmt::format("{}, {}", loaded.lens.name, loaded.configuration);
}

void write_report(const Report& report, const OutputOptions& options) {
    if (options.json) {
        write_text(fmt::format("{{\n\"program\": \"ghostlight-cli " GHOSTLIGHT_VERSION
                               "\",\n\"lens\": {},\n"
                               "\"request\": {},\n\"rows\": {}\n}}\n",
                               json_object(report.lens), json_object(report.request),
                               table_json(report.table)),
                   options);
    } else if (options.csv) {
        write_text(table_csv(report.table), options);
    } else {
        write_text(
            report.heading + (report.heading.empty() ? "" : "\n\n") + table_text(report.table),
            options);
    }
}

void write_text(std::string_view text, const OutputOptions& options) {
    if (options.file.empty() || options.file == "-")
        write_standard_output(text);
    else
        write_file_safely(options.file, text);
}

void print_notes(const Notes& notes, Note::Severity least) {
    for (const Note& note : notes) {
        if (note.severity < least) continue;
        write_standard_error(fmt::format("{}: {}{}{}", severity_name(note.severity), note.where,
                                         note.where.empty() ? "" : ": ", note.text));
    }
}

}  // namespace ghostlight::cli
