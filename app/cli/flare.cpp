#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/flare/flare_image.h"
#include "core/io/image_file.h"

namespace ghostlight::cli {
namespace {

struct FlareOptions {
    LensOptions lens;
    LightOptions light{.field = "0"};
    SpectrumOptions spectrum;
    std::string width = "1280", exposure;
    OutputOptions output;  ///< its file is the picture
};

std::string extension_of(const std::string& file) {
    std::string extension = std::filesystem::path(file).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (extension != ".exr" && extension != ".png")
        throw bad_value("--output", file, "a file name that ends in .exr or .png");
    return extension;
}

// Ghosts are 1e-3 to 1e-6 of the light, so a fixed exposure would show black. White is what the
// brightest 0.1 % of the lit pixels reach.
double automatic_exposure_ev(const FlareImage& image) {
    std::vector<float> levels;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) {
        const float level = std::max({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
        if (level > 0.0F) levels.push_back(level);
    }
    if (levels.empty()) return 0.0;
    const auto place =
        levels.begin() + static_cast<std::ptrdiff_t>(levels.size() - 1 - levels.size() / 1000);
    std::nth_element(levels.begin(), place, levels.end());
    return -std::log2(static_cast<double>(*place));
}

void run(const FlareOptions& options) {
    const std::string& file = options.output.file;
    const std::string extension = extension_of(file);
    FlareRequest request;
    request.light = light_direction(options.light);
    request.spectrum = spectrum_of(options.spectrum);
    request.width_px = static_cast<int>(integer_value(
        "--width", options.width, "a whole number of pixels from 16 to 16384", 16, 16384));
    std::optional<double> exposure_ev;
    if (!options.exposure.empty()) {
        if (extension == ".exr")
            throw Error("--exposure: an EXR file holds linear values; the exposure is for .png");
        exposure_ev = number_value("--exposure", options.exposure, "stops from -64 to 64",
                                   [](double ev) { return ev >= -64.0 && ev <= 64.0; });
    }
    const LoadedLens loaded = load_lens(options.lens);
    const FlareImage image = *render_flare(loaded.lens, request);
    if (extension == ".exr") {
        write_exr(image, file);
    } else {
        exposure_ev = exposure_ev.value_or(automatic_exposure_ev(image));
        write_png(image, *exposure_ev, file);
    }

    Report report;
    report.lens = lens_fields(loaded);
    report.request = {{"command", json_string("flare")},
                      {"field_deg", json_value(request.light.field_deg)},
                      {"azimuth_deg", json_value(request.light.azimuth_deg)},
                      {"spectrum", json_string(name(request.spectrum))}};
    report.table.columns = {"file",     "width_px",           "height_px",   "ghosts", "rays",
                            "flux_mm2", "flux_on_sensor_mm2", "exposure_ev", "time_ms"};
    report.table.rows = {
        {file, static_cast<std::int64_t>(image.width_px),
         static_cast<std::int64_t>(image.height_px), static_cast<std::int64_t>(image.ghosts),
         static_cast<std::int64_t>(image.rays), image.flux_mm2, image.flux_on_sensor_mm2,
         exposure_ev ? Cell(*exposure_ev) : Cell(), image.times.total_ms}};
    OutputOptions summary = options.output;
    summary.file.clear();
    write_report(report, summary);
    print_notes(loaded.notes, Note::Severity::warning);
}

}  // namespace

void add_flare(CLI::App& program) {
    const auto options = std::make_shared<FlareOptions>();
    CLI::App* command = program.add_subcommand("flare", "the picture of all ghosts, as EXR or PNG");
    add_lens(*command, options->lens)->required();
    add_text(*command, "-o,--output", options->output.file, "FILE",
             "the picture: .exr (float, linear, over the light's irradiance) or .png")
        ->required();
    add_light(*command, options->light)->capture_default_str();
    add_spectrum(*command, options->spectrum);
    add_text(*command, "--width", options->width, "PX",
             "width, pixels; the height follows from the sensor")
        ->capture_default_str();
    add_text(*command, "--exposure", options->exposure, "EV",
             "PNG: stops above the exposure that shows the light's own irradiance as\nwhite; "
             "default: by the picture");
    CLI::Option* csv = command->add_flag("--csv", options->output.csv, "summary as CSV");
    command->add_flag("--json", options->output.json, "summary as JSON")->excludes(csv);
    command->footer(R"(Examples:
  ghostlight-cli flare tessar_brendel_100_f2.8 --field 15 -o flare.exr
  ghostlight-cli flare tessar_brendel_100_f2.8 --field 15 --azimuth 60 --spectrum D65 \
      --width 1920 --exposure 14 -o flare.png)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
