#include "core/io/medium_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "core/io/lens_file.h"

namespace ghostlight {
namespace {

std::string lower_case(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(), [](unsigned char c) { return std::tolower(c); });
    return out;
}

const GlassCatalog& magnesium_fluoride_alone() {
    static const GlassCatalog catalog{{magnesium_fluoride()}};
    return catalog;
}

std::string below_of(std::string_view parent, std::string_view name) {
    return parent.empty() ? std::string(name) : fmt::format("{}/{}", parent, name);
}

/// Pairs of coefficients follow a leading one; formula 4 begins with two groups of four.
bool fits_formula(int formula, std::size_t coefficients) {
    if (coefficients % 2 == 0) return false;
    return formula != 4 || coefficients == 1 || coefficients == 5 || coefficients >= 9;
}

Medium named_glass(const JsonAt& name) {
    const std::string text = name.text("the name of a glass");
    if (lower_case(text) == "air") return {};
    if (const Medium* known = find_glass(text)) return *known;
    name.refuse("unknown glass" + suggestion(text),
                "a glass of the bundled catalogue, \"air\", or model, index or formula beside it");
}

/// True when the name alone says it all.
bool is_catalogued(const Medium& medium) {
    if (medium.name.empty() || !std::holds_alternative<FormulaGlass>(medium.dispersion))
        return false;
    try {
        const Medium* known = find_glass(medium.name);
        return known != nullptr && *known == medium;
    } catch (const Error&) {
        // Without a catalogue at hand the formula goes into the file: saving must not fail.
        return false;
    }
}

struct WriteDispersion {
    Json& object;

    void operator()(const ConstantIndex& glass) const { object["index"] = glass.n; }
    void operator()(const UnknownGlass& glass) const { object["unknown_glass"] = glass.why; }
    void operator()(const ModelGlass& glass) const {
        object["model"] = Json{{"nd", glass.nd}, {"vd", glass.vd}};
    }
    void operator()(const FormulaGlass& glass) const {
        Json formula = {{"number", glass.formula}, {"coefficients", glass.coefficients}};
        if (glass.min_nm > 0.0 || glass.max_nm > 0.0)
            formula["range_nm"] = Json::array({glass.min_nm, glass.max_nm});
        object["formula"] = std::move(formula);
    }
};

std::variant<IdealIndex, Medium> read_layer_medium(const JsonAt& layer, UnknownFields& unknown,
                                                   const std::string& below) {
    constexpr std::string_view expected =
        "\"ideal\", the name of a glass such as \"MgF2\", an index, or an object with glass, "
        "index, model or formula";
    if (layer.value().is_number()) return Medium{"", ConstantIndex{layer.number()}};
    if (layer.value().is_string()) {
        if (lower_case(layer.text()) == "ideal") return IdealIndex{};
        return named_glass(layer);
    }
    layer.require_object(expected);
    keep_unknown(layer, {"glass", "model", "index", "formula"}, unknown, below);
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
            if (layer.extinction != 0.0) object["k"] = layer.extinction;
            object["thickness_nm"] = layer.thickness_nm;
            layers.push_back(std::move(object));
        }
        return Json{{"layers", std::move(layers)}};
    }
};

}  // namespace

const Medium* find_glass(std::string_view name) {
    if (const Medium* found = magnesium_fluoride_alone().find(name)) return found;
    return bundled_glasses().find(name);
}

std::string suggestion(std::string_view unknown_glass) {
    const std::string wanted = lower_case(unknown_glass);
    if (wanted.size() < 2) return {};
    for (const Medium& glass : bundled_glasses().glasses) {
        const std::string name = lower_case(glass.name);
        if (name.ends_with("-" + wanted) || wanted.ends_with("-" + name))
            return fmt::format(" (did you mean {}?)", glass.name);
    }
    return {};
}

FormulaGlass read_formula(const JsonAt& object, std::string_view number_key) {
    object.require_object("a formula with its number and coefficients");
    FormulaGlass glass;
    constexpr std::string_view numbers = "the formula's number, 1 to 6";
    glass.formula = static_cast<int>(object.at(number_key, numbers).integer(1, 6, numbers));
    const JsonAt coefficients = object.at("coefficients", "an array of numbers");
    coefficients.require_array("an array of numbers");
    for (std::size_t i = 0; i < coefficients.size(); ++i)
        glass.coefficients.push_back(coefficients[i].number());
    if (!fits_formula(glass.formula, glass.coefficients.size()))
        coefficients.refuse(
            fmt::format("{} coefficients do not fit formula {}", coefficients.size(),
                        glass.formula),
            glass.formula == 4 ? "1, 5, 9, 11, … coefficients" : "an odd number of coefficients");
    return glass;
}

