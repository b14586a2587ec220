#include "core/io/coating_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/io/coating_library.h"
#include "core/io/medium_json.h"
#include "core/io/same_name.h"

namespace ghostlight {
namespace {

std::variant<IdealIndex, Medium> read_layer_medium(const JsonAt& layer, UnknownFields& unknown,
                                                   const std::string& below) {
    constexpr std::string_view expected =
        "\"ideal\", the name of a glass such as \"MgF2\", an index, or an object with glass, "
        "index, model, formula, agf or table";
    if (layer.value().is_number()) return Medium{"", ConstantIndex{layer.number()}};
    if (layer.value().is_string()) {
        if (is_same_name(layer.text(), "ideal")) return IdealIndex{};
        return named_glass(layer);
    }
    layer.require_object(expected);
    keep_unknown(layer, {"glass", "model", "index", "formula", "agf", "table", "transmittance"},
                 unknown, below);
    return read_medium(layer, unknown, below);
}

QuarterWave read_quarter_wave(const JsonAt& object, UnknownFields& unknown) {
    object.require_object();
    const std::string below = "coating/quarter_wave";
    keep_unknown(object, {"center_nm", "layer", "thickness_factor"}, unknown, below);
    QuarterWave coating;
    if (const auto center = optional_number(object, "center_nm", "a wavelength in nm"))
        coating.center_nm = *center;
    if (const auto layer = object.find("layer"))
        coating.layer = read_layer_medium(*layer, unknown, below + "/layer");
    if (const auto factor = optional_number(object, "thickness_factor"))
        coating.thickness_factor = *factor;
    return coating;
}

/// In nm, or as a part of the wavelength at which it was designed, in the layer.
double read_thickness_nm(const JsonAt& object, const Medium& medium) {
    const auto waves = optional_number(object, "waves", "an optical thickness in wavelengths");
    if (!waves)
        return object.at("thickness_nm", "the layer's thickness in nm").number("a thickness in nm");
    if (object.find("thickness_nm")) object.refuse("both thickness_nm and waves", "one of them");
    const double at_nm = object.at("at_nm", "the wavelength that waves counts, in nm")
                             .number("a wavelength in nm", [](double nm) { return nm > 0.0; });
    return *waves * at_nm / refractive_index(medium, at_nm);
}

void read_extinction(const JsonAt& field, Layer& layer) {
    if (field.value().is_object())
        layer.extinction_table = read_spectral_table(field, "k");
    else
        layer.extinction = field.number("k, or {\"nm\": […], \"k\": […]}");
}

std::vector<double> read_numbers(const JsonAt& array, std::string_view expected) {
    array.require_array(expected);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < array.size(); ++i) numbers.push_back(array[i].number(expected));
    return numbers;
}

struct ShareColumn {
    std::string_view key;
    double MeasuredShares::*share;
};
constexpr std::array<ShareColumn, 2> reflected{
    {{"r_s", &MeasuredShares::r_s}, {"r_p", &MeasuredShares::r_p}}};
constexpr std::array<ShareColumn, 2> transmitted{
    {{"t_s", &MeasuredShares::t_s}, {"t_p", &MeasuredShares::t_p}}};

/// One row a wavelength, one column an angle.
void read_shares(const JsonAt& rows, double MeasuredShares::*share, MeasuredReflectance& table) {
    constexpr std::string_view expected = "a row for each wavelength with a value for each angle";
    rows.require_array(expected);
    if (rows.size() != table.wavelengths_nm.size()) rows.refuse("wrong number of rows", expected);
    const std::size_t count = table.angles_deg.size();
    for (std::size_t w = 0; w < rows.size(); ++w) {
        const auto values = read_numbers(rows[w], expected);
        if (values.size() != count) rows[w].refuse("wrong number of values", expected);
        for (std::size_t a = 0; a < count; ++a) table.shares[w * count + a].*share = values[a];
    }
}

MeasuredReflectance read_measured(const JsonAt& object, UnknownFields& unknown) {
    object.require_object();
    keep_unknown(object, {"nm", "angles_deg", "r_s", "r_p", "t_s", "t_p", "name"}, unknown,
                 "coating/measured");
    MeasuredReflectance table;
    table.name = optional_text(object, "name");
    table.wavelengths_nm = read_numbers(object.at("nm", "wavelengths in nm"), "wavelengths in nm");
    table.angles_deg =
        read_numbers(object.at("angles_deg", "angles in degrees"), "angles in degrees");
    table.shares.resize(table.wavelengths_nm.size() * table.angles_deg.size());
    for (const auto& [key, share] : reflected)
        read_shares(object.at(key, "reflectances"), share, table);
    for (MeasuredShares& at : table.shares) {
        at.t_s = 1.0 - at.r_s;
        at.t_p = 1.0 - at.r_p;
    }
    for (const auto& [key, share] : transmitted)
        if (const auto rows = object.find(key)) read_shares(*rows, share, table);
    return table;
}

ConstantReflectance read_constant(const JsonAt& object, UnknownFields& unknown) {
    object.require_object();
    keep_unknown(object, {"reflectance", "transmittance"}, unknown, "coating/constant");
    ConstantReflectance fixed;
    fixed.reflectance = object.at("reflectance", "a share from 0 to 1").number();
    fixed.transmittance =
        optional_number(object, "transmittance").value_or(1.0 - fixed.reflectance);
    return fixed;
}

LayerStack read_stack(const JsonAt& object, const JsonAt& layers, UnknownFields& unknown) {
    LayerStack stack = read_layers(layers, unknown, "coating/layers");
    stack.name = optional_text(object, "name");
    if (const auto from = object.find("from")) {
        constexpr std::string_view expected = "\"air\" or \"front\", where the first layer is";
        const std::string side = from->text(expected);
        if (side != "air" && side != "front") from->refuse("not a known side", expected);
        stack.from_air = side == "air";
    }
    return stack;
}

Coating library_coating(const JsonAt& name) {
    const std::string text = name.text("the name of a library coating");
    if (const Coating* known = find_coating(text)) return *known;
    name.refuse("no such coating in the library",
                fmt::format("none, or one of {}", fmt::join(coating_names(), ", ")));
}

/// True when the name alone says it all.
bool is_in_library(const std::string& name, const Coating& coating) {
    if (name.empty()) return false;
    try {
        const Coating* known = find_coating(name);
        return known != nullptr && *known == coating;
    } catch (const Error&) {
        // Without the library at hand the layers go into the file: saving must not fail.
        return false;
    }
}

struct WriteCoating {
    Json operator()(const Uncoated&) const { return "none"; }

