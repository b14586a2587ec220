#include <fmt/format.h>

#include "core/io/coating_json.h"
#include "core/io/lens_json.h"
#include "core/io/medium_json.h"
#include "core/io/sensor_json.h"

namespace ghostlight {
namespace {

void put(Json& object, const char* key, const std::optional<double>& value) {
    if (value) object[key] = *value;
}

void put_unless(Json& object, const char* key, double value, double usual) {
    if (value != usual) object[key] = value;
}

Json published_json(const Published& published) {
    Json object = Json::object();
    put(object, "efl_mm", published.efl_mm);
    put(object, "f_number", published.f_number);
    put(object, "bfd_mm", published.bfd_mm);
    put(object, "half_field_deg", published.half_field_deg);
    restore_unknown(object, published.unknown);
    return object;
}

Json dirt_json(const StopDirt& dirt) {
    const StopDirt usual;
    Json object = Json::object();
    put_unless(object, "dust_coverage", dirt.dust_coverage, usual.dust_coverage);
    put_unless(object, "dust_smallest_mm", dirt.dust_smallest_mm, usual.dust_smallest_mm);
    put_unless(object, "dust_largest_mm", dirt.dust_largest_mm, usual.dust_largest_mm);
    if (dirt.scratches != usual.scratches) object["scratches"] = dirt.scratches;
    put_unless(object, "scratch_thinnest_mm", dirt.scratch_thinnest_mm, usual.scratch_thinnest_mm);
    put_unless(object, "scratch_widest_mm", dirt.scratch_widest_mm, usual.scratch_widest_mm);
    put_unless(object, "fingerprint", dirt.fingerprint, usual.fingerprint);
    if (dirt.seed != usual.seed) object["seed"] = dirt.seed;
    return object;
}

/// Relative to the lens's folder where the image lies in or below it, so that both can be moved.
std::string image_name(const std::string& file, const std::filesystem::path& folder) {
    std::error_code unknown;
    const auto from = std::filesystem::absolute(folder, unknown).lexically_normal();
    if (folder.empty() || unknown) return file;
    const std::string relative =
        std::filesystem::path(file).lexically_relative(from).generic_string();
    return relative.empty() || relative.starts_with("..") ? file : relative;
}

Json stop_json(const Stop& stop, const std::filesystem::path& folder) {
    Json object = {{"surface", stop.surface + 1}};
    put(object, "f_number", stop.f_number);
    put(object, "semi_diameter_mm", stop.semi_diameter_mm);
    object["blades"] = stop.blades;
    put_unless(object, "rotation_deg", stop.rotation_deg, 0.0);
    put_unless(object, "blade_curvature", stop.blade_curvature, 0.0);
    if (stop.image) object["image"] = image_name(stop.image->file, folder);
    if (stop.dirt != StopDirt{}) object["dirt"] = dirt_json(stop.dirt);
    restore_unknown(object, stop.unknown);
    return object;
}

Json sensor_json(const Sensor& sensor, double distance_mm) {
    Json object = {{"width_mm", sensor.width_mm}, {"height_mm", sensor.height_mm}};
    if (sensor.at_paraxial_focus)
        object["distance_mm"] = "paraxial focus";
    else
        object["distance_mm"] = distance_mm;
    if (sensor.reflectance) object["reflectance"] = write_sensor_reflectance(*sensor.reflectance);
    restore_unknown(object, sensor.unknown);
    return object;
}

struct WriteCurve {
    Json& object;
    void operator()(const Plane&) const {}
    void operator()(const Radius& radius) const { object["radius_mm"] = radius.mm; }
    void operator()(const Curvature& curve) const { object["curvature_per_mm"] = curve.per_mm; }
};

Json surface_json(const Surface& surface, bool with_thickness) {
    Json object = Json::object();
    std::visit(WriteCurve{object}, surface.curve);
    put_unless(object, "conic", surface.conic, 0.0);
    if (!surface.aspheric.empty()) {
        Json& terms = object["aspheric"] = Json::object();
        for (std::size_t i = 0; i < surface.aspheric.size(); ++i)
            terms[fmt::format("A{}", 4 + 2 * i)] = surface.aspheric[i];
    }
    if (with_thickness) object["thickness_mm"] = surface.thickness_mm;
    write_medium(object, surface.medium_after);
    object["semi_diameter_mm"] = surface.semi_diameter_mm;
    if (surface.semi_diameter_sized) object["semi_diameter_sized"] = true;
    if (!std::holds_alternative<Uncoated>(surface.coating))
        object["coating"] = write_coating(surface.coating);
    if (!surface.comment.empty()) object["comment"] = surface.comment;
    restore_unknown(object, surface.unknown);
    return object;
}

Json configuration_json(const Configuration& configuration) {
    Json object = {{"name", configuration.name}};
    Json thicknesses = Json::object();
    for (const auto& [row, thickness_mm] : configuration.thickness_mm)
        thicknesses[fmt::format("{}", row + 1)] = thickness_mm;
    if (!thicknesses.empty()) object["thickness_mm"] = std::move(thicknesses);
    put(object, "f_number", configuration.f_number);
    put(object, "stop_semi_diameter_mm", configuration.stop_semi_diameter_mm);
    if (configuration.published != Published{})
        object["published"] = published_json(configuration.published);
    restore_unknown(object, configuration.unknown);
    return object;
}

/// One field a line, and for arrays of objects one object a line, so that files compare well.
std::string by_lines(const Json& root) {
    std::string out = "{";
    const char* separator = "\n";
    for (const auto& [key, value] : root.items()) {
        out += std::exchange(separator, ",\n");
        out += "  " + compact_json(key) + ": ";
        if (value.is_array() && !value.empty() && value.front().is_object()) {
            const char* between = "\n";
            out += '[';
            for (const Json& each : value)
                out += std::exchange(between, ",\n") + ("    " + compact_json(each));
            out += "\n  ]";
        } else {
            out += compact_json(value);
        }
    }
    return out + "\n}\n";
}

}  // namespace

std::string lens_to_json(const Prescription& lens, const std::filesystem::path& folder) {
    Json root = {{"ghostlight_lens", lens_schema_version}, {"name", lens.name}};
    if (!lens.source.empty()) root["source"] = lens.source;
    if (!lens.notes.empty()) root["notes"] = lens.notes;
    if (lens.internal_transmittance) root["internal_transmittance"] = true;
    if (lens.published != Published{}) root["published"] = published_json(lens.published);
    root["stop"] = stop_json(lens.stop, folder);
    root["sensor"] =
        sensor_json(lens.sensor, lens.surfaces.empty() ? 0.0 : lens.surfaces.back().thickness_mm);
    root["surfaces"] = Json::array();
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const Surface& surface = lens.surfaces[row];
        // With the sensor at the focus, the last thickness is kept for when it is there no more.
        const bool is_last = row + 1 == lens.surfaces.size();
        root["surfaces"].push_back(surface_json(
            surface, !is_last || (lens.sensor.at_paraxial_focus && surface.thickness_mm != 0.0)));
    }
    if (!lens.configurations.empty()) {
        root["configurations"] = Json::array();
        for (const Configuration& each : lens.configurations)
            root["configurations"].push_back(configuration_json(each));
    }
    restore_unknown(root, lens.unknown);
    return by_lines(root);
}

}  // namespace ghostlight
