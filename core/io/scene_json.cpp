#include "core/io/scene_json.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/io/json_value.h"

namespace ghostlight {
namespace {

// Reading takes what it understands: each of these returns what was there before where the field
// is missing, of another kind or out of range.

const Json* field(const Json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto at = object.find(key);
    return at == object.end() ? nullptr : &*at;
}

double number_or(const Json& object, const char* key, double low, double high, double otherwise) {
    const Json* at = field(object, key);
    if (at == nullptr || !at->is_number()) return otherwise;
    const double value = at->get<double>();
    return value >= low && value <= high ? value : otherwise;
}

bool truth_or(const Json& object, const char* key, bool otherwise) {
    const Json* at = field(object, key);
    return at != nullptr && at->is_boolean() ? at->get<bool>() : otherwise;
}

std::string text_or(const Json& object, const char* key, std::string otherwise = {}) {
    const Json* at = field(object, key);
    return at != nullptr && at->is_string() ? at->get<std::string>() : std::move(otherwise);
}

void read_share(const Json& object, const char* key, double& share) {
    const double read = number_or(object, key, 0.0, 1.0, share);
    if (read > 0.0 && read < 1.0) share = read;
}

Json spectrum_json(const Spectrum& spectrum) {
    const auto* table = std::get_if<TabulatedLight>(&spectrum);
    if (table == nullptr) return name(spectrum);
    Json power = Json::array();
    for (const SpectralValue& each : table->power)
        power.push_back(Json::array({each.wavelength_nm, each.value}));
    return Json{{"name", table->name}, {"power", std::move(power)}};
}

Spectrum read_spectrum(const Json& value, const Spectrum& otherwise) {
    try {
        if (value.is_string()) return parse_spectrum(value.get<std::string>());
        const Json* power = field(value, "power");
        if (power == nullptr || !power->is_array()) return otherwise;
        SpectralTable table;
        for (const Json& pair : *power) {
            if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number() ||
                !pair[1].is_number())
                return otherwise;
            table.push_back({pair[0].get<double>(), pair[1].get<double>()});
        }
        return tabulated_light(text_or(value, "name", "table"), std::move(table));
    } catch (const Error&) {
        return otherwise;
    }
}

Json light_json(const Light& light) {
    Json object = Json::object();
    if (!light.name.empty()) object["name"] = light.name;
    object["field_deg"] = light.direction.field_deg;
    object["azimuth_deg"] = light.direction.azimuth_deg;
    object["spectrum"] = spectrum_json(light.spectrum);
    if (light.size != LightSize{}) object["size"] = name(light.size);
    if (light.intensity_ev != 0.0) object["intensity_ev"] = light.intensity_ev;
    if (!light.on) object["on"] = false;
    return object;
}

Light read_light(const Json& object, Light light) {
    light.name = text_or(object, "name", light.name);
    const double field_deg = number_or(object, "field_deg", -90.0, 90.0, light.direction.field_deg);
    if (std::abs(field_deg) < 90.0) light.direction.field_deg = field_deg;
    light.direction.azimuth_deg =
        number_or(object, "azimuth_deg", -1e6, 1e6, light.direction.azimuth_deg);
    if (const Json* spectrum = field(object, "spectrum"))
        light.spectrum = read_spectrum(*spectrum, light.spectrum);
    try {
        if (const std::string size = text_or(object, "size"); !size.empty())
            light.size = parse_light_size(size);
    } catch (const Error&) {
    }
    light.intensity_ev = number_or(object, "intensity_ev", -most_ev, most_ev, light.intensity_ev);
    light.on = truth_or(object, "on", light.on);
    return light;
}

Json layers_json(const LayerSettings& layers) {
    Json object = Json::object();
    for (const LayerKind kind : layer_kinds)
        object[std::string(name(kind))] = {{"on", layers.of(kind).on},
                                           {"gain_ev", layers.of(kind).gain_ev}};
    if (layers.alone) object["alone"] = name(*layers.alone);
    return object;
}

void read_layers(const Json& object, LayerSettings& layers) {
    for (const LayerKind kind : layer_kinds)
        if (const Json* each = field(object, std::string(name(kind)).c_str())) {
            LayerSetting& setting = layers.of(kind);
            setting.on = truth_or(*each, "on", setting.on);
            setting.gain_ev = number_or(*each, "gain_ev", -most_ev, most_ev, setting.gain_ev);
        }
    layers.alone = find_layer(text_or(object, "alone"));
}

Json veil_json(const Veil& veil) {
    return {{"folded_share", veil.folded_share},
            {"kernel", veil.kernel == VeilKernel::gaussian ? "gaussian" : "ellipse"},
            {"scattered_share", veil.spread.share},
            {"exponent", veil.spread.exponent},
            {"core_deg", veil.spread.core_deg}};
}

void read_veil(const Json& object, Veil& veil) {
    veil.folded_share =
        number_or(object, "folded_share", 0.0, most_folded_share, veil.folded_share);
    const std::string kernel = text_or(object, "kernel");
    if (kernel == "gaussian") veil.kernel = VeilKernel::gaussian;
    if (kernel == "ellipse") veil.kernel = VeilKernel::ellipse;
    GlareSpread& spread = veil.spread;
    spread.share = number_or(object, "scattered_share", 0.0, 1.0, spread.share);
    spread.exponent =
        number_or(object, "exponent", least_glare_exponent, most_glare_exponent, spread.exponent);
    spread.core_deg = number_or(object, "core_deg", 1e-3, largest_light_deg, spread.core_deg);
}

Json style_json(const GhostStyle& style) {
    Json object = {{"ghost", name(style.path)}};
    const GhostStyle neutral{.path = style.path};
    if (!style.on) object["on"] = false;
    if (style.gain_ev != 0.0) object["gain_ev"] = style.gain_ev;
    if (style.tint != neutral.tint) object["tint"] = style.tint;
    if (style.offset_x_mm != 0.0 || style.offset_y_mm != 0.0)
        object["offset_mm"] = {style.offset_x_mm, style.offset_y_mm};
    return object;
}

/// "5-3" without a lens to hold it against; empty for anything else.
GhostPath read_path(std::string_view text) {
    GhostPath path;
    while (!text.empty()) {
        std::size_t row = 0;
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), row);
        if (status != std::errc{} || row == 0) return {};
        path.reflections.push_back(row - 1);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (text.empty()) break;
        if (text.front() != '-') return {};
        text.remove_prefix(1);
    }
    return path.reflections.size() <= max_reflections ? path : GhostPath{};
}

