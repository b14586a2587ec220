#include "core/io/realflare.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/import_notes.h"
#include "core/io/json_value.h"
#include "core/io/listed_surface.h"
#include "core/io/stated_glass.h"
#include "core/io/stated_heights.h"

namespace ghostlight {
namespace {

double required(const JsonAt& element, const char* key, std::string_view expected) {
    return element.at(key, expected).number(expected);
}

/// "coating_lambda" and "coating_index" of some files, 0 for none.
Coating coating_of(const JsonAt& element, Notes& notes) {
    const double center_nm =
        optional_number(element, "coating_lambda", "a wavelength in nm").value_or(0.0);
    const double index = optional_number(element, "coating_index", "an index").value_or(0.0);
    if (center_nm == 0.0 || index == 0.0) return Uncoated{};
    if (!(center_nm >= 100.0 && center_nm <= 10000.0) || !(index >= 1.0 && index <= 5.0))
        element.refuse("not a usable coating",
                       "100 to 10000 nm and an index from 1 to 5, or 0 for none");
    note_converted(notes, element.path(),
                   fmt::format("coating: a quarter wave at {} nm of index {}", center_nm, index));
    return QuarterWave{center_nm, Medium{{}, ConstantIndex{index}}, 1.0};
}

void read_element(const JsonAt& element, ImportedLens& result, UnusedWords& unused) {
    element.require_object("an element {radius, distance, refractive_index, abbe_nr, height}");
    ListedSurface listed;
    listed.place = {element.file(), element.path()};
    listed.radius_mm = required(element, "radius", "a radius in mm, 0 for flat");
    listed.thickness_mm = required(element, "distance", "a distance in mm");
    listed.semi_diameter_mm = optional_number(element, "height", "a clear radius");
    listed.coating = coating_of(element, result.notes);
    listed.medium_after =
        medium_of({.nd = required(element, "refractive_index", "an index from 1"),
                   .vd = optional_number(element, "abbe_nr", "an Abbe number, 0 for air")},
                  listed.place, result.notes);
    for (const auto& [key, value] : element.value().items())
        if (key != "radius" && key != "distance" && key != "refractive_index" && key != "abbe_nr" &&
            key != "height" && key != "coating_lambda" && key != "coating_index")
            unused.add(key, element.path());
    append_surface(result, listed);
}

/// The index counts from 0 and should be that of a plane in air.
void read_stop(const JsonAt& root, ImportedLens& result) {
    const auto index = root.find("aperture_index");
    if (!index) return;
    const std::size_t count = result.lens.surfaces.size();
    const long last = static_cast<long>(count) - 1;
    const auto row = static_cast<std::size_t>(
        index->integer(0, last, fmt::format("an element from 0 to {}", last)));
    const auto is_opening = [&](std::size_t at) {
        return at < count && curvature_per_mm(result.lens.surfaces[at].curve) == 0.0 &&
               is_air(medium_before(result.lens, at)) &&
               is_air(result.lens.surfaces[at].medium_after);
    };
    result.stop = row;
    result.lens.stop.surface = row;
    note_read(result.notes, index->path(), fmt::format("the stop is surface {}", row + 1));
    if (is_opening(row)) return;
    const bool one_off = row > 0 && is_opening(row - 1);
    note_noticed(
        result.notes, index->path(),
        fmt::format("surface {}, which the file calls the stop, is not a plane in air{}", row + 1,
                    one_off ? fmt::format("; surface {} is", row) : std::string()),
        true,
        one_off ? fmt::format("set the stop to surface {}", row)
                : std::string("check which surface is the stop"));
}

}  // namespace

bool is_realflare(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    return begin != text.npos && text[begin] == '{' &&
           text.find("\"lens_elements\"") != text.npos &&
           text.find("\"ghostlight_lens\"") == text.npos;  // which may keep fields of others
}

ImportedLens import_realflare(const FormatSource& source) {
    const std::string file = source.file.string();
    const Json json = parse_json(source.text, file);
    const JsonAt root(json, file);
    root.require_object("a lens {…}");
    constexpr std::string_view rows = "an array of at least one element";
    const JsonAt elements = root.at("lens_elements", rows);
    elements.require_array(rows);
    if (elements.size() == 0) elements.refuse("the lens has no surfaces", rows);

    ImportedLens result;
    UnusedWords unused;
    result.lens.name = optional_text(root, "name");
    result.lens.notes = optional_text(root, "notes");
    if (const auto patent = root.find("patent_number"))
        result.lens.source =
            patent->value().is_string() ? patent->text() : excerpt(patent->value());
    if (const auto year = root.find("year"))
        result.lens.source +=
            fmt::format("{}{}", result.lens.source.empty() ? "" : ", ", excerpt(year->value()));
    if (const auto efl = optional_number(root, "focal_length"); efl && *efl > 0.0)
        result.stated_efl_mm = result.lens.published.efl_mm = efl;
    if (const auto f = optional_number(root, "fstop"); f && *f > 0.0)
        result.f_number = result.lens.published.f_number = f;
    for (std::size_t i = 0; i < elements.size(); ++i) read_element(elements[i], result, unused);
    for (const auto& [key, value] : root.value().items())
        if (key != "name" && key != "notes" && key != "patent_number" && key != "year" &&
            key != "focal_length" && key != "fstop" && key != "aperture_index" &&
            key != "lens_elements")
            unused.add(key, {});
    unused.report(result.notes);
    read_stop(root, result);
    const double last_mm = result.lens.surfaces.back().thickness_mm;
    place_sensor(result, last_mm != 0.0 ? std::optional(last_mm) : std::nullopt, file);
    settle_heights(result, result.f_number, false);
    note_surfaces(result);
    return result;
}

}  // namespace ghostlight
