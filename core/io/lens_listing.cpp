#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/error.h"
#include "core/io/coating_json.h"
#include "core/io/lens_json.h"
#include "core/io/medium_json.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// A catalogue's index and a listing's, given to three or more decimals, agree within this.
constexpr double same_index = 1.5e-3;

constexpr std::string_view index_expected = "the index at d, from 1 to 10";

void warn(Notes& notes, const std::string& where, std::string text) {
    notes.push_back({Note::Severity::warning, where, std::move(text)});
}

std::optional<double> read_index(const JsonAt& row) {
    const auto nd = row.find("nd");
    if (!nd) return std::nullopt;
    return nd->number(index_expected, [](double n) { return n >= 1.0 && n <= 10.0; });
}

/// Nothing for the ways in which listings say that there is none: absent, null, 0.
std::optional<double> read_abbe_number(const JsonAt& row) {
    constexpr std::string_view expected = "an Abbe number above 0, or null for none";
    const auto vd = optional_number(row, "vd", expected);
    if (!vd || *vd == 0.0) return std::nullopt;
    if (!(*vd > 0.0)) row.at("vd", expected).refuse("not a usable Abbe number", expected);
    return vd;
}

/// What a formula gives at d against what the listing says it should.
void compare_index(const JsonAt& row, const Medium& medium, std::optional<double> nd,
                   Notes& notes) {
    double n = 0.0;
    try {
        n = refractive_index(medium, d_line_nm);
    } catch (const Error& error) {
        row.refuse(fmt::format("the dispersion formula gives no index at the d line ({})",
                               error.parts().problem),
                   "a formula that holds in visible light");
    }
    if (nd && std::abs(n - *nd) > same_index)
        warn(notes, row.path(),
             fmt::format("the formula of {} gives nd {:.5f}, the listing says {}; the formula is "
                         "used",
                         medium.name.empty() ? "the glass" : medium.name, n, *nd));
}

Medium from_index(const JsonAt& row, const std::string& name, double nd, Notes& notes) {
    if (nd == 1.0) return {};
    if (const auto vd = read_abbe_number(row)) return {name, ModelGlass{nd, *vd}};
    notes.push_back({Note::Severity::info, row.path(),
                     fmt::format("no Abbe number: index {} at every wavelength", nd)});
    return {name, ConstantIndex{nd}};
}

Medium read_listed_medium(const JsonAt& row, UnknownFields& unknown, Notes& notes) {
    const std::string name = optional_text(row, "glass");
    const auto nd = read_index(row);
    read_abbe_number(row);  // refused where it is wrong, used or not
    if (const auto sellmeier = row.find("sellmeier")) {
        FormulaGlass formula = read_formula(*sellmeier, "formula");
        if (const auto range = sellmeier->find("wavelength_range_um")) {
            constexpr std::string_view expected = "[shortest, longest] wavelength in µm";
            range->require_array(expected);
            if (range->size() != 2) range->refuse("not a range", expected);
            formula.min_nm = nm_from_um((*range)[0].number(expected));
            formula.max_nm = nm_from_um((*range)[1].number(expected));
        }
        keep_unknown(*sellmeier, {"formula", "coefficients", "wavelength_range_um"}, unknown,
                     "formula");
        const Medium medium{name, std::move(formula)};
        compare_index(row, medium, nd, notes);
        return medium;
    }
    const auto is_air_name = [](std::string text) {
        std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
        return text == "air";
    };
    if (is_air_name(name)) {
        if (nd.value_or(1.0) != 1.0)
            row.at("nd", index_expected).refuse("air has another index", "1");
        return {};
    }
    if (!name.empty()) {
        const Medium* known = find_glass(name);
        if (known != nullptr) {
            compare_index(row, *known, nd, notes);
            return *known;
        }
        if (!nd)
            row.at("glass", "a glass")
                .refuse("unknown glass, and no index beside it" + suggestion(name),
                        "a glass of the bundled catalogue, or nd and vd");
        warn(notes, row.path() + ".glass",
             fmt::format("glass '{}' is not in the catalogue{}: nd and vd are used", name,
                         suggestion(name)));
        return from_index(row, name, *nd, notes);
    }
    if (!nd) {
        const JsonAt missing = row.at("nd", index_expected);
        missing.refuse("no index", index_expected);
    }
    return from_index(row, {}, *nd, notes);
}

BaseCurve read_listed_curve(const JsonAt& row, bool is_stop) {
    constexpr std::string_view expected = "a radius in mm other than 0, or null for a plane";
    if (is_stop && !row.has("radius")) return Plane{};
    const JsonAt radius = row.at("radius", expected);
    if (radius.value().is_null()) return Plane{};
    return Radius{radius.number(expected, [](double mm) { return std::abs(mm) >= 1e-6; })};
}

bool is_marked_stop(const JsonAt& row) {
    const auto stop = row.find("stop");
    return stop && stop->boolean();
}

