#include "core/flare/starburst.h"

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/exposure.h"
#include "app/cli/output.h"
#include "app/cli/picture_file.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/flare/mask_raster.h"
#include "core/optics/optical_system.h"

namespace ghostlight::cli {
namespace {

struct StarburstOptions {
    LensOptions lens;
    LightOptions light{.field = "0"};
    SpectrumOptions spectrum;
    std::string width = "1280", exposure, smoothing = "0";
    OutputOptions output;  ///< its file is the picture
};

void run(const StarburstOptions& options) {
    const std::string& file = options.output.file;
    const std::string extension = picture_extension(file);
    StarburstRequest request;
    request.light = light_direction(options.light);
    request.spectrum = spectrum_of(options.spectrum);
    request.width_px = static_cast<int>(integer_value(
        "--width", options.width, "a whole number of pixels from 16 to 16384", 16, 16384));
    request.smoothing_deg =
        number_value("--smoothing", options.smoothing, "an angle from 0 to 90 degrees",
                     [](double deg) { return deg >= 0.0 && deg <= 90.0; });
    std::optional<double> exposure_ev = exposure_value(options.exposure, extension);
    const LoadedLens loaded = load_lens(options.lens);
    const FlareImage image = *render_starburst(loaded.lens, request);
    const FlareOrigin origin{.lens = loaded.lens.name,
                             .configuration = loaded.configuration,
                             .spectrum = name(request.spectrum),
                             .wavelengths_nm = {},
                             .light = request.light};
    if (extension == ".exr") {
        write_exr(image, file, origin);
    } else {
        exposure_ev = exposure_ev.value_or(automatic_exposure_ev(image));
        write_display(image, *exposure_ev, file, origin);
    }

    const OpticalSystem system = compile(loaded.lens, reference_wavelength_nm(request.spectrum));
    const DirectBeam beam = *direct_beam(std::vector<OpticalSystem>{system}, request.light, 0);
    Report report;
    report.lens = lens_fields(loaded);
    report.request = {{"command", json_string("starburst")},
                      {"field_deg", json_value(request.light.field_deg)},
                      {"azimuth_deg", json_value(request.light.azimuth_deg)},
                      {"spectrum", json_string(name(request.spectrum))}};
    report.table.columns = {"file",          "width_px",       "height_px",
                            "blades",        "flux_mm2",       "flux_on_sensor_mm2",
                            "clear_share",   "x_mm",           "y_mm",
                            "first_dark_um", "fresnel_number", "vignetted",
                            "exposure_ev",   "time_ms"};
    // Airy's first zero, of a round stop as wide as this one's circle.
    constexpr double first_zero = 3.8317059702;
    report.table.rows = {{file, static_cast<std::int64_t>(image.width_px),
                          static_cast<std::int64_t>(image.height_px),
                          static_cast<std::int64_t>(loaded.lens.stop.blades), image.flux_mm2,
                          image.flux_on_sensor_mm2,
                          clear_share(system.stop_mask, loaded.lens.stop.dirt), beam.x_mm,
                          beam.y_mm, 1e3 * first_zero * std::abs(beam.radius_per_k_mm),
                          beam.fresnel_number, beam.limits.has_value() ? "yes" : "no",
                          exposure_ev ? Cell(*exposure_ev) : Cell(), image.times.total_ms}};
    OutputOptions summary = options.output;
    summary.file.clear();
    write_report(report, summary);
    print_notes(loaded.notes, Note::Severity::warning);
}

}  // namespace

void add_starburst(CLI::App& program) {
    const auto options = std::make_shared<StarburstOptions>();
    CLI::App* command = program.add_subcommand(
        "starburst", "the direct light as the stop diffracts it, as EXR, PNG or TIFF");
    add_lens(*command, options->lens)->required();
    add_text(*command, "-o,--out,--output", options->output.file, "FILE",
             "the picture: .exr (float, linear, over the light's irradiance), or for looking\n"
             ".png or .tif")
        ->required();
    add_light(*command, options->light)->capture_default_str();
    add_spectrum(*command, options->spectrum);
    add_text(*command, "--width", options->width, "PX",
             "width, pixels; the height follows from the sensor")
        ->capture_default_str();
    add_text(*command, "--exposure", options->exposure, "EV",
             "PNG and TIFF: stops above the exposure that shows the light's own irradiance\nas "
             "white; default: by the picture");
    add_text(*command, "--smoothing", options->smoothing, "DEG",
             "artistic: spreads the pattern around its middle by this angle")
        ->capture_default_str();
    CLI::Option* csv = command->add_flag("--csv", options->output.csv, "summary as CSV");
    command->add_flag("--json", options->output.json, "summary as JSON")->excludes(csv);
    command->footer(R"(Examples:
  ghostlight-cli starburst tessar_brendel_100_f2.8 --field 5 --f-number 11 --blades 7 \
      --spectrum D65 --exposure 8 -o starburst.png
  ghostlight-cli starburst tessar_brendel_100_f2.8 --f-number 8 --blades 6 --dust 0.01 \
      --scratches 20 --dirt-seed 4 --spectrum D65 -o dirty.exr)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
