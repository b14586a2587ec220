#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/flare/image_place.h"
#include "core/flare/light_track.h"
#include "core/flare/planned_flare.h"
#include "core/flare/scene_flare.h"
#include "core/io/frame_sequence.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

struct CompositeOptions {
    std::string in, out, frames, light = "auto", threshold, most = "4", gain = "0", size, folded,
                                 tolerance = "0.005";
    bool clamps = false, only_flare = false, dry = false;
    LensOptions lens;
    SpectrumOptions spectrum;
    OutputOptions output;
};

/// Where no spot of any frame takes less of it, nothing stands out as a light.
constexpr double largest_light = 0.1;

/// What a light does in one frame: its place, and its irradiance in the frame's own unit.
struct FrameLight {
    std::size_t light = 0;  ///< from 0
    double x_px = 0.0, y_px = 0.0;
    std::array<double, 3> e0{};
    double luminance() const { return 0.2126 * e0[0] + 0.7152 * e0[1] + 0.0722 * e0[2]; }
};
using FrameLights = std::map<long, std::vector<FrameLight>>;

std::vector<long> chosen_frames(const CompositeOptions& options, const FramePattern& pattern) {
    if (options.frames.empty()) return frames_of(pattern);
    constexpr auto expected = "FIRST:LAST, whole numbers from 0, such as 1:48";
    const auto parts = split(options.frames, ':');
    if (parts.size() != 2 || pattern.digits == 0)
        throw bad_value("--frames", options.frames, expected);
    const long first = integer_value("--frames", parts[0], expected, 0, 999'999'999);
    const long last = integer_value("--frames", parts[1], expected, first, first + 99'999);
    std::vector<long> numbers;
    for (long n = first; n <= last; ++n) numbers.push_back(n);
    return numbers;
}

void check_size(const LinearPicture& picture, const LinearPicture& first,
                const std::filesystem::path& file) {
    if (picture.width == first.width && picture.height == first.height) return;
    throw Error({.problem = "a frame of another size",
                 .file = file.string(),
                 .where = {},
                 .found = fmt::format("{} × {}", picture.width, picture.height),
                 .expected = fmt::format("{} × {}, as the first", first.width, first.height)});
}

double brightest(const LinearPicture& picture) {
    double most = 0.0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
        most = std::max(most, 0.2126 * static_cast<double>(picture.rgb[i]) +
                                  0.7152 * static_cast<double>(picture.rgb[i + 1]) +
                                  0.0722 * static_cast<double>(picture.rgb[i + 2]));
    return most;
}

/// The lens on a sensor of the frame's shape, and what turns pixels into directions.
class Camera {
   public:
    Camera(const LoadedLens& loaded, const Spectrum& spectrum, int width, int height)
        : lens_(loaded.lens), width_(width), height_(height) {
        lens_.sensor.height_mm = lens_.sensor.width_mm * height / width;
        scene_ = flare_scene(lens_, spectrum);
        place_.emplace(scene_->system());
    }
    double pitch_mm() const { return lens_.sensor.width_mm / width_; }
    const Prescription& lens() const { return lens_; }
    /// The frame is upright: its right is −x, its top −y.
    std::optional<LightDirection> light_at(double x_px, double y_px) const {
        return place_->light_at((0.5 * width_ - x_px) * pitch_mm(),
                                (y_px - 0.5 * height_) * pitch_mm());
    }
    /// Flux / E0 of the direct image, mm².
    double direct_mm2(const LightDirection& light) const {
        FlareRequest request;
        request.light = light;
        request.width_px = width_;
        return (*ghost_spots(*scene_, {GhostPath{}}, request))[0].flux();
    }

   private:
    Prescription lens_;
    int width_, height_;
    std::optional<FlareScene> scene_;
    std::optional<ImagePlace> place_;
};

/// Looks at every frame once for its bright spots, and follows them.
FrameLights detect(const CompositeOptions& options, const FramePattern& pattern,
                   const std::vector<long>& numbers, const LinearPicture& first,
                   const Camera& camera) {
    ProgressLine progress("looking for lights");
    const auto read = [&](long number) {
        LinearPicture picture = read_frame(pattern.file(number), options.clamps);
        check_size(picture, first, pattern.file(number));
        return picture;
    };
    double threshold = 0.0;
    if (!options.threshold.empty()) {
        threshold = number_value("--threshold", options.threshold, "a luminance above 0",
                                 [](double value) { return value > 0.0; });
    } else {
        // The same for all frames, or a light would flicker with others' brightness.
        constexpr double of_brightest = 0.2;
        for (const long number : numbers)
            threshold = std::max(threshold, of_brightest * brightest(read(number)));
    }
    std::vector<std::vector<LightBlob>> blobs;
    bool any_is_small = !options.threshold.empty(), any_is_large = false;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const LinearPicture picture = read(numbers[k]);
        blobs.push_back(find_blobs(picture.rgb, picture.width, picture.height, threshold));
        for (const LightBlob& blob : blobs.back())
            (static_cast<double>(blob.pixels) > largest_light * picture.width * picture.height
                 ? any_is_large
                 : any_is_small) = true;
        progress(static_cast<double>(k + 1) / static_cast<double>(numbers.size()));
    }
    TrackRequest request;
    request.most = static_cast<std::size_t>(
        integer_value("--lights", options.most, "a whole number from 1 to 32", 1, 32));
    request.farthest_px = 0.1 * first.width;
    // A sky or a wall is none, unless somebody says above what there is light.
    const auto tracks = any_is_small ? track_lights(blobs, request) : std::vector<LightTrack>{};
    if (tracks.empty())
        throw Error(
            {.problem = "no light was found",
             .file = options.in,
             .where = {},
             .found =
                 any_is_large
                     ? fmt::format("nothing but spots of more than {:.0f} % of a frame above "
                                   "{:.4g}, a fifth of the brightest pixel",
                                   100.0 * largest_light, threshold)
                     : fmt::format("nothing above {:.4g} in {} frames", threshold, numbers.size()),
             .expected = "a pixel brighter than --threshold, or --light FILE.csv"});
    FrameLights lights;
    for (std::size_t k = 0; k < numbers.size(); ++k)
        for (std::size_t n = 0; n < tracks.size(); ++n) {
            const LightBlob& blob = tracks[n].frames[k];
            FrameLight light{n, blob.x_px, blob.y_px, {}};
            const auto direction = camera.light_at(blob.x_px, blob.y_px);
            const double direct_mm2 = direction ? camera.direct_mm2(*direction) : 0.0;
            // The light's image holds E0 times the direct flux.
            if (direct_mm2 > 0.0)
                for (std::size_t c = 0; c < 3; ++c)
                    light.e0[c] =
                        blob.excess[c] * camera.pitch_mm() * camera.pitch_mm() / direct_mm2;
            lights[numbers[k]].push_back(light);
        }
    return lights;
}

