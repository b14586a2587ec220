#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/fit/fit_setup.h"
#include "core/io/fit_page.h"
#include "core/io/photo_file.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

struct FitOptions {
    LensOptions lens;
    SpectrumOptions spectrum{.wavelength = {}, .spectrum = "D65"};
    std::string photos, lights = "auto", vary, out, page, masks, principal, rotation = "0",
                        width_mm, left_out, loss = "cauchy", scale = "4", error = "0.3",
                        across = "96", kinds, kind_rows, background = "3", starts = "6",
                        suggest = "4", seed = "1";
    bool fixed_place = false, merge = false;
    OutputOptions output;
};

double positive(std::string_view option, std::string_view text, std::string_view expected) {
    return number_value(option, text, expected, [](double value) { return value > 0.0; });
}

/// "X,Y" in pixels from the upper left corner, as the sensor's frame has it.
std::pair<double, double> pixel(std::string_view option, std::string_view text,
                                const Photo& photo) {
    const auto parts = split(text, ',');
    const auto x = parse_number(parts.front()), y = parse_number(parts.back());
    if (parts.size() != 2 || !x || !y)
        throw bad_value(option, text,
                        "auto, X,Y in pixels from the upper left corner, or deg:FIELD:AZIMUTH");
    // Upright pictures are mirrored left to right against the sensor's frame.
    return {photo.width_px - *x, *y};
}

FitLoss loss_of(const std::string& text) {
    for (const FitLoss each : {FitLoss::none, FitLoss::huber, FitLoss::cauchy, FitLoss::tukey})
        if (name(each) == text) return each;
    throw bad_value("--loss", text, "none, huber, cauchy or tukey");
}

std::string command_line(const FitOptions& options) {
    return fmt::format("fit {} --photo {} --light {} --vary {} --seed {}", options.lens.lens,
                       options.photos, options.lights, options.vary, options.seed);
}