void read_numbers(const Json& object, const char* key, double low, double high,
                  std::initializer_list<double*> numbers) {
    const Json* array = field(object, key);
    if (array == nullptr || !array->is_array() || array->size() != numbers.size()) return;
    std::size_t k = 0;
    for (double* number : numbers) {
        const Json& value = (*array)[k++];
        if (value.is_number() && value.get<double>() >= low && value.get<double>() <= high)
            *number = value.get<double>();
    }
}

Json artistic_json(const Artistic& artistic) {
    Json object = {{"exaggeration_ev", artistic.exaggeration_ev},
                   {"jitter_mm", artistic.jitter_mm},
                   {"seed", artistic.seed}};
    Json ghosts = Json::array();
    for (const GhostStyle& style : artistic.ghosts) ghosts.push_back(style_json(style));
    if (!ghosts.empty()) object["ghosts"] = std::move(ghosts);
    return object;
}

void read_artistic(const Json& object, Artistic& artistic) {
    artistic.exaggeration_ev =
        number_or(object, "exaggeration_ev", -most_ev, most_ev, artistic.exaggeration_ev);
    artistic.jitter_mm = number_or(object, "jitter_mm", 0.0, most_offset_mm, artistic.jitter_mm);
    artistic.seed =
        static_cast<std::uint32_t>(number_or(object, "seed", 0.0, 4294967295.0, artistic.seed));
    const Json* ghosts = field(object, "ghosts");
    if (ghosts == nullptr || !ghosts->is_array()) return;
    artistic.ghosts.clear();
    for (const Json& each : *ghosts) {
        GhostStyle style{.path = read_path(text_or(each, "ghost"))};
        if (style.path.is_direct()) continue;
        style.on = truth_or(each, "on", style.on);
        style.gain_ev = number_or(each, "gain_ev", -most_ev, most_ev, style.gain_ev);
        read_numbers(each, "tint", 0.0, most_tint,
                     {&style.tint[0], &style.tint[1], &style.tint[2]});
        read_numbers(each, "offset_mm", -most_offset_mm, most_offset_mm,
                     {&style.offset_x_mm, &style.offset_y_mm});
        artistic.ghosts.push_back(std::move(style));
    }
}

}  // namespace

std::string scene_to_json(const Scene& scene) {
    const Scene plain;
    Json object = Json::object();
    if (!scene.configuration.empty()) object["configuration"] = scene.configuration;
    Json lights = Json::array();
    for (const Light& light : scene.lights) lights.push_back(light_json(light));
    object["lights"] = std::move(lights);
    if (scene.active_light != 0) object["active_light"] = scene.active_light + 1;
    if (scene.layers != plain.layers) object["layers"] = layers_json(scene.layers);
    if (scene.veil != plain.veil) object["veil"] = veil_json(scene.veil);
    if (scene.backdrop != plain.backdrop) object["backdrop"] = scene.backdrop.file;
    if (scene.artistic != plain.artistic) object["artistic"] = artistic_json(scene.artistic);
    if (scene.ringing) object["ringing"] = true;
    object["tolerance"] = scene.tolerance;
    object["flare_tolerance"] = scene.flare_tolerance;
    return compact_json(object);
}

Scene scene_from_json(std::string_view text, const Prescription& lens, const Scene& otherwise) {
    Scene scene = otherwise;
    Json object;
    try {
        object = parse_json(text, std::string(scene_field));
    } catch (const Error&) {
        return scene;
    }
    const std::string configuration = text_or(object, "configuration");
    for (const Configuration& known : lens.configurations)
        if (known.name == configuration) scene.configuration = configuration;
    const Json* lights = field(object, "lights");
    if (lights != nullptr && lights->is_array() && !lights->empty()) {
        scene.lights.clear();
        for (const Json& light : *lights)
            if (scene.lights.size() < most_lights)
                scene.lights.push_back(read_light(light, otherwise.light()));
        scene.active_light =
            static_cast<std::size_t>(number_or(object, "active_light", 1.0,
                                               static_cast<double>(scene.lights.size()), 1.0)) -
            1;
    } else {
        // As files before several lights had it.
        scene.light() = read_light(object, scene.light());
    }
    if (const Json* layers = field(object, "layers")) read_layers(*layers, scene.layers);
    if (const Json* veil = field(object, "veil")) read_veil(*veil, scene.veil);
    scene.backdrop.file = text_or(object, "backdrop", scene.backdrop.file);
    if (const Json* artistic = field(object, "artistic")) read_artistic(*artistic, scene.artistic);
    scene.ringing = truth_or(object, "ringing", scene.ringing);
    read_share(object, "tolerance", scene.tolerance);
    read_share(object, "flare_tolerance", scene.flare_tolerance);
    return scene;
}

}  // namespace ghostlight