FrameLights read_lights(const std::string& file) {
    constexpr auto expected = "the columns frame, light, x_px, y_px, e0_r, e0_g, e0_b";
    const auto refuse = [&](std::size_t line, std::string problem, std::string found) {
        throw Error({.problem = std::move(problem),
                     .file = file,
                     .where = fmt::format("line {}", line),
                     .found = std::move(found),
                     .expected = expected});
    };
    std::istringstream text(read_input(file));
    constexpr std::array names = {"frame", "light", "x_px", "y_px", "e0_r", "e0_g", "e0_b"};
    std::array<std::size_t, names.size()> columns{};
    FrameLights lights;
    bool header = true;
    std::size_t number = 0;
    for (std::string line; std::getline(text, line);) {
        ++number;
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
        if (line.empty() || line.front() == '#') continue;
        const auto cells = split(line, ',');
        if (header) {
            header = false;
            for (std::size_t k = 0; k < names.size(); ++k) {
                const auto at = std::ranges::find(cells, std::string_view(names[k]));
                if (at == cells.end()) refuse(number, "a column is missing", names[k]);
                columns[k] = static_cast<std::size_t>(at - cells.begin());
            }
            continue;
        }
        std::array<double, names.size()> values{};
        for (std::size_t k = 0; k < names.size(); ++k) {
            const auto value =
                columns[k] < cells.size() ? parse_number(cells[columns[k]]) : std::nullopt;
            if (!value || (k != 2 && k != 3 && *value < 0.0))
                refuse(number, "not a usable value",
                       columns[k] < cells.size() ? std::string(cells[columns[k]].substr(0, 40))
                                                 : "nothing");
            values[k] = *value;
        }
        if (values[1] < 1.0 || values[1] > 32.0) refuse(number, "lights count from 1 to 32", "");
        lights[std::lround(values[0])].push_back({static_cast<std::size_t>(values[1]) - 1,
                                                  values[2],
                                                  values[3],
                                                  {values[4], values[5], values[6]}});
    }
    if (lights.empty()) refuse(number, "no light in the file", "");
    return lights;
}

