#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/exposure.h"
#include "app/cli/method_option.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/flare/flare_image.h"
#include "core/ghosts/ghost_table.h"
#include "core/io/image_file.h"

namespace ghostlight::cli {
namespace {

struct RenderOptions {
    LensOptions lens;
    LightOptions light{.field = "0"};
    SpectrumOptions spectrum;
    MethodOptions method;
    std::string width = "1280", exposure, per_ghost;
    OutputOptions output;  ///< its file is the picture
};

std::string extension_of(const std::string& file) {
    std::string extension = std::filesystem::path(file).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (extension != ".exr" && extension != ".png" && extension != ".tif" && extension != ".tiff")
        throw bad_value("--output", file, "a file name that ends in .exr, .png, .tif or .tiff");
    return extension;
}

/// The ghosts that bring the most light to the sensor, and each one's picture.
struct GhostLayers {
    std::vector<std::string> names;
    std::vector<FlareImage> images;
};

GhostLayers layers_of(const Prescription& lens, const FlareRequest& request, std::size_t count) {
    // Ranking needs no more than this.
    GhostTableRequest ranking{
        .light = request.light, .spectrum = request.spectrum, .tolerance = 0.05, .peaks = false};
    GhostLayers layers;
    ProgressLine progress("tracing ghosts");
    GhostTable table = *ghost_table(lens, ranking, {}, [&](double share) { progress(share); });
    std::stable_sort(table.ghosts.begin(), table.ghosts.end(),
                     [](const GhostRow& a, const GhostRow& b) {
                         return a.flux_mm2 * a.on_sensor > b.flux_mm2 * b.on_sensor;
                     });
    for (const GhostRow& ghost : table.ghosts) {
        if (layers.names.size() == count || !(ghost.flux_mm2 * ghost.on_sensor > 0.0)) break;
        FlareRequest one = request;
        one.only = {ghost.path};
        layers.names.push_back("ghost." + name(ghost.path, table.surface_count));
        layers.images.push_back(*render_flare(lens, one));
    }
    return layers;
}

/// Most wavelengths that a ghost of the picture was drawn at.
int wavelengths_of(const FlareRequest& request, const FlareImage& image) {
    switch (request.method) {
        case FlareMethod::planned:
        case FlareMethod::paraxial:
            return FlareScene::usual_samples;
        case FlareMethod::uniform:
            return request.spectral_samples;
        case FlareMethod::reference:
            break;
    }
    int most = 1;
    for (const PlannedGhost& ghost : image.plan.ghosts) most = std::max(most, ghost.bands);
    return most;
}

FlareOrigin origin_of(const LoadedLens& loaded, const FlareRequest& request,
                      const FlareImage& image) {
    FlareOrigin origin{.lens = loaded.lens.name,
                       .configuration = loaded.configuration,
                       .spectrum = name(request.spectrum),
                       .wavelengths_nm = {},
                       .light = request.light};
    for (const SpectralSample& each : sample(request.spectrum, wavelengths_of(request, image)))
        origin.wavelengths_nm.push_back(each.wavelength_nm);
    return origin;
}

void run(const RenderOptions& options) {
    const std::string& file = options.output.file;
    const std::string extension = extension_of(file);
    FlareRequest request;
    request.light = light_direction(options.light);
    request.spectrum = spectrum_of(options.spectrum);
    set_method(options.method, request);
    request.width_px = static_cast<int>(integer_value(
        "--width", options.width, "a whole number of pixels from 16 to 16384", 16, 16384));
    std::optional<double> exposure_ev;
    if (!options.exposure.empty()) {
        if (extension == ".exr")
            throw Error(
                "--exposure: an EXR file holds linear values; the exposure is for .png and .tif");
        exposure_ev = number_value("--exposure", options.exposure, "stops from -64 to 64",
                                   [](double ev) { return ev >= -64.0 && ev <= 64.0; });
    }
    std::size_t per_ghost = 0;
    if (!options.per_ghost.empty()) {
        if (extension != ".exr") throw Error("--per-ghost: only an EXR file has layers");
        per_ghost = static_cast<std::size_t>(integer_value("--per-ghost", options.per_ghost,
                                                           "a whole number from 1 to 300", 1, 300));
    }
    const LoadedLens loaded = load_lens(options.lens);
    // With layers the same grids for all, so that the layers add up to the picture.
    if (per_ghost > 0 && request.method == FlareMethod::planned)
        request.method = FlareMethod::uniform;
    const FlareImage image = *render_flare(loaded.lens, request);
    const FlareOrigin origin = origin_of(loaded, request, image);
    GhostLayers layers;
    if (per_ghost > 0) layers = layers_of(loaded.lens, request, per_ghost);
    if (extension == ".exr") {
        std::vector<FlareLayer> named;
        for (std::size_t k = 0; k < layers.names.size(); ++k)
            named.push_back({layers.names[k], &layers.images[k]});
        write_exr(image, file, origin, named);
    } else {
        exposure_ev = exposure_ev.value_or(automatic_exposure_ev(image));
        write_display(image, *exposure_ev, file, origin);
    }

    Report report;
    report.lens = lens_fields(loaded);
    report.request = {{"command", json_string("render")},
                      {"field_deg", json_value(request.light.field_deg)},
                      {"azimuth_deg", json_value(request.light.azimuth_deg)},
                      {"spectrum", json_string(name(request.spectrum))}};
    report.table.columns = {"file",     "width_px",           "height_px",   "ghosts",  "rays",
                            "flux_mm2", "flux_on_sensor_mm2", "exposure_ev", "time_ms", "layers",
                            "method",   "estimated_error"};
    report.table.rows = {
        {file, static_cast<std::int64_t>(image.width_px),
         static_cast<std::int64_t>(image.height_px), static_cast<std::int64_t>(image.ghosts),
         static_cast<std::int64_t>(image.rays), image.flux_mm2, image.flux_on_sensor_mm2,
         exposure_ev ? Cell(*exposure_ev) : Cell(), image.times.total_ms,
         layers.names.empty() ? Cell() : Cell(joined(layers.names, " ")),
         std::string(method_name(request.method)),
         image.plan.ghosts.empty() ? Cell() : Cell(image.plan.estimated_error())}};
    OutputOptions summary = options.output;
    summary.file.clear();
    write_report(report, summary);
    print_notes(loaded.notes, Note::Severity::warning);
}

}  // namespace

void add_render(CLI::App& program) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        program.add_subcommand("render", "the picture of all ghosts, as EXR, PNG or TIFF");
    command->alias("flare");  // its name in version 0.1
    add_lens(*command, options->lens)->required();
    add_text(*command, "-o,--out,--output", options->output.file, "FILE",
             "the picture: .exr (float, linear, over the light's irradiance), or for looking\n"
             ".png or .tif")
        ->required();
    add_light(*command, options->light)->capture_default_str();
    add_spectrum(*command, options->spectrum);
    add_method(*command, options->method);
    add_text(*command, "--width", options->width, "PX",
             "width, pixels; the height follows from the sensor")
        ->capture_default_str();
    add_text(*command, "--exposure", options->exposure, "EV",
             "PNG and TIFF: stops above the exposure that shows the light's own irradiance\nas "
             "white; default: by the picture");
    add_text(*command, "--per-ghost", options->per_ghost, "N",
             "EXR: a layer ghost.I-J for each of the N ghosts that bring the most light to\n"
             "the sensor");
    CLI::Option* csv = command->add_flag("--csv", options->output.csv, "summary as CSV");
    command->add_flag("--json", options->output.json, "summary as JSON")->excludes(csv);
    command->footer(R"(Examples:
  ghostlight-cli render tessar_brendel_100_f2.8 --field 15 -o flare.exr --per-ghost 5
  ghostlight-cli render tessar_brendel_100_f2.8 --field 15 --azimuth 60 --spectrum D65 \
      --width 1920 --exposure 14 -o flare.png)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
