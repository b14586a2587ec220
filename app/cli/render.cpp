#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/exposure.h"
#include "app/cli/method_option.h"
#include "app/cli/output.h"
#include "app/cli/picture_file.h"
#include "app/cli/report.h"
#include "app/cli/scene_options.h"
#include "app/cli/spectrum_option.h"
#include "core/flare/flare_image.h"
#include "core/flare/planned_flare.h"
#include "core/flare/scene_flare.h"
#include "core/ghosts/ghost_table.h"
#include "core/io/image_file.h"
#include "core/io/scene_pictures.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

struct RenderOptions {
    LensOptions lens;
    SceneOptions scene;
    MethodOptions method;
    std::string width = "1280", exposure, per_ghost;
    bool ringing = false;
    std::string only;
    OutputOptions output;  ///< its file is the picture
};

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

/// The layers of the scene that are seen, each on its own.
struct SceneLayers {
    std::vector<LayerKind> kinds;
    std::vector<FlareImage> images;

    const FlareImage* find(LayerKind kind) const {
        const auto found = std::ranges::find(kinds, kind);
        return found == kinds.end() ? nullptr
                                    : &images[static_cast<std::size_t>(found - kinds.begin())];
    }
};

SceneLayers scene_layers(const Prescription& lens, const Scene& scene,
                         const FlareRequest& request) {
    CompiledSpectra spectra(request.coating_model);
    const PatternOf pattern_of = pattern_of_size;
    const DrawGhosts draw = render_planned;
    const SceneView view{lens, scene, spectra, pattern_of, draw};
    SceneLayers layers;
    for (const LayerKind kind : layer_kinds) {
        if (!scene.layers.shows(kind)) continue;
        std::optional<FlareImage> image;
        switch (kind) {
            case LayerKind::ghosts:
                image = ghosts_layer(view, request);
                break;
            case LayerKind::starburst:
                image = starburst_layer(view, request, render_starburst);
                break;
            case LayerKind::veil:
                image = veil_layer(view, request, {}, layers.find(LayerKind::ghosts));
                break;
            case LayerKind::backdrop:
                if (scene.backdrop.file.empty())
                    throw Error("--layers: the layer backdrop needs a picture, --backdrop FILE");
                image = read_backdrop(
                    scene.backdrop.file, lens.sensor, request.width_px,
                    sunlit_white_per_e0(first_order(compile(lens, d_line_nm)).f_number));
                break;
        }
        layers.kinds.push_back(kind);
        layers.images.push_back(std::move(*image));
    }
    return layers;
}

/// The sum of the layers, with their gains, which the layers get too.
FlareImage composed(const Scene& scene, SceneLayers& layers) {
    std::vector<LayerImage> shown;
    for (std::size_t k = 0; k < layers.kinds.size(); ++k)
        shown.push_back({layers.kinds[k], &layers.images[k]});
    FlareImage sum = compose(shown, scene.layers);
    for (std::size_t k = 0; k < layers.kinds.size(); ++k) {
        const LayerImage one = shown[k];
        layers.images[k] = compose(std::span(&one, 1), scene.layers);
    }
    return sum;
}

/// "5-3 (N 812, 2.3 px), …": which ghosts got their fringes.
std::string rung_ghosts(const SceneLayers& drawn) {
    std::vector<std::string> texts;
    for (const FlareImage& image : drawn.images)
        for (const RungGhost& ghost : image.ringing)
            texts.push_back(fmt::format("{} (N {:.3g}, {:.2g} px{})", name(ghost.path),
                                        ghost.fresnel_number, ghost.first_fringe_px,
                                        ghost.propagated ? ", whole mask" : ""));
    return texts.empty() ? "none" : joined(texts, "; ");
}

/// "12 ghosts, at most 0.04 of the light": what folding may change, L1, over all ghosts' light.
std::string folded_ghosts(const FlarePlan& plan) {
    const double all_mm2 = plan.flux_mm2 + plan.folded_mm2;
    return fmt::format("{} ghosts, at most {:.2g} of the light", plan.count(GhostFate::folded),
                       all_mm2 > 0.0 ? 2.0 * plan.folded_mm2 / all_mm2 : 0.0);
}

/// The method that drew the ghosts, and why if it is not the one asked for.
std::string drawn_by(const Prescription& lens, const FlareRequest& request) {
    const OpticalSystem system = compile(lens, d_line_nm);
    if (request.method != FlareMethod::planned || can_be_planned(system, request.light))
        return std::string(method_name(request.method));
    return fmt::format("{}: {}", method_name(FlareMethod::uniform),
                       system.stop_mask.picture
                           ? "the stop has an image"
                           : "the sensor reflects and the light is not above or below the axis");
}

