#include "core/io/medium_json.h"

#include <fmt/format.h>

#include <vector>

#include "core/error.h"
#include "core/io/glass_library.h"
#include "core/io/lens_file.h"
#include "core/io/same_name.h"
#include "core/optics/dispersion_formula.h"

namespace ghostlight {
namespace {

const GlassCatalog& magnesium_fluoride_alone() {
    static const GlassCatalog catalog{{magnesium_fluoride()}};
    return catalog;
}

std::string below_of(std::string_view parent, std::string_view name) {
    return parent.empty() ? std::string(name) : fmt::format("{}/{}", parent, name);
}

std::string_view fitting_coefficients(int formula) {
    if (formula == 4) return "1, 5, 9, 11, … coefficients";
    if (formula >= 7) return formula == 8 ? "1 to 4 coefficients" : "1 to 6 coefficients";
    return "an odd number of coefficients";
}

std::vector<double> read_coefficients(const JsonAt& object) {
    const JsonAt coefficients = object.at("coefficients", "an array of numbers");
    coefficients.require_array("an array of numbers");
    std::vector<double> numbers;
    for (std::size_t i = 0; i < coefficients.size(); ++i)
        numbers.push_back(coefficients[i].number());
    return numbers;
}

template <class Glass>
void read_range(const JsonAt& formula, Glass& glass) {
    const auto range = formula.find("range_nm");
    if (!range) return;
    constexpr std::string_view expected = "[shortest, longest] wavelength in nm";
    range->require_array(expected);
    if (range->size() != 2) range->refuse("not a range", expected);
    glass.min_nm = (*range)[0].number(expected);
    glass.max_nm = (*range)[1].number(expected);
    if (!(glass.min_nm >= 0.0) || !(glass.max_nm > glass.min_nm || glass.max_nm == 0.0))
        range->refuse("not a range", expected);
}

AgfGlass read_agf_formula(const JsonAt& object) {
    object.require_object("an AGF formula with its number and coefficients");
    AgfGlass glass;
    constexpr std::string_view numbers = "the formula's number, 1 to 13";
    glass.formula =
        static_cast<int>(object.at("number", numbers).integer(1, last_agf_formula, numbers));
    glass.coefficients = read_coefficients(object);
    const std::size_t most = agf_coefficient_count(glass.formula);
    if (glass.coefficients.empty() || glass.coefficients.size() > most)
        object.at("coefficients", "numbers")
            .refuse(fmt::format("{} coefficients do not fit AGF formula {}",
                                glass.coefficients.size(), glass.formula),
                    fmt::format("1 to {} coefficients", most));
    read_range(object, glass);
    return glass;
}

std::vector<InternalTransmittance> read_transmittance(const JsonAt& rows) {
    constexpr std::string_view expected = "rows [wavelength in nm, share, thickness in mm]";
    rows.require_array(expected);
    std::vector<InternalTransmittance> table;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].require_array(expected);
        if (rows[i].size() != 3) rows[i].refuse("not a row of three", expected);
        table.push_back({rows[i][0].number(), rows[i][1].number(), rows[i][2].number()});
    }
    return table;
}

template <class Glass>
Json formula_json(const Glass& glass) {
    Json formula = {{"number", glass.formula}, {"coefficients", glass.coefficients}};
    if (glass.min_nm > 0.0 || glass.max_nm > 0.0)
        formula["range_nm"] = Json::array({glass.min_nm, glass.max_nm});
    return formula;
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
    void operator()(const FormulaGlass& glass) const { object["formula"] = formula_json(glass); }
    void operator()(const AgfGlass& glass) const { object["agf"] = formula_json(glass); }
    void operator()(const TabulatedGlass& glass) const {
        Json table = write_spectral_table(glass.index, "n");
        if (glass.held_beyond) table["held_beyond"] = true;
        object["table"] = std::move(table);
    }
};

}  // namespace

const Medium* find_glass(std::string_view name) {
    if (const Medium* found = magnesium_fluoride_alone().find(name)) return found;
    return bundled_glasses().find(name);
}

std::string suggestion(std::string_view unknown_glass) {
    const std::vector<std::string> names = similar_glasses(unknown_glass);
    return names.empty() ? std::string() : fmt::format(" (did you mean {}?)", names.front());
}