/// The flare of a frame's lights in the frame's unit, upright.
std::vector<float> flare_of(const std::vector<FrameLight>& lights, const Camera& camera,
                            const Scene& like, const SceneView& view, const FlareRequest& request,
                            int width, int height) {
    FlareImage sum = black_image(camera.lens().sensor, width);
    for (const FrameLight& light : lights) {
        const auto direction = camera.light_at(light.x_px, light.y_px);
        if (!direction || !(light.luminance() > 0.0)) continue;
        Scene scene = like;
        scene.light().direction = *direction;
        const SceneView one{view.lens, scene, view.spectra, view.pattern_of, view.draw};
        const std::array<double, 4> gain = {light.e0[0], light.e0[1], light.e0[2],
                                            light.luminance()};
        std::optional<FlareImage> ghosts;
        if (scene.layers.shows(LayerKind::ghosts)) {
            ghosts = ghosts_layer(one, request);
            add_image(sum, *ghosts, gain);
        }
        if (scene.layers.shows(LayerKind::veil))
            add_image(sum, *veil_layer(one, request, {}, ghosts ? &*ghosts : nullptr), gain);
    }
    return upright_picture(sum.rgb, width, height, 3);
}

void run(const CompositeOptions& options) {
    const FramePattern in = parse_frame_pattern(options.in);
    const FramePattern out = parse_frame_pattern(options.out);
    if ((in.digits > 0) != (out.digits > 0))
        throw bad_value("--out", options.out, "#### where IN has it, and only there");
    const double gain = gain_of_ev(number_value("--gain", options.gain, "stops from -40 to 40",
                                                [](double ev) { return std::abs(ev) <= most_ev; }));
    const std::vector<long> numbers = chosen_frames(options, in);
    for (const long number : numbers)
        if (in.file(number) == out.file(number))
            throw bad_value("--out", options.out, "another name than IN: frames are not replaced");
    const LoadedLens loaded = load_lens(options.lens);
    const Spectrum spectrum =
        options.spectrum.wavelength.empty() && options.spectrum.spectrum.empty()
            ? Spectrum(StandardLight{})
            : spectrum_of(options.spectrum);
    Scene scene;
    scene.light().spectrum = spectrum;
    if (!options.size.empty())
        scene.light().size = read_option("--size", [&] { return parse_light_size(options.size); });
    if (!options.folded.empty()) {
        scene.veil.folded_share =
            number_value("--fold", options.folded, "a share of the ghosts' light from 0 to 0.5",
                         [](double value) { return value >= 0.0 && value <= most_folded_share; });
        scene.layers.of(LayerKind::veil).on = scene.veil.folded_share > 0.0;
    }
    const LinearPicture first = read_frame(in.file(numbers.front()), options.clamps);
    if (first.width < 16 || first.height < 8)
        throw Error({.problem = "the frames are too small",
                     .file = in.file(numbers.front()).string(),
                     .where = {},
                     .found = fmt::format("{} × {}", first.width, first.height),
                     .expected = "16 × 8 or more"});
    const Camera camera(loaded, spectrum, first.width, first.height);
    FlareRequest request;
    request.width_px = first.width;
    request.tolerance = number_value("--tolerance", options.tolerance, "a share from 1e-4 to 0.5",
                                     [](double share) { return share >= 1e-4 && share <= 0.5; });
    CompiledSpectra spectra;
    const PatternOf pattern_of = pattern_of_size;
    const DrawGhosts draw = [](const FlareScene& compiled, const FlareRequest& one,
                               std::stop_token stop) {
        return render_planned(compiled, one, std::move(stop));
    };
    const SceneView view{camera.lens(), scene, spectra, pattern_of, draw};
    const FrameLights lights = options.light == "auto" ? detect(options, in, numbers, first, camera)
                                                       : read_lights(options.light);

    Report report;
    report.lens = lens_fields(loaded);
    report.request = {{"command", json_string("composite")},
                      {"frames", json_value(static_cast<std::int64_t>(numbers.size()))},
                      {"spectrum", json_string(name(spectrum))}};
    report.table.columns = {"frame", "light", "x_px", "y_px",       "field_deg", "azimuth_deg",
                            "e0_r",  "e0_g",  "e0_b", "flare_mean", "file"};
    ProgressLine progress("adding flare");
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const long number = numbers[k];
        const auto found = lights.find(number);
        std::vector<FrameLight> own;
        if (found != lights.end()) own = found->second;
        LinearPicture picture = read_frame(in.file(number), options.clamps);
        check_size(picture, first, in.file(number));
        double mean = 0.0;
        if (!options.dry) {
            const std::vector<float> flare =
                flare_of(own, camera, scene, view, request, picture.width, picture.height);
            for (std::size_t i = 0; i < flare.size(); ++i) {
                const float added = static_cast<float>(gain) * flare[i];
                picture.rgb[i] = options.only_flare ? added : picture.rgb[i] + added;
                mean += static_cast<double>(added) / static_cast<double>(flare.size());
            }
            write_frame(picture, out.file(number));
        }
        for (const FrameLight& light : own) {
            const auto direction = camera.light_at(light.x_px, light.y_px);
            report.table.rows.push_back(
                {static_cast<std::int64_t>(number), static_cast<std::int64_t>(light.light + 1),
                 light.x_px, light.y_px, direction ? Cell(direction->field_deg) : Cell(),
                 direction ? Cell(direction->azimuth_deg) : Cell(), light.e0[0], light.e0[1],
                 light.e0[2], options.dry ? Cell() : Cell(mean),
                 options.dry ? Cell() : Cell(out.file(number).string())});
        }
        progress(static_cast<double>(k + 1) / static_cast<double>(numbers.size()));
    }
    report.heading = fmt::format("{}\n{} frames, {}\n", lens_heading(loaded), numbers.size(),
                                 options.dry ? "nothing written" : "written to " + options.out);
    write_report(report, options.output);
    print_notes(loaded.notes, Note::Severity::warning);
}

}  // namespace