void run(const RenderOptions& options) {
    const std::string& file = options.output.file;
    const std::string extension = picture_extension(file);
    FlareRequest request;
    set_method(options.method, request);
    request.ringing = options.ringing;
    if (request.ringing && request.method == FlareMethod::paraxial)
        throw Error("--ringing: not with --method paraxial, whose rims are its own");
    request.width_px = static_cast<int>(integer_value(
        "--width", options.width, "a whole number of pixels from 16 to 16384", 16, 16384));
    std::optional<double> exposure_ev = exposure_value(options.exposure, extension);
    std::size_t per_ghost = 0;
    if (!options.per_ghost.empty()) {
        if (extension != ".exr") throw Error("--per-ghost: only an EXR file has layers");
        per_ghost = static_cast<std::size_t>(integer_value("--per-ghost", options.per_ghost,
                                                           "a whole number from 1 to 300", 1, 300));
    }
    const LoadedLens loaded = load_lens(options.lens);
    const Scene scene = scene_of(options.scene, loaded);
    request.ringing = request.ringing || scene.ringing;
    if (!options.only.empty()) {
        const OpticalSystem system = compile(loaded.lens, d_line_nm);
        for (const std::string_view ghost : split(options.only, ','))
            request.only.push_back(
                read_option("--only", [&] { return parse_ghost(ghost, system); }));
    }
    request.light = scene.light().direction;
    request.spectrum = scene.light().spectrum;
    if (per_ghost > 0 && !has_plain_ghosts(scene))
        throw Error(
            "--per-ghost: its layers are of one point light, without folding and artistic changes");
    // With layers the same grids for all, so that the layers add up to the picture.
    if (per_ghost > 0 && request.method == FlareMethod::planned)
        request.method = FlareMethod::uniform;
    SceneLayers drawn = scene_layers(loaded.lens, scene, request);
    const FlareImage image = composed(scene, drawn);
    if (image.irradiance.empty()) throw Error("no layer is on: --layers names what to draw");
    const FlareOrigin origin = origin_of(loaded, request, image);
    GhostLayers layers;
    if (per_ghost > 0) layers = layers_of(loaded.lens, request, per_ghost);
    if (extension == ".exr") {
        std::vector<FlareLayer> named;
        // A layer alone is the picture.
        for (std::size_t k = 0; k < drawn.kinds.size() && drawn.kinds.size() > 1; ++k)
            named.push_back({std::string(name(drawn.kinds[k])), &drawn.images[k]});
        for (std::size_t k = 0; k < layers.names.size(); ++k)
            named.push_back({layers.names[k], &layers.images[k]});
        write_exr(image, file, origin, named);
    } else {
        exposure_ev = exposure_ev.value_or(automatic_exposure_ev(image));
        write_display(image, *exposure_ev, file, origin);
    }

    std::vector<std::string> all_names;
    if (extension == ".exr" && drawn.kinds.size() > 1)
        for (const LayerKind kind : drawn.kinds) all_names.emplace_back(name(kind));
    all_names.insert(all_names.end(), layers.names.begin(), layers.names.end());
    const auto of_plan = [&](auto member) {
        return image.plan.ghosts.empty() ? Cell() : Cell(std::invoke(member, image.plan));
    };
    Report report;
    report.lens = lens_fields(loaded);
    report.request = {{"command", json_string("render")},
                      {"field_deg", json_value(request.light.field_deg)},
                      {"azimuth_deg", json_value(request.light.azimuth_deg)},
                      {"spectrum", json_string(name(request.spectrum))}};
    report.table.columns = {"file",
                            "width_px",
                            "height_px",
                            "ghosts",
                            "rays",
                            "flux_mm2",
                            "flux_on_sensor_mm2",
                            "exposure_ev",
                            "time_ms",
                            "layers",
                            "method",
                            "estimated_error",
                            "left_out_share",
                            "not_modelled_share",
                            "rung",
                            "folded"};
    report.table.rows = {
        {file, static_cast<std::int64_t>(image.width_px),
         static_cast<std::int64_t>(image.height_px), static_cast<std::int64_t>(image.ghosts),
         static_cast<std::int64_t>(image.rays), image.flux_mm2, image.flux_on_sensor_mm2,
         exposure_ev ? Cell(*exposure_ev) : Cell(), image.times.total_ms,
         all_names.empty() ? Cell() : Cell(joined(all_names, " ")), drawn_by(loaded.lens, request),
         of_plan(&FlarePlan::estimated_error), of_plan(&FlarePlan::left_out_share),
         of_plan(&FlarePlan::not_modelled), request.ringing ? Cell(rung_ghosts(drawn)) : Cell(),
         image.folded.empty() ? Cell() : Cell(folded_ghosts(image.plan))}};
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
    add_scene(*command, options->scene);
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
    command->add_flag(
        "--ringing", options->ringing,
        "diffraction at the ghosts' rims, where its fringes are a pixel wide or more");
    add_text(*command, "--only", options->only, "I-J[,I-J]", "these ghosts alone");
    CLI::Option* csv = command->add_flag("--csv", options->output.csv, "summary as CSV");
    command->add_flag("--json", options->output.json, "summary as JSON")->excludes(csv);
    command->footer(R"(Examples:
  ghostlight-cli render tessar_brendel_100_f2.8 --field 15 -o flare.exr --per-ghost 5
  ghostlight-cli render tessar_brendel_100_f2.8 --field 15 --azimuth 60 --spectrum D65 \
      --width 1920 --exposure 14 -o flare.png
  ghostlight-cli render tessar_brendel_100_f2.8 --light 8,60,spectrum=D65,size=sun \
      --light 4,200,spectrum=sodium,ev=-4 --layers ghosts,veil --fold 0.1 -o street.exr)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