Medium named_glass(const JsonAt& name) {
    const std::string text = name.text("the name of a glass");
    if (is_same_name(text, "air")) return {};
    if (const Medium* known = find_glass(text)) return *known;
    if (const auto known = find_glass(text, {});
        known && is_same_name(known->glass.medium.name, text))
        return known->glass.medium;
    name.refuse("unknown glass" + suggestion(text),
                "a glass of the catalogues, \"air\", or model, index, formula, agf or table beside "
                "it");
}

FormulaGlass read_formula(const JsonAt& object, std::string_view number_key) {
    object.require_object("a formula with its number and coefficients");
    FormulaGlass glass;
    constexpr std::string_view numbers = "the formula's number, 1 to 9";
    glass.formula =
        static_cast<int>(object.at(number_key, numbers).integer(1, last_formula, numbers));
    glass.coefficients = read_coefficients(object);
    if (!fits_formula(glass.formula, glass.coefficients.size()))
        object.at("coefficients", "numbers")
            .refuse(fmt::format("{} coefficients do not fit formula {}", glass.coefficients.size(),
                                glass.formula),
                    fitting_coefficients(glass.formula));
    return glass;
}

SpectralTable read_spectral_table(const JsonAt& object, std::string_view value_key) {
    constexpr std::string_view expected = "wavelengths in nm, and as many values";
    object.require_object();
    const JsonAt wavelengths = object.at("nm", expected);
    const JsonAt values = object.at(value_key, expected);
    wavelengths.require_array(expected);
    values.require_array(expected);
    if (values.size() != wavelengths.size()) values.refuse("wrong number of values", expected);
    SpectralTable table;
    for (std::size_t i = 0; i < wavelengths.size(); ++i)
        table.push_back({wavelengths[i].number(expected), values[i].number(expected)});
    if (!has_rising_wavelengths(table))
        wavelengths.refuse("not usable wavelengths", "at least one, above 0 and rising");
    return table;
}

Json write_spectral_table(const SpectralTable& table, std::string_view value_key) {
    Json wavelengths = Json::array(), values = Json::array();
    for (const SpectralValue& entry : table) {
        wavelengths.push_back(entry.wavelength_nm);
        values.push_back(entry.value);
    }
    return Json{{"nm", std::move(wavelengths)}, {std::string(value_key), std::move(values)}};
}

Medium read_medium(const JsonAt& object, UnknownFields& unknown, const std::string& below) {
    const auto glass = object.find("glass");
    const auto model = object.find("model");
    const auto index = object.find("index");
    const auto formula = object.find("formula");
    const auto agf = object.find("agf");
    const auto table = object.find("table");
    const auto nobodys = object.find("unknown_glass");
    const int kinds = (model ? 1 : 0) + (index ? 1 : 0) + (formula ? 1 : 0) + (agf ? 1 : 0) +
                      (table ? 1 : 0) + (nobodys ? 1 : 0);
    if (kinds > 1)
        object.refuse("more than one of model, index, formula, agf, table and unknown_glass",
                      "one of them");
    Medium medium;
    if (kinds == 0) {
        if (glass) medium = named_glass(*glass);
    } else {
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
        } else if (agf) {
            medium.dispersion = read_agf_formula(*agf);
            keep_unknown(*agf, {"number", "coefficients", "range_nm"}, unknown,
                         below_of(below, "agf"));
        } else if (table) {
            TabulatedGlass measured{read_spectral_table(*table, "n")};
            if (const auto held = table->find("held_beyond"))
                measured.held_beyond = held->boolean();
            keep_unknown(*table, {"nm", "n", "held_beyond"}, unknown, below_of(below, "table"));
            medium.dispersion = std::move(measured);
        } else {
            FormulaGlass closed_form = read_formula(*formula, "number");
            keep_unknown(*formula, {"number", "coefficients", "range_nm"}, unknown,
                         below_of(below, "formula"));
            read_range(*formula, closed_form);
            medium.dispersion = std::move(closed_form);
        }
    }
    if (const auto rows = object.find("transmittance"))
        medium.transmittance = read_transmittance(*rows);
    return medium;
}

void write_medium(Json& object, const Medium& medium) {
    if (medium == Medium{}) return;
    if (!medium.name.empty()) object["glass"] = medium.name;
    if (is_catalogued(medium)) return;
    std::visit(WriteDispersion{object}, medium.dispersion);
    if (medium.transmittance.empty()) return;
    Json& rows = object["transmittance"] = Json::array();
    for (const InternalTransmittance& at : medium.transmittance)
        rows.push_back(Json::array({at.wavelength_nm, at.share, at.thickness_mm}));
}

}  // namespace ghostlight