    Json operator()(const QuarterWave& coating) const {
        Json object = {{"center_nm", coating.center_nm}};
        if (const auto* medium = std::get_if<Medium>(&coating.layer)) {
            Json layer = Json::object();
            write_medium(layer, *medium);
            if (layer.size() == 1 && (layer.contains("glass") || layer.contains("index")))
                layer = Json(layer.front());
            object["layer"] = layer.empty() ? Json(1.0) : std::move(layer);
        } else {
            object["layer"] = "ideal";
        }
        if (coating.thickness_factor != 1.0) object["thickness_factor"] = coating.thickness_factor;
        return Json{{"quarter_wave", std::move(object)}};
    }

    Json operator()(const LayerStack& stack) const {
        Json layers = Json::array();
        for (const Layer& layer : stack.layers) {
            Json object = Json::object();
            write_medium(object, layer.medium);
            if (object.empty()) object["index"] = 1.0;
            if (!layer.extinction_table.empty())
                object["k"] = write_spectral_table(layer.extinction_table, "k");
            else if (layer.extinction != 0.0)
                object["k"] = layer.extinction;
            object["thickness_nm"] = layer.thickness_nm;
            layers.push_back(std::move(object));
        }
        Json object = Json::object();
        if (!stack.name.empty()) object["name"] = stack.name;
        if (stack.from_air) object["from"] = "air";
        object["layers"] = std::move(layers);
        return object;
    }

