#include "app/cli/scene_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/scene_json.h"
#include "core/io/spectrum_csv.h"

namespace ghostlight::cli {
namespace {

constexpr std::string_view light_form =
    "DEG[,AZIMUTH][,spectrum=NAME][,size=SIZE][,ev=STOPS][,name=TEXT], such as "
    "'12,60,spectrum=sodium,size=sun,ev=-3'";
constexpr std::string_view style_form =
    "I-J:off, or I-J: with ev=STOPS, tint=R/G/B and offset=X/Y in mm, separated by commas, such as "
    "'5-3:ev=1,tint=1/0.8/0.5'";

double stops(std::string_view option, std::string_view text) {
    return number_value(option, text, "stops from -40 to 40",
                        [](double ev) { return std::abs(ev) <= most_ev; });
}

double share(std::string_view option, std::string_view text, std::string_view expected,
             bool (*accepts)(double)) {
    return number_value(option, text, expected, accepts);
}

/// "key=value" → key and value; the value is empty without "=".
std::pair<std::string_view, std::string_view> key_value(std::string_view part) {
    const auto at = part.find('=');
    if (at == part.npos) return {part, {}};
    return {part.substr(0, at), part.substr(at + 1)};
}

std::vector<double> numbers(std::string_view option, std::string_view whole, std::string_view text,
                            std::size_t count, double low, double high) {
    std::vector<double> values;
    for (const std::string_view part : split(text, '/')) {
        const auto value = parse_number(part);
        if (!value || *value < low || *value > high) throw bad_value(option, whole, style_form);
        values.push_back(*value);
    }
    if (values.size() != count) throw bad_value(option, whole, style_form);
    return values;
}

GhostStyle parse_style(std::string_view text, const OpticalSystem& system) {
    constexpr std::string_view option = "--style";
    const auto colon = text.find(':');
    if (colon == text.npos) throw bad_value(option, text, style_form);
    GhostStyle style;
    style.path = read_option(option, [&] { return parse_ghost(text.substr(0, colon), system); });
    if (style.path.is_direct()) throw bad_value(option, text, style_form);
    for (const std::string_view part : split(text.substr(colon + 1), ',')) {
        const auto [key, value] = key_value(part);
        if (key == "off" && value.empty()) {
            style.on = false;
        } else if (key == "ev") {
            style.gain_ev = stops(option, value);
        } else if (key == "tint") {
            const auto rgb = numbers(option, text, value, 3, 0.0, most_tint);
            std::ranges::copy(rgb, style.tint.begin());
        } else if (key == "offset") {
            const auto xy = numbers(option, text, value, 2, -most_offset_mm, most_offset_mm);
            style.offset_x_mm = xy[0];
            style.offset_y_mm = xy[1];
        } else {
            throw bad_value(option, text, style_form);
        }
    }
    return style;
}

std::string layer_names() {
    std::vector<std::string> names;
    for (const LayerKind kind : layer_kinds) names.emplace_back(name(kind));
    return joined(names, ", ");
}

LayerKind layer_named(std::string_view option, std::string_view text, std::string_view whole) {
    const auto kind = find_layer(text);
    if (!kind) throw bad_value(option, whole, "some of " + layer_names());
    return *kind;
}

void set_layers(const SceneOptions& options, Scene& scene) {
    if (!options.layers.empty()) {
        scene.layers.alone.reset();
        for (const LayerKind kind : layer_kinds) scene.layers.of(kind).on = false;
        for (const std::string_view text : split(options.layers, ','))
            scene.layers.of(layer_named("--layers", text, options.layers)).on = true;
    }
    for (const std::string& gain : options.gains) {
        const auto [layer, ev] = key_value(gain);
        scene.layers.of(layer_named("--gain", layer, gain)).gain_ev = stops("--gain", ev);
    }
    if (!options.backdrop.empty()) {
        scene.backdrop.file = options.backdrop;
        if (options.layers.empty()) scene.layers.of(LayerKind::backdrop).on = true;
    }
}

void set_veil(const SceneOptions& options, Scene& scene) {
    Veil& veil = scene.veil;
    if (!options.folded.empty())
        veil.folded_share =
            share("--fold", options.folded, "a share of the ghosts' light from 0 to 0.5",
                  [](double value) { return value >= 0.0 && value <= most_folded_share; });
    if (!options.kernel.empty()) {
        if (options.kernel != "gaussian" && options.kernel != "ellipse")
            throw bad_value("--veil-kernel", options.kernel, "gaussian or ellipse");
        veil.kernel = options.kernel == "gaussian" ? VeilKernel::gaussian : VeilKernel::ellipse;
    }
    if (!options.scatter.empty()) {
        constexpr std::string_view form =
            "SHARE[:EXPONENT[:CORE_DEG]]: 0 to 1, 2.05 to 10, 0.001 to 20, such as 0.01:2.5:0.2";
        const auto parts = split(options.scatter, ':');
        const auto value = [&](std::size_t k, double otherwise, double low, double high) {
            if (k >= parts.size()) return otherwise;
            const auto number = parse_number(parts[k]);
            if (!number || *number < low || *number > high)
                throw bad_value("--scatter", options.scatter, form);
            return *number;
        };
        if (parts.size() > 3) throw bad_value("--scatter", options.scatter, form);
        veil.spread.share = value(0, 0.0, 0.0, 1.0);
        veil.spread.exponent =
            value(1, veil.spread.exponent, least_glare_exponent, most_glare_exponent);
        veil.spread.core_deg = value(2, veil.spread.core_deg, 1e-3, largest_light_deg);
    }
    const bool asked = veil.folded_share > 0.0 || veil.spread.share > 0.0;
    if (asked && options.layers.empty() && !options.stored)
        scene.layers.of(LayerKind::veil).on = true;
}

void set_artistic(const SceneOptions& options, const LoadedLens& loaded, Scene& scene) {
    Artistic& artistic = scene.artistic;
    if (!options.exaggerate.empty())
        artistic.exaggeration_ev = stops("--exaggerate", options.exaggerate);
    if (!options.jitter.empty())
        artistic.jitter_mm =
            share("--jitter", options.jitter, "mm from 0 to 100",
                  [](double value) { return value >= 0.0 && value <= most_offset_mm; });
    if (!options.seed.empty())
        artistic.seed = static_cast<std::uint32_t>(integer_value(
            "--jitter-seed", options.seed, "a whole number from 0 to 4294967295", 0, 4294967295L));
    if (options.styles.empty()) return;
    const OpticalSystem system =
        compile(loaded.lens, reference_wavelength_nm(scene.light().spectrum));
    for (const std::string& text : options.styles)
        artistic.ghosts.push_back(parse_style(text, system));
}

}  // namespace

Light parse_light(std::string_view option, std::string_view text, const Light& like) {
    Light light = like;
    light.name.clear();
    const auto parts = split(text, ',');
    std::size_t plain = 0;
    for (const std::string_view part : parts) {
        const auto [key, value] = key_value(part);
        if (part.find('=') == part.npos) {
            const bool is_field = plain++ == 0;
            const auto number = parse_number(part);
            if (!number || plain > 2 || (is_field && std::abs(*number) > 90.0))
                throw bad_value(option, text, light_form);
            (is_field ? light.direction.field_deg : light.direction.azimuth_deg) = *number;
        } else if (key == "spectrum") {
            light.spectrum = read_option(option, [&] { return spectrum_by_name(value); });
        } else if (key == "size") {
            light.size = read_option(option, [&] { return parse_light_size(value); });
        } else if (key == "ev") {
            light.intensity_ev = stops(option, value);
        } else if (key == "name") {
            light.name = value;
        } else {
            throw bad_value(option, text, light_form);
        }
    }
    if (plain == 0) throw bad_value(option, text, light_form);
    return light;
}

void add_scene(CLI::App& command, SceneOptions& options) {
    add_light(command, options.light)->capture_default_str();
    add_spectrum(command, options.spectrum);
    constexpr auto lights = "Lights";
    add_text(
        command, "--size", options.size, "SIZE",
        "of the light: point (default), sun (0.533 degrees), 'disc DEG' or\n'picture FILE DEG'")
        ->group(lights);
    command
        .add_option(
            "--light", options.lights,
            "a light, in place of --field and --azimuth; several may be given, separately:\n"
            "DEG[,AZIMUTH][,spectrum=NAME][,size=SIZE][,ev=STOPS][,name=TEXT]; what is\n"
            "left out is as --spectrum and --size say")
        ->type_name("LIGHT")
        ->allow_extra_args(false)
        ->group(lights);
    command
        .add_flag("--scene", options.stored,
                  "lights, layers and artistic changes as they are saved with the lens; options\n"
                  "change them")
        ->group(lights);
    constexpr auto layers = "Layers";
    add_text(command, "--layers", options.layers, "NAMES",
             "what the picture is the sum of, separated by commas: " + layer_names() +
                 ";\ndefault: ghosts, and what other options ask for")
        ->group(layers);
    command
        .add_option("--gain", options.gains,
                    "stops for a layer, LAYER=EV, such as veil=-1; may be given again")
        ->type_name("LAYER=EV")
        ->allow_extra_args(false)
        ->group(layers);
    add_text(command, "--backdrop", options.backdrop, "FILE",
             "a picture behind the flare; its white is a white surface in the sun, E0/(4 N²)")
        ->group(layers);
    add_text(command, "--fold", options.folded, "SHARE",
             "ghosts of the least irradiance go into the veil, up to this share of the light")
        ->group(layers);
    add_text(command, "--veil-kernel", options.kernel, "NAME",
             "what stands for a folded ghost: ellipse (default) or gaussian")
        ->group(layers);
    add_text(command, "--scatter", options.scatter, "SHARE[:EXPONENT[:CORE]]",
             "the veil holds this share of the direct light, spread as\n"
             "(1 + r²/core²)^(-EXPONENT/2); default 0:2.5:0.2, CORE in degrees")
        ->group(layers);
    constexpr auto artistic = "Artistic, neutral by default";
    command
        .add_option(
            "--style", options.styles,
            "one ghost's changes, I-J:off or I-J: with ev=STOPS,tint=R/G/B,offset=X/Y in mm;\n"
            "may be given again")
        ->type_name("GHOST:CHANGES")
        ->allow_extra_args(false)
        ->group(artistic);
    add_text(command, "--exaggerate", options.exaggerate, "EV", "stops for all ghosts")
        ->group(artistic);
    add_text(command, "--jitter", options.jitter, "MM",
             "every ghost moved by a normal deviate of this size")
        ->group(artistic);
    add_text(command, "--jitter-seed", options.seed, "N", "of the jitter; default 1")
        ->group(artistic);
}

Scene scene_of(const SceneOptions& options, const LoadedLens& loaded) {
    Scene scene;
    scene.light() = {.name = {},
                     .direction = light_direction(options.light),
                     .spectrum = spectrum_of(options.spectrum),
                     .size = PointSize{},
                     .intensity_ev = 0.0,
                     .on = true};
    if (!options.size.empty())
        scene.light().size = read_option("--size", [&] { return parse_light_size(options.size); });
    if (options.stored) {
        const auto stored = loaded.lens.unknown.find(std::string(scene_field));
        if (stored == loaded.lens.unknown.end())
            throw Error({.problem = "no scene is saved with the lens",
                         .file = loaded.file.string(),
                         .where = "--scene",
                         .found = {},
                         .expected = "a lens that was saved by the window"});
        scene = scene_from_json(stored->second, loaded.lens, scene);
    }
    if (options.lights.size() > most_lights)
        throw bad_value("--light", fmt::format("{} lights", options.lights.size()),
                        fmt::format("at most {}", most_lights));
    if (!options.lights.empty()) {
        const Light like = scene.light();
        scene.lights.clear();
        scene.active_light = 0;
        for (const std::string& text : options.lights)
            scene.lights.push_back(parse_light("--light", text, like));
    }
    set_layers(options, scene);
    set_veil(options, scene);
    set_artistic(options, loaded, scene);
    return scene;
}

}  // namespace ghostlight::cli
