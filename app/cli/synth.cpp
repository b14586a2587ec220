#include <fmt/format.h>

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/fit/light_place.h"
#include "core/fit/synthetic_photo.h"
#include "core/io/photo_file.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

struct SynthOptions {
    LensOptions lens;
    LightOptions light{.field = "0"};
    SpectrumOptions spectrum{.wavelength = {}, .spectrum = "D65"};
    std::string width = "720", tolerance = "0.01", exposure = "auto", gains = "1,1,1",
                shading = "0", noise = "0", read_noise = "0", background = "0", offset = "0,0",
                bits, seed = "1";
    std::string file;
};

double share_value(std::string_view option, std::string_view text) {
    return number_value(option, text, "a number from 0 to 1",
                        [](double value) { return value >= 0.0 && value <= 1.0; });
}

std::vector<double> numbers(std::string_view option, std::string_view text, std::size_t count,
                            std::string_view expected) {
    std::vector<double> values;
    for (const std::string_view part : split(text, ',')) {
        const auto value = parse_number(part);
        if (!value) throw bad_value(option, text, expected);
        values.push_back(*value);
    }
    if (values.size() != count) throw bad_value(option, text, expected);
    return values;
}

void run(const SynthOptions& options) {
    const PhotoFormat format = read_option("--out", [&] { return photo_format(options.file); });
    SyntheticPhotoRequest request;
    request.light = light_direction(options.light);
    SpectrumOptions spectrum = options.spectrum;
    if (!spectrum.wavelength.empty()) spectrum.spectrum.clear();
    request.spectrum = spectrum_of(spectrum);
    request.width_px = static_cast<int>(integer_value(
        "--width", options.width, "a whole number of pixels from 16 to 16384", 16, 16384));
    request.tolerance = number_value("--tolerance", options.tolerance, "a number from 1e-5 to 0.5",
                                     [](double value) { return value >= 1e-5 && value <= 0.5; });
    if (options.exposure != "auto")
        request.exposure_ev =
            number_value("--exposure", options.exposure, "auto, or stops from -64 to 64",
                         [](double ev) { return ev >= -64.0 && ev <= 64.0; });
    const auto gains =
        numbers("--gains", options.gains, 3, "three numbers R,G,B such as 0.5,1,0.7");
    for (const double gain : gains)
        if (!(gain > 0.0)) throw bad_value("--gains", options.gains, "three numbers above 0");
    request.gains = {gains[0], gains[1], gains[2]};
    request.shading = share_value("--shading", options.shading);
    request.noise = share_value("--noise", options.noise);
    request.read_noise = share_value("--read-noise", options.read_noise);
    request.background = share_value("--background", options.background);
    const auto offset =
        numbers("--offset", options.offset, 2, "two angles in degrees FIELD,AZIMUTH");
    request.field_offset_deg = offset[0];
    request.azimuth_offset_deg = offset[1];
    request.bits = options.bits.empty()
                       ? format.bits
                       : static_cast<int>(integer_value("--bits", options.bits, "8 or 16", 8, 16));
    request.srgb = format.srgb;
    request.seed = static_cast<std::uint64_t>(
        integer_value("--seed", options.seed, "a whole number from 0", 0, 1'000'000'000));

    const LoadedLens loaded = load_lens(options.lens);
    Photo photo = *synthetic_photo(loaded.lens, request);
    const OpticalSystem system = compile(loaded.lens, d_line_nm);
    const FirstOrder first = first_order(system);
    photo.exposure_s = 0.01;
    photo.f_number = first.f_number;
    photo.focal_length_mm = first.efl_mm;
    photo.camera = "Ghostlight synthetic";
    write_photo(photo, request.bits, options.file);

    std::string text = fmt::format(
        "{}: {} x {} pixels, {}, {}, field {} deg, azimuth {} deg, seed {}\n", options.file,
        photo.width_px, photo.height_px,
        request.bits == 0
            ? std::string("32-bit float, linear")
            : fmt::format("{} bits, {}", request.bits, format.srgb ? "sRGB" : "linear"),
        name(request.spectrum), request.light.field_deg, request.light.azimuth_deg, request.seed);
    if (const auto at = image_of_light(system, request.light)) {
        const double pitch_mm = loaded.lens.sensor.width_mm / photo.width_px;
        // Upright: the picture's right is -x, its top is -y.
        text += fmt::format("the light's image: {:.2f},{:.2f} px from the upper left corner\n",
                            0.5 * photo.width_px - at->x_mm / pitch_mm,
                            0.5 * photo.height_px + at->y_mm / pitch_mm);
    }
    write_standard_output(text);
    print_notes(loaded.notes, Note::Severity::warning);
}

}  // namespace

void add_synth(CLI::App& program) {
    const auto options = std::make_shared<SynthOptions>();
    CLI::App* command = program.add_subcommand(
        "synth", "a photograph of a light through a lens, for trying out fits");
    add_lens(*command, options->lens)->required();
    add_light(*command, options->light)->capture_default_str();
    add_spectrum(*command, options->spectrum);
    add_text(*command, "--out,-o", options->file, "FILE",
             "float EXR or 16-bit TIFF (linear), PNG or JPEG (sRGB)")
        ->required();
    add_text(*command, "--width", options->width, "PX", "of the photograph, pixels")
        ->capture_default_str();
    add_text(*command, "--tolerance", options->tolerance, "X",
             "L1 error of the reference picture over its light")
        ->capture_default_str();
    add_text(*command, "--exposure", options->exposure, "EV|auto",
             "log2 of the value of the light's own irradiance, 1 being saturation; auto: the\n"
             "brightest thousandth of the flare at half of saturation")
        ->capture_default_str();
    add_text(*command, "--gains", options->gains, "R,G,B", "white balance of the camera")
        ->capture_default_str();
    add_text(*command, "--shading", options->shading, "X",
             "share of the light that is missing in the corners, as the radius squared")
        ->capture_default_str();
    add_text(*command, "--noise", options->noise, "X",
             "shot noise: sigma over signal of a pixel at saturation (Poisson), 0.01 is 1 %")
        ->capture_default_str();
    add_text(*command, "--read-noise", options->read_noise, "X",
             "sigma of a dark pixel, 1 being saturation")
        ->capture_default_str();
    add_text(*command, "--background", options->background, "X",
             "a uniform glow, 1 being saturation")
        ->capture_default_str();
    add_text(*command, "--offset", options->offset, "FIELD,AZIMUTH",
             "degrees by which the light is really elsewhere")
        ->capture_default_str();
    add_text(*command, "--bits", options->bits, "8|16", "of PNG and TIFF; default 8 and 16");
    add_text(*command, "--seed", options->seed, "N", "of the noise")->capture_default_str();
    command->footer(R"(Examples:
  ghostlight-cli synth tessar_brendel_100_f2.8 --field 8 --noise 0.01 --out photo.exr
  ghostlight-cli synth LENS --field 5 --gains 0.5,1,0.7 --noise 0.02 --seed 7 --out photo.png)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