Medium read_medium(const JsonAt& object, UnknownFields& unknown, const std::string& below) {
    const auto glass = object.find("glass");
    const auto model = object.find("model");
    const auto index = object.find("index");
    const auto formula = object.find("formula");
    const auto nobodys = object.find("unknown_glass");
    if ((model ? 1 : 0) + (index ? 1 : 0) + (formula ? 1 : 0) + (nobodys ? 1 : 0) > 1)
        object.refuse("more than one of model, index, formula and unknown_glass", "one of them");
    if (!model && !index && !formula && !nobodys) return glass ? named_glass(*glass) : Medium{};

    Medium medium;
    if (glass) medium.name = glass->text("the name of a glass");
    if (nobodys) {
        medium.dispersion = UnknownGlass{nobodys->text("why the glass is not known")};
    } else if (index) {
        medium.dispersion = ConstantIndex{index->number("an index")};
    } else if (model) {
        model->require_object("{\"nd\": …, \"vd\": …}");
        keep_unknown(*model, {"nd", "vd"}, unknown, below_of(below, "model"));
        medium.dispersion =
            ModelGlass{model->at("nd", "the index at d").number("the index at d"),
                       model->at("vd", "the Abbe number").number("the Abbe number")};
    } else {
        FormulaGlass closed_form = read_formula(*formula, "number");
        keep_unknown(*formula, {"number", "coefficients", "range_nm"}, unknown,
                     below_of(below, "formula"));
        if (const auto range = formula->find("range_nm")) {
            constexpr std::string_view expected = "[shortest, longest] wavelength in nm";
            range->require_array(expected);
            if (range->size() != 2) range->refuse("not a range", expected);
            closed_form.min_nm = (*range)[0].number(expected);
            closed_form.max_nm = (*range)[1].number(expected);
            if (!(closed_form.min_nm >= 0.0) ||
                !(closed_form.max_nm > closed_form.min_nm || closed_form.max_nm == 0.0))
                range->refuse("not a range", expected);
        }
        medium.dispersion = std::move(closed_form);
    }
    return medium;
}

void write_medium(Json& object, const Medium& medium) {
    if (medium == Medium{}) return;
    if (!medium.name.empty()) object["glass"] = medium.name;
    if (!is_catalogued(medium)) std::visit(WriteDispersion{object}, medium.dispersion);
}

LayerStack read_layers(const JsonAt& array, UnknownFields& unknown, const std::string& below) {
    array.require_array("an array of layers");
    LayerStack stack;
    for (std::size_t i = 0; i < array.size(); ++i) {
        const JsonAt object = array[i];
        object.require_object("a layer {index or glass, k, thickness_nm}");
        const std::string here = fmt::format("{}/{}", below, i);
        keep_unknown(object, {"glass", "model", "index", "formula", "k", "thickness_nm"}, unknown,
                     here);
        if (!object.find("glass") && !object.find("index") && !object.find("model") &&
            !object.find("formula"))
            object.refuse("the layer's medium is missing", "glass, index, model or formula");
        Layer layer;
        layer.medium = read_medium(object, unknown, here);
        layer.thickness_nm =
            object.at("thickness_nm", "the layer's thickness in nm").number("a thickness in nm");
        layer.extinction = optional_number(object, "k").value_or(0.0);
        stack.layers.push_back(std::move(layer));
    }
    return stack;
}

Coating read_coating(const JsonAt& value, UnknownFields& unknown) {
    constexpr std::string_view expected = "\"none\", {\"quarter_wave\": {…}} or {\"layers\": […]}";
    if (value.value().is_string() && lower_case(value.text()) == "none") return Uncoated{};
    value.require_object(expected);
    const auto quarter_wave = value.find("quarter_wave");
    const auto layers = value.find("layers");
    if (quarter_wave.has_value() == layers.has_value())
        value.refuse("not a known coating", expected);
    keep_unknown(value, {"quarter_wave", "layers"}, unknown, "coating");
    if (quarter_wave) return read_quarter_wave(*quarter_wave, unknown);
    return read_layers(*layers, unknown, "coating/layers");
}

Json write_coating(const Coating& coating) { return std::visit(WriteCoating{}, coating); }

}  // namespace ghostlight