void run(const FitOptions& options) {
    const LoadedLens loaded = load_lens(options.lens);
    Notes notes = loaded.notes;
    FitRequest request;
    SpectrumOptions spectrum = options.spectrum;
    if (!spectrum.wavelength.empty()) spectrum.spectrum.clear();
    request.spectrum = spectrum_of(spectrum);
    request.vary = read_option("--vary", [&] { return parse_vary(options.vary, loaded.lens); });
    request.loss = loss_of(options.loss);
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
    if (!options.left_out.empty())
        for (const auto part : split(options.left_out, ',')) {
            read_option("--leave-out",
                        [&] { return parse_ghost(part, compile(loaded.lens, d_line_nm)); });
            request.left_out.emplace_back(part);
        }

    if (!options.kinds.empty())
        for (const auto part : split(options.kinds, ','))
            request.kinds.push_back(
                {std::string(part), read_option("--kinds", [&] { return parse_coating(part); })});
    if (!options.kind_rows.empty())
        for (const auto part : split(options.kind_rows, ','))
            request.kind_rows.push_back(static_cast<std::size_t>(
                integer_value("--kind-rows", std::string(part),
                              fmt::format("surfaces 1 to {}", loaded.lens.surfaces.size()), 1,
                              static_cast<std::int64_t>(loaded.lens.surfaces.size())) -
                1));

    const auto files = split(options.photos, ',');
    // Places are X,Y: lights of several photographs are separated by semicolons.
    const auto lights = split(options.lights, ';');
    if (lights.size() != 1 && lights.size() != files.size())
        throw bad_value("--light", options.lights,
                        "one place, or one for each photograph, separated by semicolons");
    const std::vector<std::string_view> masks =
        options.masks.empty() ? std::vector<std::string_view>{} : split(options.masks, ',');
    if (!masks.empty() && masks.size() != 1 && masks.size() != files.size())
        throw bad_value("--photo-mask", options.masks, "one picture, or one for each photograph");
    const OpticalSystem system = compile(loaded.lens, d_line_nm);
    std::vector<Photo> pictures;
    for (const auto file : files) pictures.push_back(read_photo(std::filesystem::path(file)));
    for (const Photo& each : pictures)
        notes.insert(notes.end(), each.notes.begin(), each.notes.end());
    if (options.merge) {
        Photo one = merged(pictures);
        pictures.assign(1, std::move(one));
    }
    std::vector<FitPhoto> photos;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        FitPhoto& photo = photos.emplace_back();
        photo.photo = std::move(pictures[i]);
        photo.place.sensor_width_mm =
            options.width_mm.empty()
                ? loaded.lens.sensor.width_mm
                : positive("--photo-width", options.width_mm, "the picture's width in mm");
        if (options.width_mm.empty()) check_shape(photo.photo, loaded.lens);
        photo.place.axis_column = 0.5 * photo.photo.width_px;
        photo.place.axis_row = 0.5 * photo.photo.height_px;
        if (!options.principal.empty())
            std::tie(photo.place.axis_column, photo.place.axis_row) =
                pixel("--principal", options.principal, photo.photo);
        photo.place.rotation_rad =
            rad_from_deg(number_value("--rotation", options.rotation, "degrees from -180 to 180",
                                      [](double value) { return std::abs(value) <= 180.0; }));
        if (!masks.empty())
            mask_by_file(photo.photo, std::filesystem::path(masks[masks.size() == 1 ? 0 : i]));
        const double f_number = first_order(system).f_number;
        if (photo.photo.f_number && std::abs(*photo.photo.f_number / f_number - 1.0) > 0.05)
            notes.push_back({Note::Severity::warning, photo.photo.file,
                             fmt::format("taken at f/{:.3g}, the lens stands at f/{:.3g}; give "
                                         "--f-number {:.3g}",
                                         *photo.photo.f_number, f_number, *photo.photo.f_number)});
        const std::string light(lights[lights.size() == 1 ? 0 : i]);
        read_option("--light", [&] { place_light(light, system, photo, notes); });
    }

    ProgressLine progress("fitting");
    const FitReport report = *fit_flare(loaded.lens, photos, request, {},
                                        [&](double share, double) { progress(share); });
    const std::string command = command_line(options);
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
                      {"photo", json_string(options.photos)},
                      {"light", json_string(options.lights)},
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
    add_text(*command, "--photo", options->photos, "F[,F...]",
             "EXR, TIFF, PNG, JPEG or RAW, one or several angles of the light")
        ->required();
    add_text(*command, "--vary", options->vary, "SPEC",
             "KIND@ROWS[=LOWER..UPPER][~SIGMA], comma list; KIND: center, thickness, layer.N,\n"
             "layer-index.N, reflectance, radius, gap, index, semi-diameter, and stop-size,\n"
             "stop-x, stop-y, stop-rotation without rows; ROWS: 3, 2+5 (one common value), all")
        ->required();
    add_text(*command, "--light", options->lights, "auto|X,Y|deg:F:A",
             "where its image is: found, pixels from the upper left corner, or a direction;\n"
             "one for all photographs or one each, separated by semicolons")
        ->capture_default_str();
    add_spectrum(*command, options->spectrum);
    add_text(*command, "--out", options->out, "FILE", "the fitted lens");
    add_text(*command, "--report", options->page, "FILE", "an HTML page with pictures");
    add_text(*command, "--photo-mask", options->masks, "F[,F...]",
             "pictures, bright where not to look");
    command->add_flag("--merge", options->merge,
                      "the photographs are exposures of one scene: merge them first");
    add_text(*command, "--photo-width", options->width_mm, "MM",
             "width of a cropped picture on the sensor; default: the sensor's");
    add_text(*command, "--principal", options->principal, "X,Y",
             "the axis in the picture, pixels; default: its middle");
    add_text(*command, "--rotation", options->rotation, "DEG", "of the camera about the axis")
        ->capture_default_str();
    add_text(*command, "--leave-out", options->left_out, "GHOSTS",
             "ghosts that do not count: 5-3,7-2");
    add_text(*command, "--kinds", options.kinds, "LIST",
             "choose each surface's kind of coating from these and the listed one, strongest\n"
             "surfaces first: none, qw:NM[:INDEX] or names of the coating library");
    add_text(*command, "--kind-rows", options.kind_rows, "ROWS",
             "surfaces whose kind is chosen: 1,3,6; default: those whose coating is varied");
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
