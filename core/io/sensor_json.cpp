#include "core/io/sensor_json.h"

#include "core/io/coating_json.h"
#include "core/io/medium_json.h"

namespace ghostlight {
namespace {

ReflectanceTable read_table(const JsonAt& array) {
    constexpr std::string_view expected = "an array of [wavelength in nm, share] pairs";
    array.require_array(expected);
    ReflectanceTable table;
    for (std::size_t i = 0; i < array.size(); ++i) {
        const JsonAt pair = array[i];
        pair.require_array(expected);
        if (pair.size() != 2) pair.refuse("not a pair", expected);
        table.entries.push_back(
            {pair[0].number("a wavelength in nm"), pair[1].number("a share from 0 to 1")});
    }
    return table;
}

struct Write {
    Json operator()(const UniformReflectance& uniform) const { return uniform.share; }
    Json operator()(const ReflectanceTable& table) const {
        Json entries = Json::array();
        for (const ReflectanceAt& at : table.entries)
            entries.push_back(Json::array({at.wavelength_nm, at.share}));
        return Json{{"table", std::move(entries)}};
    }
    Json operator()(const SensorFilms& films) const {
        Json object = write_coating(films.stack);
        Json substrate = Json::object();
        write_medium(substrate, films.substrate);
        object["substrate"] = std::move(substrate);
        return object;
    }
};

}  // namespace

SensorReflectance read_sensor_reflectance(const JsonAt& value, UnknownFields& unknown) {
    constexpr std::string_view expected =
        "a share from 0 to 1, {\"table\": [[nm, share], …]} or {\"layers\": […], "
        "\"substrate\": {…}}";
    if (value.value().is_number()) return UniformReflectance{value.number(expected)};
    value.require_object(expected);
    keep_unknown(value, {"table", "layers", "substrate"}, unknown, "reflectance");
    const auto table = value.find("table");
    const auto layers = value.find("layers");
    if (table.has_value() == layers.has_value()) value.refuse("not a known reflectance", expected);
    if (table) return read_table(*table);
    SensorFilms films;
    films.stack = read_layers(*layers, unknown, "reflectance/layers");
    constexpr std::string_view material = "the medium below the layers, such as {\"index\": 4.1}";
    const JsonAt substrate = value.at("substrate", material);
    substrate.require_object(material);
    films.substrate = read_medium(substrate, unknown, "reflectance/substrate");
    return films;
}

Json write_sensor_reflectance(const SensorReflectance& reflectance) {
    return std::visit(Write{}, reflectance);
}

}  // namespace ghostlight
