#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/photo_options.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/fit/fit_setup.h"
#include "core/io/coating_words.h"
#include "core/io/fit_page.h"
#include "core/io/fit_photos.h"
#include "core/io/photo_file.h"

namespace ghostlight::cli {
namespace {

struct FitOptions {
    LensOptions lens;
    SpectrumOptions spectrum{.wavelength = {}, .spectrum = "D65"};
    PhotoOptions photos;
    std::string vary, out, page, left_out, only,
        loss = "cauchy", scale = "4", error = "0.3", across = "96", kinds, kind_rows, profile,
        bootstrap = "0", background = "3", starts = "6", suggest = "4", seed = "1";
    bool fixed_place = false;
    OutputOptions output;
};

double positive(std::string_view option, std::string_view text, std::string_view expected) {
    return number_value(option, text, expected, [](double value) { return value > 0.0; });
}

void run(const FitOptions& options) {
    const LoadedLens loaded = load_lens(options.lens);
    Notes notes = loaded.notes;
    FitRequest request;
    SpectrumOptions spectrum = options.spectrum;
    if (!spectrum.wavelength.empty()) spectrum.spectrum.clear();
    request.spectrum = spectrum_of(spectrum);
    request.vary = read_option("--vary", [&] { return parse_vary(options.vary, loaded.lens); });
    request.loss = read_option("--loss", [&] { return parse_loss(options.loss); });
    request.loss_scale = positive("--loss-scale", options.scale, "standard deviations above 0");
    request.model_error =
        0.01 * number_value("--model-error", options.error, "percent from 0 to 50",
                            [](double value) { return value >= 0.0 && value <= 50.0; });
    request.across = static_cast<int>(
        integer_value("--samples", options.across, "samples across, 16 to 512", 16, 512));
    request.background_terms =
        static_cast<int>(integer_value("--background", options.background, "0, 1, 3 or 6", 0, 6));
    request.starts = static_cast<int>(
        integer_value("--starts", options.starts, "a whole number from 1 to 100", 1, 100));
    request.suggestions = static_cast<std::size_t>(
        integer_value("--suggest", options.suggest, "a whole number from 0 to 50", 0, 50));
    request.seed = static_cast<std::uint64_t>(
        integer_value("--seed", options.seed, "a whole number from 0", 0, 1'000'000'000));
    request.fit_place = !options.fixed_place;
    read_option("--leave-out", [&] { ghosts_left_out(options.left_out, {}, loaded.lens); });
    request.left_out = read_option("--use-ghosts", [&] {
        return ghosts_left_out(options.left_out, options.only, loaded.lens);
    });
    request.profiled = read_option(
        "--profile", [&] { return profiled_in(options.profile, request.vary, loaded.lens); });
    request.bootstrap = static_cast<int>(
        integer_value("--bootstrap", options.bootstrap, "a whole number from 0 to 1000", 0, 1000));
    FitSetup setup = photo_setup_of(options.photos);
    const std::vector<FitPhoto> photos = read_fit_photos(setup, loaded.lens, notes, read_photo);
    if (!options.kinds.empty())
        for (const auto part : split(options.kinds, ','))
            request.kinds.push_back(
                {std::string(part), read_option("--kinds", [&] { return parse_coating(part); })});
    request.kind_rows = read_option("--kind-rows", [&] {
        return parse_kind_rows(options.kind_rows, loaded.lens.surfaces.size());
    });

    ProgressLine progress("fitting");
    const FitReport report = *fit_flare(loaded.lens, photos, request, {},
                                        [&](double share, double) { progress(share); });
    setup.vary = options.vary;
    setup.spectrum = name(request.spectrum);
    setup.left_out = options.left_out;
    setup.only = options.only;
    setup.kinds = options.kinds;
    setup.kind_rows = options.kind_rows;
    setup.profiled = options.profile;
    setup.bootstrap = request.bootstrap;
    setup.loss = request.loss;
    setup.loss_scale = request.loss_scale;
    setup.seed = request.seed;
    const std::string command = fit_command(setup, options.lens.lens);
    if (!options.out.empty()) {
        Prescription fitted = report.lens.lens;
        fitted.notes += fmt::format("{}Fitted to photographs of its flare: {}",
                                    fitted.notes.empty() ? "" : "\n", report.verdict);
        write_lens(fitted, options.out);
        if (!(report.lens.stop == StopPlace{}))
            notes.push_back(
                {Note::Severity::warning, options.out,
                 fmt::format("a lens file has no decentre of the stop: {:.4g}, {:.4g} mm "
                             "is in the report alone",
                             report.lens.stop.x_mm, report.lens.stop.y_mm)});
    }
    if (!options.page.empty())
        write_file_safely(options.page, fit_page(report, lens_heading(loaded), command));

    Report answer;
    answer.lens = lens_fields(loaded);
    answer.request = {{"command", json_string("fit")},
                      {"photo", json_string(options.photos.files)},
                      {"light", json_string(options.photos.lights)},
                      {"vary", json_string(options.vary)},
                      {"seed", json_string(options.seed)},
                      {"verdict", json_string(report.verdict)},
                      {"usable", report.usable ? "true" : "false"},
                      {"chi2", json_value(report.chi2)},
                      {"residuals", json_value(static_cast<std::int64_t>(report.residuals))},
                      {"explained", json_value(report.explained_after)},
                      {"outliers", json_value(report.outliers)},
                      {"error_scale", json_value(report.error_scale)},
                      {"rank", json_value(static_cast<std::int64_t>(report.rank))},
                      {"iterations", json_value(static_cast<std::int64_t>(report.iterations))},
                      {"correlation",
                       [&] {
                           std::string text = "[";
                           for (const double each : report.correlation)
                               text += (text.size() > 1 ? ", " : "") + json_value(each);
                           return text + "]";
                       }()},
                      {"loss", json_string(name(report.loss))},
                      {"loss_scale", json_value(report.loss_scale)},
                      {"intervals", table_json(fit_interval_table(report))},
                      {"kinds", table_json(fit_kind_table(report))},
                      {"ghosts", table_json(fit_ghost_table(report))}};
    answer.heading = fmt::format("{}\n{}", lens_heading(loaded), report.verdict);
    for (const std::string& remark : report.remarks) answer.heading += "\n" + remark;
    if (!report.suggestions.empty()) {
        const Suggestion& best = report.suggestions.front();
        answer.heading += fmt::format(
            "\nThe next photograph that would help most: light at {:.3g} degrees ({}: standard "
            "error "
            "{:.3g} -> {:.3g} {})",
            best.light.field_deg, name(report.numbers[best.number].parameter), best.error_now,
            best.error_then, unit(report.numbers[best.number].parameter));
    }
    answer.table = fit_table(report);
    write_report(answer, options.output);
    print_notes(notes, Note::Severity::warning);
}

}  // namespace

void add_fit(CLI::App& program) {
    const auto options = std::make_shared<FitOptions>();
    CLI::App* command = program.add_subcommand(
        "fit", "coatings and elements that explain photographs of flare, with error bars");
    add_lens(*command, options->lens)->required();
    add_photos(*command, options->photos);
    add_text(*command, "--vary", options->vary, "SPEC",
             "KIND@ROWS[=LOWER..UPPER][~SIGMA], comma list; KIND: center, thickness, layer.N,\n"
             "layer-index.N, reflectance, radius, gap, index, semi-diameter, and stop-size,\n"
             "stop-x, stop-y, stop-rotation without rows; ROWS: 3, 2+5 (one common value), all")
        ->required();
    add_spectrum(*command, options->spectrum);
    add_text(*command, "--out", options->out, "FILE", "the fitted lens");
    add_text(*command, "--report", options->page, "FILE", "an HTML page with pictures");
    add_text(*command, "--leave-out", options->left_out, "GHOSTS",
             "ghosts that do not count: 5-3,7-2");
    add_text(*command, "--use-ghosts", options->only, "GHOSTS", "the only ones that count");
    add_text(*command, "--kinds", options->kinds, "LIST",
             "choose each surface's kind of coating from these and the listed one, strongest\n"
             "surfaces first: none, qw:NM[:INDEX] or names of the coating library");
    add_text(*command, "--kind-rows", options->kind_rows, "ROWS",
             "surfaces whose kind is chosen: 1,3,6; default: those whose coating is varied");
    add_text(*command, "--profile", options->profile, "SPEC",
             "profile likelihood of these numbers of --vary: center@3,center@5");
    add_text(*command, "--bootstrap", options->bootstrap, "N",
             "fits to N photographs drawn from the fitted model and its errors")
        ->capture_default_str();
    command->add_flag("--fixed-place", options->fixed_place,
                      "light, shift and rotation are exact, not fitted");
    add_text(*command, "--loss", options->loss, "NAME", "none, huber, cauchy or tukey")
        ->capture_default_str();
    add_text(*command, "--loss-scale", options->scale, "X", "of the loss, standard deviations")
        ->capture_default_str();
    add_text(*command, "--model-error", options->error, "PERCENT",
             "relative error of the model on a sample")
        ->capture_default_str();
    add_text(*command, "--samples", options->across, "N", "samples over the sensor's width")
        ->capture_default_str();
    add_text(*command, "--background", options->background, "N",
             "polynomials of the background: 0, 1, 3 or 6")
        ->capture_default_str();
    add_text(*command, "--starts", options->starts, "N", "first guesses of the coatings")
        ->capture_default_str();
    add_text(*command, "--suggest", options->suggest, "N",
             "light angles tried for the next photograph")
        ->capture_default_str();
    add_text(*command, "--seed", options->seed, "N", "of the first guesses")->capture_default_str();
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli fit LENS --photo flare.exr --vary center@all --out fitted.json --report fit.html
  ghostlight-cli fit LENS --photo a.exr,b.exr --light "auto;812,440" --vary center@1+2,radius@3~0.2%)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
