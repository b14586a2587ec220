#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/instruction_set.h"
#include "core/io/accuracy_page.h"
#include "core/optics/paraxial.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

struct AccuracyOptions {
    std::vector<std::string> lenses;
    std::string config, field, field_share, closed = "0", azimuth = "90";
    SpectrumOptions spectrum;
    std::string width, reference, budget, folder, chart_folder = ".", name = "accuracy";
    bool quick = false, brief = false;
};

/// Where nothing is said: part of the way to the sensor's corner.
constexpr double usual_field_share = 0.4;

double field_deg_at(const Prescription& lens, double share) {
    const double efl_mm = std::abs(first_order(compile(lens, d_line_nm)).efl_mm);
    const double corner_mm = 0.5 * std::hypot(lens.sensor.width_mm, lens.sensor.height_mm);
    const double field_deg = share * deg_from_rad(std::atan(corner_mm / efl_mm));
    return 0.1 * std::round(10.0 * field_deg);
}

Prescription closed(Prescription lens, double stops) {
    if (stops == 0.0) return lens;
    const double open_mm = compile(lens, d_line_nm).stop_mask.semi_diameter_mm;
    lens.stop.f_number.reset();
    lens.stop.semi_diameter_mm = open_mm * std::exp2(-0.5 * stops);
    return lens;
}

/// "model name : …" of /proc/cpuinfo, or nothing where there is no such file.
std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name") && line.find(": ") != std::string::npos)
            return line.substr(line.find(": ") + 2);
    return "unknown processor";
}

/// Work waiting for the processor in the last minute, as Linux counts it; times of a busy machine
/// are long.
std::string load() {
    std::ifstream file("/proc/loadavg");
    std::string one_minute;
    return file >> one_minute ? ", load " + one_minute : "";
}