Surface read_row(const JsonAt& row, Notes& notes) {
    Surface surface;
    surface.curve = read_listed_curve(row, is_marked_stop(row));
    surface.conic = optional_number(row, "conic").value_or(0.0);
    if (const auto terms = row.find("asph")) {
        terms->require_array("an array [A4, A6, A8, …]");
        for (std::size_t i = 0; i < terms->size(); ++i)
            surface.aspheric.push_back((*terms)[i].number());
        if (surface.aspheric.size() > 20) terms->refuse("too many terms", "at most 20 (A4 to A42)");
    }
    constexpr std::string_view thickness =
        "the distance to the next surface (of the last, to the sensor), 0 to 1e6 mm";
    surface.thickness_mm = row.at("thickness", thickness).number(thickness, [](double mm) {
        return mm >= 0.0 && mm <= 1e6;
    });
    constexpr std::string_view semi_diameter = "the clear radius, above 0 and up to 1e6 mm";
    surface.semi_diameter_mm =
        row.at("semi_diameter", semi_diameter).number(semi_diameter, [](double mm) {
            return mm > 0.0 && mm <= 1e6;
        });
    surface.comment = optional_text(row, "comment");
    const std::size_t kept =
        keep_unknown(row,
                     {"radius", "conic", "asph", "thickness", "nd", "vd", "glass", "sellmeier",
                      "semi_diameter", "stop", "coating", "comment"},
                     surface.unknown);
    if (kept > 0) {
        std::string names;
        for (const auto& [name, text] : surface.unknown) names += " " + name;
        warn(notes, row.path(), "fields that are not known are kept but not used:" + names);
    }
    surface.medium_after = read_listed_medium(row, surface.unknown, notes);
    if (const auto coating = row.find("coating"))
        surface.coating = read_coating(*coating, surface.unknown);
    return surface;
}

/// From the row marked "stop": true, from stop_index (which counts from 0), or both.
std::size_t read_stop_row(const JsonAt& root, const JsonAt& surfaces) {
    std::optional<std::size_t> marked;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        if (!is_marked_stop(surfaces[i])) continue;
        if (marked)
            surfaces[i]
                .at("stop", "")
                .refuse(fmt::format("a second stop: surfaces[{}] is marked already", *marked + 1),
                        "one aperture stop");
        marked = i;
    }
    const auto index = root.find("stop_index");
    if (!index) {
        if (!marked)
            surfaces.refuse("the listing has no aperture stop",
                            "\"stop\": true on one surface, or stop_index");
        return *marked;
    }
    const long last = static_cast<long>(surfaces.size()) - 1;
    const auto listed = static_cast<std::size_t>(
        index->integer(0, last, fmt::format("a surface from 0 to {}", last)));
    if (marked && *marked != listed)
        index->refuse(
            fmt::format("\"stop\": true is on another surface, surfaces[{}]", *marked + 1),
            fmt::format("{} (it counts from 0)", *marked));
    return listed;
}

Published read_listed_published(const JsonAt& object) {
    object.require_object();
    Published published;
    published.efl_mm = optional_number(object, "efl");
    published.f_number = optional_number(object, "f_number");
    published.bfd_mm = optional_number(object, "bfd");
    published.half_field_deg = optional_number(object, "half_field_deg");
    keep_unknown(object, {"efl", "f_number", "bfd", "half_field_deg"}, published.unknown);
    return published;
}

void check_units(const JsonAt& root, Notes& notes) {
    const auto units = root.find("units");
    if (!units) {
        notes.push_back({Note::Severity::info, "units", "no units are given: taken as mm"});
        return;
    }
    std::string name = units->text("\"mm\"");
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const std::string_view known :
         {"mm", "millimetre", "millimetres", "millimeter", "millimeters"})
        if (name == known) return;
    units->refuse("only listings in mm can be read", "\"mm\"");
}

}  // namespace

LensFile lens_from_listing(const JsonAt& root) {
    LensFile result;
    Prescription& lens = result.lens;
    check_units(root, result.notes);
    lens.name = optional_text(root, "name");
    lens.source = optional_text(root, "source");
    lens.notes = optional_text(root, "notes");
    if (const auto published = root.find("published"))
        lens.published = read_listed_published(*published);

    constexpr std::string_view rows = "an array of at least one surface";
    const JsonAt surfaces = root.at("surfaces", rows);
    surfaces.require_array(rows);
    if (surfaces.size() == 0) surfaces.refuse("the lens has no surfaces", rows);
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        surfaces[i].require_object("a surface {radius, thickness, nd, vd, semi_diameter}");
    lens.stop.surface = read_stop_row(root, surfaces);
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        lens.surfaces.push_back(read_row(surfaces[i], result.notes));

    keep_unknown(root, {"name", "units", "source", "notes", "published", "stop_index", "surfaces"},
                 lens.unknown);
    validate_in_file(lens, root.file());
    const Notes odd = findings(lens);
    result.notes.insert(result.notes.end(), odd.begin(), odd.end());
    return result;
}

}  // namespace ghostlight