void add_composite(CLI::App& program) {
    const auto options = std::make_shared<CompositeOptions>();
    CLI::App* command = program.add_subcommand(
        "composite", "the flare of a sequence's own lights, added to its frames");
    add_text(*command, "IN", options->in, "",
             "frames, linear: .exr, .hdr or .tif of floats; integers are taken as sRGB;\n#### "
             "stands for their numbers")
        ->required();
    add_lens(*command, options->lens, "--lens")->required();
    add_text(*command, "--out", options->out, "OUT",
             "frames to write: .exr (float), .png or .tif (sRGB, 16 bits)")
        ->required();
    add_text(*command, "--light", options->light, "auto|FILE.csv",
             "auto: found by their brightness and followed; or given, with the columns that\nthis "
             "command prints")
        ->capture_default_str();
    add_text(*command, "--frames", options->frames, "FIRST:LAST", "these only; default: all there");
    add_text(*command, "--threshold", options->threshold, "L",
             "luminance above which a pixel is of a light; default: a fifth of the\nbrightest "
             "pixel of all frames");
    add_text(*command, "--lights", options->most, "N", "at most so many lights")
        ->capture_default_str();
    add_text(*command, "--size", options->size, "SIZE", "of the lights, as in render");
    add_spectrum(*command, options->spectrum);
    add_text(*command, "--fold", options->folded, "SHARE", "as in render");
    add_text(*command, "--gain", options->gain, "EV",
             "stops for the flare: where highlights are clipped their light is too little")
        ->capture_default_str();
    add_text(*command, "--tolerance", options->tolerance, "X", "as in render")
        ->capture_default_str();
    command->add_flag("--clamp", options->clamps,
                      "take negative, infinite and NaN pixels as black");
    command->add_flag("--only-flare", options->only_flare, "write the flare alone");
    command->add_flag("--dry-run", options->dry, "only find the lights and print them");
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli composite shot.####.exr --lens tessar_brendel_100_f2.8 --out flare.####.exr
  ghostlight-cli composite shot.####.exr --lens LENS --dry-run --csv --out x.####.exr > lights.csv
  ghostlight-cli composite shot.####.exr --lens LENS --light lights.csv --out flare.####.exr)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