std::string today() {
    return fmt::format(
        "{:%Y-%m-%d}",
        fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

void run(const AccuracyOptions& options) {
    AccuracyRequest request;
    request.spectrum = spectrum_of(options.spectrum);
    request.width_px = options.quick ? 320 : 1280;
    if (!options.width.empty())
        request.width_px = static_cast<int>(integer_value(
            "--width", options.width, "a whole number of pixels from 16 to 4096", 16, 4096));
    request.reference_tolerance = options.quick ? 0.02 : 0.005;
    if (!options.reference.empty())
        request.reference_tolerance =
            number_value("--reference", options.reference, "a share from 1e-4 to 0.5",
                         [](double share) { return share >= 1e-4 && share <= 0.5; });
    request.budget_s = options.quick ? 10.0 : 60.0;
    if (!options.budget.empty())
        request.budget_s = number_value("--budget", options.budget, "seconds from 0.1 to 100000",
                                        [](double s) { return s >= 0.1 && s <= 1e5; });
    if (options.quick) {
        request.most_repeats = 5;
        request.ghosts = 2;
    }
    request.light.azimuth_deg = number_value("--azimuth", options.azimuth, "an angle in degrees",
                                             [](double) { return true; });
    std::vector<double> fields_deg;
    if (!options.field.empty())
        fields_deg = list_value("--field", options.field, "angles in degrees from -90 to 90",
                                [](double deg) { return deg >= -90.0 && deg <= 90.0; });
    std::vector<double> field_shares{usual_field_share};
    if (!options.field_share.empty()) {
        if (!options.field.empty())
            throw Error("--field-share: fields are given as --field or as shares, not as both");
        field_shares = list_value("--field-share", options.field_share, "shares from 0 to 1",
                                  [](double share) { return share >= 0.0 && share <= 1.0; });
    }
    const auto closings = list_value("--closed", options.closed, "stops from 0 to 12",
                                     [](double stops) { return stops >= 0.0 && stops <= 12.0; });
    const std::filesystem::path folder = options.folder;
    std::filesystem::create_directories(folder);

    AccuracyRun all{
        .command = "ghostlight-cli accuracy",
        .spectrum = name(request.spectrum),
        .machine = fmt::format("{}, {} threads, {}, compiler {}{}", processor(),
                               default_thread_count(), instruction_set_name(), __VERSION__, load()),
        .date = today(),
        .cases = {}};
    for (const std::string& lens : options.lenses) all.command += " " + lens;
    auto add_option = [&](const char* option, const std::string& value) {
        if (!value.empty()) all.command += fmt::format(" {} {}", option, value);
    };
    add_option("--config", options.config);
    add_option("--field", options.field);
    add_option("--field-share", options.field_share);
    if (options.closed != "0") add_option("--closed", options.closed);
    if (options.azimuth != "90") add_option("--azimuth", options.azimuth);
    add_option("--wavelength", options.spectrum.wavelength);
    add_option("--spectrum", options.spectrum.spectrum);
    add_option("--width", options.width);
    add_option("--reference", options.reference);
    add_option("--budget", options.budget);
    if (options.quick) all.command += " --quick";
    add_option("--out", options.folder);

    for (const std::string& lens : options.lenses) {
        LensOptions which;
        which.lens = lens;
        which.config = options.config;
        const LoadedLens loaded = load_lens(which);
        print_notes(loaded.notes, Note::Severity::warning);
        std::vector<double> fields = fields_deg;
        if (fields.empty())
            for (const double share : field_shares)
                fields.push_back(field_deg_at(loaded.lens, share));
        for (const double field : fields)
            for (const double stops : closings) {
                AccuracyCase one{.heading = lens_heading(loaded),
                                 .short_name = loaded.file.stem().string(),
                                 .configuration = loaded.configuration,
                                 .file = loaded.file.string(),
                                 .surfaces = loaded.lens.surfaces.size(),
                                 .field_deg = field,
                                 .closed_stops = stops,
                                 .report = {}};
                request.light.field_deg = field;
                ProgressLine progress(fmt::format("{} at {:.4g} deg", one.short_name, field));
                one.report =
                    measure_accuracy(closed(loaded.lens, stops), request, {},
                                     [&](double share, const std::string&) { progress(share); })
                        .value();
                all.cases.push_back(std::move(one));
            }
    }

    const Table rows = accuracy_rows(all);
    const std::string& called = options.name;
    write_file_safely(folder / (called + ".csv"), table_csv(rows));
    write_file_safely(folder / "ghosts.csv", table_csv(ghost_accuracy_rows(all)));
    for (const AccuracyCase& one : all.cases)
        write_file_safely(folder / chart_file(one), log_chart_svg(error_time_chart(one)));
    write_file_safely(folder / (called + "_promised.svg"), log_chart_svg(promise_chart(all)));
    write_file_safely(folder / (called + ".html"), accuracy_html(all));
    write_file_safely(folder / (called + ".md"),
                      accuracy_markdown(all, {.chart_folder = options.chart_folder,
                                              .name = called,
                                              .case_charts = !options.brief}));

    Table shown = select_columns(rows, {"lens", "field_deg", "method", "setting", "median_ms",
                                        "relative_l1", "energy", "resolved", "on_front"});
    const Promises promises = promises_of(all);
    write_standard_output(
        table_text(shown) +
        fmt::format("\nThe plan kept its tolerance in {} of {} cases; {} are not resolved.\n"
                    "{}: {}.csv, ghosts.csv, {}.html, {}.md and charts\n",
                    promises.kept, promises.kept + promises.broken, promises.unresolved,
                    folder.string(), called, called, called));
}

}  // namespace

void add_accuracy(CLI::App& program) {
    const auto options = std::make_shared<AccuracyOptions>();
    CLI::App* command = program.add_subcommand(
        "accuracy", "error against run time of every way to draw the ghosts, measured");
    command->add_option("LENS", options->lenses, "lens files or names of bundled lenses")
        ->required();
    add_text(*command, "--out", options->folder, "DIR",
             "folder for accuracy.csv, ghosts.csv, accuracy.html, accuracy.md and charts")
        ->required();
    add_text(*command, "--config", options->config, "NAME", "position of a zoom");
    add_text(*command, "--field", options->field, "LIST", "angles of the light, degrees");
    add_text(*command, "--field-share", options->field_share, "LIST",
             "instead, shares of the angle of the sensor's corner; default 0.4");
    add_text(*command, "--azimuth", options->azimuth, "DEG",
             "direction of the field around the axis, degrees")
        ->capture_default_str();
    add_text(*command, "--closed", options->closed, "LIST",
             "measure with the stop closed by so many stops")
        ->capture_default_str();
    add_spectrum(*command, options->spectrum);
    add_text(*command, "--width", options->width, "PX", "of the pictures; default 1280");
    add_text(*command, "--reference", options->reference, "X",
             "what the reference may err by, a share of the light; default 0.005");
    add_text(*command, "--budget", options->budget, "SECONDS",
             "for the timed frames of a lens and field, the reference not among them;\nsettings "
             "that would go beyond it are left out; default 60");
    add_text(*command, "--name", options->name, "NAME",
             "of the files: NAME.csv, NAME.html, NAME.md, NAME_promised.svg")
        ->capture_default_str();
    command->add_flag("--brief", options->brief, "accuracy.md without a chart for each case");
    add_text(*command, "--chart-folder", options->chart_folder, "DIR",
             "where accuracy.md expects the charts")
        ->capture_default_str();
    command->add_flag("--quick", options->quick,
                      "320 pixels, the reference at 2 %, 10 s of timed frames");
    command->footer(R"(Examples:
  ghostlight-cli accuracy tessar_brendel_100_f2.8 --quick --out accuracy
  ghostlight-cli accuracy nikon_zoom_80_200_f2.8 --config tele --field 2,6 --closed 0,4 --out zoom)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