    Json operator()(const MeasuredReflectance& table) const {
        Json object = Json::object();
        if (!table.name.empty()) object["name"] = table.name;
        object["nm"] = table.wavelengths_nm;
        object["angles_deg"] = table.angles_deg;
        auto put = [&](const ShareColumn& column) {
            Json rows = Json::array();
            const std::size_t count = table.angles_deg.size();
            for (std::size_t w = 0; w < table.wavelengths_nm.size(); ++w) {
                Json row = Json::array();
                for (std::size_t a = 0; a < count; ++a)
                    row.push_back(table.shares[w * count + a].*column.share);
                rows.push_back(std::move(row));
            }
            object[column.key] = std::move(rows);
        };
        for (const ShareColumn& column : reflected) put(column);
        const bool lossless = std::ranges::all_of(table.shares, [](const MeasuredShares& at) {
            return at.t_s == 1.0 - at.r_s && at.t_p == 1.0 - at.r_p;
        });
        if (!lossless)
            for (const ShareColumn& column : transmitted) put(column);
        return Json{{"measured", std::move(object)}};
    }

    Json operator()(const ConstantReflectance& fixed) const {
        Json object = {{"reflectance", fixed.reflectance}};
        if (fixed.transmittance != 1.0 - fixed.reflectance)
            object["transmittance"] = fixed.transmittance;
        return Json{{"constant", std::move(object)}};
    }
};

}  // namespace

LayerStack read_layers(const JsonAt& array, UnknownFields& unknown, const std::string& below) {
    array.require_array("an array of layers");
    LayerStack stack;
    for (std::size_t i = 0; i < array.size(); ++i) {
        const JsonAt object = array[i];
        object.require_object("a layer {index or glass, k, thickness_nm}");
        const std::string here = fmt::format("{}/{}", below, i);
        keep_unknown(object,
                     {"glass", "model", "index", "formula", "agf", "table", "transmittance", "k",
                      "thickness_nm", "waves", "at_nm"},
                     unknown, here);
        const bool has_medium =
            std::ranges::any_of(std::array{"glass", "index", "model", "formula", "agf", "table"},
                                [&](const char* key) { return object.find(key).has_value(); });
        if (!has_medium)
            object.refuse("the layer's medium is missing",
                          "glass, index, model, formula, agf or table");
        Layer layer;
        layer.medium = read_medium(object, unknown, here);
        layer.thickness_nm = read_thickness_nm(object, layer.medium);
        if (const auto k = object.find("k")) read_extinction(*k, layer);
        stack.layers.push_back(std::move(layer));
    }
    return stack;
}

Coating read_described_coating(const JsonAt& value, UnknownFields& unknown) {
    constexpr std::string_view expected =
        "\"none\", the name of a library coating, {\"quarter_wave\": {…}}, {\"layers\": […]}, "
        "{\"measured\": {…}} or {\"constant\": {…}}";
    if (value.value().is_string() && is_same_name(value.text(), "none")) return Uncoated{};
    value.require_object(expected);
    const auto quarter_wave = value.find("quarter_wave");
    const auto layers = value.find("layers");
    const auto measured = value.find("measured");
    const auto constant = value.find("constant");
    const int kinds =
        (quarter_wave ? 1 : 0) + (layers ? 1 : 0) + (measured ? 1 : 0) + (constant ? 1 : 0);
    if (kinds != 1) value.refuse("not a known coating", expected);
    if (layers)
        keep_unknown(value, {"layers", "from", "name"}, unknown, "coating");
    else
        keep_unknown(value, {"quarter_wave", "measured", "constant"}, unknown, "coating");
    if (quarter_wave) return read_quarter_wave(*quarter_wave, unknown);
    if (measured) return read_measured(*measured, unknown);
    if (constant) return read_constant(*constant, unknown);
    return read_stack(value, *layers, unknown);
}

Coating read_coating(const JsonAt& value, UnknownFields& unknown) {
    if (value.value().is_string() && !is_same_name(value.text(), "none"))
        return library_coating(value);
    if (value.value().is_object() && value.find("library"))
        return library_coating(*value.find("library"));
    return read_described_coating(value, unknown);
}

Json describe_coating(const Coating& coating) { return std::visit(WriteCoating{}, coating); }

Json write_coating(const Coating& coating) {
    std::string name;
    if (const auto* stack = std::get_if<LayerStack>(&coating)) name = stack->name;
    if (const auto* table = std::get_if<MeasuredReflectance>(&coating)) name = table->name;
    return is_in_library(name, coating) ? Json(name) : describe_coating(coating);
}

}  // namespace ghostlight
