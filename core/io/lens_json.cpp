#include "core/io/lens_json.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "core/io/coating_json.h"
#include "core/io/medium_json.h"
#include "core/io/sensor_json.h"
#include "core/io/stop_image_file.h"
#include "core/io/varied_cells.h"

namespace ghostlight {
namespace {

constexpr std::string_view paraxial_focus = "paraxial focus";

/// "A4" → 0, "A6" → 1, …
std::optional<std::size_t> aspheric_index(std::string_view name) {
    unsigned power = 0;
    if (name.size() < 2 || name.size() > 3 || name.front() != 'A') return std::nullopt;
    const auto [end, status] = std::from_chars(name.data() + 1, name.data() + name.size(), power);
    if (status != std::errc{} || end != name.data() + name.size() || power < 4 || power % 2 != 0 ||
        power > 42)
        return std::nullopt;
    return (power - 4) / 2;
}

std::vector<double> read_aspheric(const JsonAt& surface) {
    const auto named = surface.find("aspheric");
    const auto listed = surface.find("aspheric_mm");
    if (named && listed)
        listed->refuse("the aspheric terms are given twice", "aspheric or aspheric_mm");
    std::vector<double> terms;
    if (named) {
        constexpr std::string_view expected = "{\"A4\": …, \"A6\": …}, even powers from A4 to A42";
        named->require_object(expected);
        for (const auto& [name, value] : named->value().items()) {
            const auto index = aspheric_index(name);
            if (!index)
                named->refuse(fmt::format("{} is not a term of an even asphere", excerpt(name)),
                              expected);
            if (terms.size() <= *index) terms.resize(*index + 1, 0.0);
            terms[*index] = named->at(name, expected).number();
        }
    } else if (listed) {
        listed->require_array("an array [A4, A6, A8, …]");
        for (std::size_t i = 0; i < listed->size(); ++i) terms.push_back((*listed)[i].number());
    }
    return terms;
}

BaseCurve read_curve(const JsonAt& surface) {
    const auto radius = surface.find("radius_mm");
    const auto curvature = surface.find("curvature_per_mm");
    if (radius && curvature)
        curvature->refuse("the surface has both a radius and a curvature",
                          "radius_mm or curvature_per_mm, or neither for a plane");
    if (radius) return Radius{radius->number("a radius in mm, or none for a plane")};
    if (curvature) return Curvature{curvature->number("a curvature in 1/mm")};
    return Plane{};
}

Surface read_surface(const JsonAt& object, bool is_last) {
    object.require_object("a surface {radius_mm, thickness_mm, …}");
    Surface surface;
    surface.curve = read_curve(object);
    surface.conic = optional_number(object, "conic").value_or(0.0);
    surface.aspheric = read_aspheric(object);
    constexpr std::string_view thickness = "the distance to the next surface in mm";
    // The last row's is the sensor's distance, and may stand there.
    if (!is_last || object.has("thickness_mm"))
        surface.thickness_mm = object.at("thickness_mm", thickness).number(thickness);
    constexpr std::string_view semi_diameter = "the clear radius in mm";
    surface.semi_diameter_mm = object.at("semi_diameter_mm", semi_diameter).number(semi_diameter);
    if (const auto sized = object.find("semi_diameter_sized"))
        surface.semi_diameter_sized = sized->boolean();
    surface.comment = optional_text(object, "comment");
    keep_unknown(
        object,
        {"radius_mm", "curvature_per_mm", "conic", "aspheric", "aspheric_mm", "thickness_mm",
         "glass", "model", "index", "formula", "agf", "table", "transmittance", "unknown_glass",
         "semi_diameter_mm", "semi_diameter_sized", "coating", "comment"},
        surface.unknown);
    surface.medium_after = read_medium(object, surface.unknown);
    if (const auto coating = object.find("coating"))
        surface.coating = read_coating(*coating, surface.unknown);
    return surface;
}

Published read_published(const JsonAt& object) {
    object.require_object();
    Published published;
    published.efl_mm = optional_number(object, "efl_mm");
    published.f_number = optional_number(object, "f_number");
    published.bfd_mm = optional_number(object, "bfd_mm");
    published.half_field_deg = optional_number(object, "half_field_deg");
    keep_unknown(object, {"efl_mm", "f_number", "bfd_mm", "half_field_deg"}, published.unknown);
    return published;
}

std::string row_range(std::size_t surfaces) { return fmt::format("a row from 1 to {}", surfaces); }

/// Images lie beside the lens that names them.
StopImage read_image(const JsonAt& named) {
    const std::string text = named.text("the name of an image file");
    if (text.empty()) named.refuse("no file's name", "the name of an image file");
    std::filesystem::path file = std::filesystem::path(named.file()).parent_path() / text;
    std::error_code unknown;
    if (const auto absolute = std::filesystem::absolute(file, unknown); !unknown)
        file = absolute.lexically_normal();
    try {
        return read_stop_image(file);
    } catch (const Error& error) {
        throw Error({.problem = error.parts().problem + ": " + file.string(),
                     .file = named.file(),
                     .where = named.path(),
                     .found = error.parts().found,
                     .expected = error.parts().expected});
    }
}

StopDirt read_dirt(const JsonAt& object, UnknownFields& unknown) {
    object.require_object();
    StopDirt dirt;
    auto take = [&](std::string_view key, double& value) {
        value = optional_number(object, key).value_or(value);
    };
    take("dust_coverage", dirt.dust_coverage);
    take("dust_smallest_mm", dirt.dust_smallest_mm);
    take("dust_largest_mm", dirt.dust_largest_mm);
    take("scratch_thinnest_mm", dirt.scratch_thinnest_mm);
    take("scratch_widest_mm", dirt.scratch_widest_mm);
    take("fingerprint", dirt.fingerprint);
    if (const auto scratches = object.find("scratches"))
        dirt.scratches =
            static_cast<int>(scratches->integer(0, 10'000, "a whole number from 0 to 10000"));
    if (const auto seed = object.find("seed"))
        dirt.seed =
            static_cast<int>(seed->integer(0, 1'000'000'000, "a whole number from 0 to 1e9"));
    keep_unknown(object,
                 {"dust_coverage", "dust_smallest_mm", "dust_largest_mm", "scratches",
                  "scratch_thinnest_mm", "scratch_widest_mm", "fingerprint", "seed"},
                 unknown, "dirt");
    return dirt;
}

Stop read_stop(const JsonAt& object, std::size_t surfaces) {
    object.require_object();
    Stop stop;
    const std::string rows = row_range(surfaces);
    stop.surface = static_cast<std::size_t>(
        object.at("surface", rows).integer(1, static_cast<long>(surfaces), rows) - 1);
    stop.f_number = optional_number(object, "f_number");
    stop.semi_diameter_mm = optional_number(object, "semi_diameter_mm");
    if (const auto blades = object.find("blades"))
        stop.blades = static_cast<int>(blades->integer(0, 1000, "0 (round), or 3 to 1000"));
    stop.rotation_deg = optional_number(object, "rotation_deg").value_or(0.0);
    stop.blade_curvature = optional_number(object, "blade_curvature").value_or(0.0);
    keep_unknown(object,
                 {"surface", "f_number", "semi_diameter_mm", "blades", "rotation_deg",
                  "blade_curvature", "image", "dirt"},
                 stop.unknown);
    if (const auto image = object.find("image")) stop.image = read_image(*image);
    if (const auto dirt = object.find("dirt")) stop.dirt = read_dirt(*dirt, stop.unknown);
    return stop;
}

/// The sensor's distance goes to the last surface's thickness.
Sensor read_sensor(const JsonAt& object, Surface& last, bool last_has_thickness) {
    object.require_object();
    Sensor sensor;
    if (const auto width = optional_number(object, "width_mm")) sensor.width_mm = *width;
    if (const auto height = optional_number(object, "height_mm")) sensor.height_mm = *height;
    keep_unknown(object, {"width_mm", "height_mm", "distance_mm", "reflectance"}, sensor.unknown);
    if (const auto reflectance = object.find("reflectance"))
        sensor.reflectance = read_sensor_reflectance(*reflectance, sensor.unknown);
    constexpr std::string_view expected =
        "the distance from the last surface in mm, or \"paraxial focus\"";
    const auto distance = object.find("distance_mm");
    if (!distance) {
        if (!last_has_thickness) object.at("distance_mm", expected).refuse("no value", expected);
        return sensor;
    }
    if (distance->value().is_string()) {
        if (distance->text() != paraxial_focus) distance->refuse("not a distance", expected);
        sensor.at_paraxial_focus = true;
        return sensor;
    }
    const double distance_mm = distance->number(expected);
    if (last_has_thickness && distance_mm != last.thickness_mm)
        distance->refuse(fmt::format("not the last surface's thickness, {} mm",
                                     format_number(last.thickness_mm)),
                         "the same, or only one of the two");
    if (!(distance_mm >= 0.0)) distance->refuse("not a usable distance", "0 mm or more");
    last.thickness_mm = distance_mm;
    return sensor;
}

Configuration read_configuration(const JsonAt& object, std::size_t surfaces) {
    object.require_object("a configuration {name, thickness_mm}");
    Configuration configuration;
    configuration.name = object.at("name", "a text").text();
    configuration.f_number = optional_number(object, "f_number");
    configuration.stop_semi_diameter_mm = optional_number(object, "stop_semi_diameter_mm");
    if (const auto published = object.find("published"))
        configuration.published = read_published(*published);
    if (const auto thicknesses = object.find("thickness_mm")) {
        const std::string expected = "{\"row\": thickness, …}, with " + row_range(surfaces);
        thicknesses->require_object(expected);
        for (const auto& [text, value] : thicknesses->value().items()) {
            std::size_t row = 0;
            const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), row);
            if (status != std::errc{} || end != text.data() + text.size() || row < 1 ||
                row > surfaces)
                thicknesses->refuse(fmt::format("there is no row '{}'", text), expected);
            configuration.thickness_mm[row - 1] =
                thicknesses->at(text, expected).number("a thickness in mm");
        }
    }
    keep_unknown(object, {"name", "f_number", "stop_semi_diameter_mm", "published", "thickness_mm"},
                 configuration.unknown);
    return configuration;
}

void check_version(const JsonAt& root) {
    const JsonAt version = root.at("ghostlight_lens", "the schema's version");
    const double number = version.number("the schema's version, a whole number");
    if (number > lens_schema_version)
        version.refuse("the file was written by a newer Ghostlight",
                       fmt::format("version {} or older", lens_schema_version));
    version.integer(1, lens_schema_version, "the schema's version, 1");
}

}  // namespace

LensFile lens_from_own_json(const JsonAt& root) {
    check_version(root);
    LensFile result;
    Prescription& lens = result.lens;
    lens.name = optional_text(root, "name");
    lens.source = optional_text(root, "source");
    lens.notes = optional_text(root, "notes");
    if (const auto absorbs = root.find("internal_transmittance"))
        lens.internal_transmittance = absorbs->boolean();
    if (const auto published = root.find("published")) lens.published = read_published(*published);

    constexpr std::string_view rows = "an array of at least one surface";
    const JsonAt surfaces = root.at("surfaces", rows);
    surfaces.require_array(rows);
    if (surfaces.size() == 0) surfaces.refuse("the lens has no surfaces", rows);
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        lens.surfaces.push_back(read_surface(surfaces[i], i + 1 == surfaces.size()));

    lens.stop = read_stop(root.at("stop", "{\"surface\": row}"), lens.surfaces.size());
    const bool last_has_thickness = surfaces[surfaces.size() - 1].has("thickness_mm");
    if (const auto sensor = root.find("sensor"))
        lens.sensor = read_sensor(*sensor, lens.surfaces.back(), last_has_thickness);
    else if (!last_has_thickness)
        root.at("sensor", "{\"distance_mm\": …}").require_object();
    if (const auto configurations = root.find("configurations")) {
        configurations->require_array();
        for (std::size_t i = 0; i < configurations->size(); ++i)
            lens.configurations.push_back(
                read_configuration((*configurations)[i], lens.surfaces.size()));
    }
    keep_unknown(root,
                 {"ghostlight_lens", "name", "source", "notes", "internal_transmittance",
                  "published", "stop", "sensor", "surfaces", "configurations"},
                 lens.unknown);
    validate_in_file(lens, root.file());
    result.notes = findings(lens);
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        for (const auto& [name, text] : lens.surfaces[row].unknown)
            if (name != vary_field)
                result.notes.push_back({Note::Severity::info, fmt::format("surfaces[{}]", row + 1),
                                        "a field that is not known is kept but not used: " + name});
    return result;
}

}  // namespace ghostlight
