#include "core/io/scene_json.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/io/json_value.h"

namespace ghostlight {
namespace {

double number_or(const Json& object, const char* key, double otherwise) {
    const auto at = object.find(key);
    return at != object.end() && at->is_number() ? at->get<double>() : otherwise;
}

std::string text_or_empty(const Json& object, const char* key) {
    const auto at = object.find(key);
    return at != object.end() && at->is_string() ? at->get<std::string>() : std::string();
}

void read_share(const Json& object, const char* key, double& share) {
    const double read = number_or(object, key, share);
    if (read > 0.0 && read < 1.0) share = read;
}

}  // namespace

std::string scene_to_json(const Scene& scene) {
    Json object = Json::object();
    if (!scene.configuration.empty()) object["configuration"] = scene.configuration;
    object["field_deg"] = scene.light.field_deg;
    object["azimuth_deg"] = scene.light.azimuth_deg;
    object["spectrum"] = name(scene.spectrum);
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
    if (!object.is_object()) return scene;
    const std::string configuration = text_or_empty(object, "configuration");
    for (const Configuration& known : lens.configurations)
        if (known.name == configuration) scene.configuration = configuration;
    const double field_deg = number_or(object, "field_deg", scene.light.field_deg);
    if (std::abs(field_deg) < 90.0) scene.light.field_deg = field_deg;
    scene.light.azimuth_deg = number_or(object, "azimuth_deg", scene.light.azimuth_deg);
    read_share(object, "tolerance", scene.tolerance);
    read_share(object, "flare_tolerance", scene.flare_tolerance);
    try {
        if (object.contains("spectrum"))
            scene.spectrum = parse_spectrum(text_or_empty(object, "spectrum"));
    } catch (const Error&) {
    }
    return scene;
}

}  // namespace ghostlight
