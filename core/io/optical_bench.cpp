#include "core/io/optical_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/io/import_notes.h"
#include "core/io/imported_asphere.h"
#include "core/io/listed_surface.h"
#include "core/io/optical_bench_text.h"
#include "core/io/stated_glass.h"

namespace ghostlight {
namespace {

/// The number of a row that is above 0 and finite.
std::optional<double> positive(const BenchVariable* variable, std::size_t position) {
    const auto value = value_in(variable, position);
    return value && *value > 0.0 && std::isfinite(*value) ? value : std::nullopt;
}

/// A thickness cell in a position; nothing where it is undefined there.
std::optional<double> thickness_in(const BenchText& text, const BenchSurface& surface,
                                   std::size_t position) {
    if (const auto number = parse_number(surface.thickness)) return number;
    return value_in(text.variable(surface.thickness), position);
}

bool is_variable(const BenchSurface& surface) { return !parse_number(surface.thickness); }

/// Positions in which every thickness is defined; the last one's is the sensor's and may be open.
std::vector<std::size_t> positions_of(const BenchText& text, Notes& notes) {
    std::size_t columns = 1;
    for (const auto& [name, variable] : text.variables)
        columns = std::max(columns, variable.values.size());
    for (std::size_t i = 0; i < text.surfaces.size(); ++i) {
        const BenchSurface& surface = text.surfaces[i];
        const bool is_last = i + 1 == text.surfaces.size();
        if (is_variable(surface) && text.variable(surface.thickness) == nullptr &&
            !(is_last && (surface.thickness.empty() || is_same_name(surface.thickness, "Bf"))))
            surface.place.refuse("the thickness is neither a number nor a variable distance",
                                 in_quotes(surface.thickness),
                                 "a number, or the name of a row in [variable distances]");
    }
    std::vector<std::size_t> complete;
    for (std::size_t position = 0; position < columns; ++position) {
        bool fine = true;
        std::string missing;
        for (std::size_t i = 0; i < text.surfaces.size(); ++i) {
            const auto mm = thickness_in(text, text.surfaces[i], position);
            const bool is_last = i + 1 == text.surfaces.size();
            if ((!mm && !is_last) || (mm && !std::isfinite(*mm))) {
                fine = false;
                missing = text.surfaces[i].thickness;
            }
        }
        if (fine)
            complete.push_back(position);
        else
            note_left_out(
                notes, "[variable distances]",
                fmt::format("position {}: {} has no value there", position + 1, in_quotes(missing)),
                true);
    }
    if (complete.empty())
        text.surfaces.front().place.refuse("no position has all its thicknesses",
                                           fmt::format("{} positions", columns),
                                           "a value for every variable distance that is used");
    return complete;
}

std::string position_name(const BenchText& text, std::size_t position) {
    std::string name;
    if (const auto focal = positive(text.variable("Focal Length"), position))
        name = fmt::format("{} mm", *focal);
    const auto distance = value_in(text.variable("d0"), position);
    const auto magnification = value_in(text.variable("Magnification"), position);
    if (magnification && *magnification != 0.0 && std::isfinite(*magnification))
        name += fmt::format("{}magnification {}", name.empty() ? "" : ", ", *magnification);
    else if (distance && std::isfinite(*distance))
        name += fmt::format("{}object at {} mm", name.empty() ? "" : ", ", *distance);
    return name.empty() ? fmt::format("position {}", position + 1) : name;
}

Published published_in(const BenchText& text, std::size_t position) {
    Published published;
    published.efl_mm = positive(text.variable("Focal Length"), position);
    published.f_number = positive(text.variable("F-Number"), position);
    published.bfd_mm = positive(text.variable("Bf"), position);
    const auto angle = positive(text.variable("Angle of View"), position);
    if (angle && *angle < 360.0) published.half_field_deg = 0.5 * *angle;
    return published;
}

/// Half the Aperture Diameter of a position.
std::optional<double> stop_radius_in(const BenchText& text, std::size_t position) {
    const auto diameter = positive(text.variable("Aperture Diameter"), position);
    return diameter ? std::optional(0.5 * *diameter) : std::nullopt;
}

void add_surface(const BenchText& text, std::size_t index, std::size_t position,
                 ImportedLens& result) {
    const BenchSurface& surface = text.surfaces[index];
    ListedSurface listed;
    listed.place = surface.place;
    if (is_same_name(surface.radius, "AS")) {
        if (!result.stop) {
            result.stop = index;
            listed.comment = "aperture stop";
        } else {
            note_noticed(result.notes, surface.place.where,
                         "a second aperture stop: the first is taken, this one is an opening",
                         true);
        }
    } else if (is_same_name(surface.radius, "FS")) {
        listed.comment = "field stop";
        note_read(result.notes, surface.place.where,
                  "a field stop: an opening that cuts rays at its clear radius");
    } else if (is_same_name(surface.radius, "CG")) {
        listed.comment = "cover glass";
    } else if (!is_same_name(surface.radius, "Infinity") &&
               !is_same_name(surface.radius, "-Infinity")) {
        listed.radius_mm =
            surface.place.number(surface.radius, "a radius in mm, Infinity, AS, FS or CG");
    }
    if (index + 1 < text.surfaces.size())
        listed.thickness_mm = thickness_in(text, surface, position).value_or(0.0);
    if (surface.diameter_mm) listed.semi_diameter_mm = 0.5 * *surface.diameter_mm;
    listed.medium_after =
        medium_of({surface.glass, surface.nd, surface.vd}, surface.place, result.notes);
    append_surface(result, listed);
}

/// Powers of the coefficients: 4, 6, 8 …; 2, 4, 6 …; or 3, 4, 5, 6 … as far as odd ones go.
std::vector<int> powers_of(const BenchText& text, std::size_t count) {
    std::vector<int> powers;
    const int odd = text.odd_terms.value_or(0);
    for (int i = 0; i < odd; ++i) {
        powers.push_back(3 + 2 * i);
        powers.push_back(4 + 2 * i);
    }
    int next = odd > 0 ? 4 + 2 * odd : text.has_square_term ? 2 : 4;
    for (; powers.size() < count; next += 2) powers.push_back(next);
    return powers;
}

void add_aspheres(const BenchText& text, ImportedLens& result) {
    std::set<std::string_view> ids;
    for (const BenchAsphere& asphere : text.aspheres) {
        if (!ids.insert(asphere.id).second)
            asphere.place.refuse("the surface's asphere is given twice", in_quotes(asphere.id),
                                 "one row for each surface");
        const auto row = std::ranges::find(text.surfaces, asphere.id, &BenchSurface::id);
        if (row == text.surfaces.end())
            asphere.place.refuse("there is no surface of this id", in_quotes(asphere.id),
                                 "an id of [lens data]");
        constexpr std::size_t most_terms = 40;
        if (asphere.terms.size() > most_terms)
            asphere.place.refuse("too many coefficients", fmt::format("{}", asphere.terms.size()),
                                 "at most 40");
        const auto index = static_cast<std::size_t>(row - text.surfaces.begin());
        const double c = curvature_per_mm(result.lens.surfaces[index].curve);
        // Both are rounded; a relative 1e-4 is a digit of a five-digit radius.
        if (asphere.radius_mm && *asphere.radius_mm != 0.0 &&
            std::abs(c * *asphere.radius_mm - 1.0) > 1e-4)
            note_noticed(result.notes, asphere.place.where,
                         fmt::format("radius {} here, {} in [lens data], which is used",
                                     *asphere.radius_mm, row->radius),
                         true);
        RadialSurface shape{c, asphere.conic, {}};
        const auto powers = powers_of(text, asphere.terms.size());
        for (std::size_t i = 0; i < asphere.terms.size(); ++i)
            if (asphere.terms[i] != 0.0) shape.terms[powers[i]] = asphere.terms[i];
        set_asphere(result, index, shape, asphere.place);
    }
}

/// One configuration for each position, when there are several.
void add_configurations(const BenchText& text, std::span<const std::size_t> positions,
                        ImportedLens& result) {
    std::set<std::string> names;
    for (const std::size_t position : positions) {
        Configuration configuration;
        configuration.name = position_name(text, position);
        if (names.contains(configuration.name))
            configuration.name += fmt::format(" (position {})", position + 1);
        names.insert(configuration.name);
        for (std::size_t i = 0; i < text.surfaces.size(); ++i)
            if (is_variable(text.surfaces[i]))
                if (const auto mm = thickness_in(text, text.surfaces[i], position))
                    configuration.thickness_mm[i] = *mm;
        configuration.published = published_in(text, position);
        configuration.stop_semi_diameter_mm = stop_radius_in(text, position);
        if (!configuration.stop_semi_diameter_mm)
            configuration.f_number = configuration.published.f_number;
        note_read(result.notes, "[variable distances]",
                  fmt::format(
                      "configuration {}: {} thicknesses{}{}", in_quotes(configuration.name),
                      configuration.thickness_mm.size(),
                      configuration.f_number ? fmt::format(", f/{}", *configuration.f_number)
                                             : std::string(),
                      configuration.stop_semi_diameter_mm
                          ? fmt::format(", stop radius {} mm", *configuration.stop_semi_diameter_mm)
                          : std::string()));
        result.lens.configurations.push_back(std::move(configuration));
    }
}

/// The stop's row is as wide as it ever opens; how far it does in the listed position is the
/// stop's own.
void set_stop(const BenchText& text, std::span<const std::size_t> positions, ImportedLens& result) {
    if (!result.stop) return;
    const std::size_t row = *result.stop;
    result.lens.stop.surface = row;
    double widest = 0.0;
    for (const std::size_t position : positions)
        widest = std::max(widest, stop_radius_in(text, position).value_or(0.0));
    if (widest == 0.0) return;
    result.surfaces[row].semi_diameter_mm = widest;
    result.lens.surfaces[row].semi_diameter_mm = widest;
    const auto here = stop_radius_in(text, positions.front());
    if (here && *here < widest) result.lens.stop.semi_diameter_mm = here;
    note_converted(
        result.notes, text.variable("Aperture Diameter")->place.where,
        fmt::format("the stop's clear radius is {} mm, half the widest Aperture Diameter", widest));
}

void read_fields(const BenchText& text, std::size_t position, ImportedLens& result) {
    const Published published = published_in(text, position);
    result.lens.published = published;
    result.stated_efl_mm = published.efl_mm;
    result.half_field_deg = published.half_field_deg;
    // A stated width of the stop is what the iris is; the f-number is what follows from it.
    if (!stop_radius_in(text, position)) result.f_number = published.f_number;
    if (const auto diagonal = positive(text.variable("Image Height"), position))
        result.image_height_mm = 0.5 * *diagonal;
    const auto distance = value_in(text.variable("d0"), position);
    if (distance && std::isfinite(*distance))
        note_left_out(result.notes, text.variable("d0")->place.where,
                      fmt::format("the object is {} mm away; lights are at infinity here, and the "
                                  "sensor stays where the file has it",
                                  *distance),
                      true);
}

}  // namespace

bool is_optical_bench(std::string_view text) {
    for (const TextLine& line : text_lines(text.substr(0, 65536))) {
        const std::string_view plain = trimmed(line.text);
        if (plain.starts_with('[') && (upper_case(plain).starts_with("[LENS DATA]") ||
                                       upper_case(plain).starts_with("[VARIABLE DISTANCES]") ||
                                       upper_case(plain).starts_with("[DESCRIPTIVE DATA]")))
            return true;
    }
    return false;
}

ImportedLens import_optical_bench(const FormatSource& source) {
    const std::string file = source.file.string();
    ImportedLens result;
    const BenchText text = read_bench_text(source.text, file, result.notes);
    const auto positions = positions_of(text, result.notes);
    const std::size_t first = positions.front();
    result.lens.name = text.title;
    result.lens.notes = text.remarks;
    for (std::size_t i = 0; i < text.surfaces.size(); ++i) add_surface(text, i, first, result);
    note_converted(result.notes, "[lens data]", "diameters are halved to clear radii");
    place_sensor(result, thickness_in(text, text.surfaces.back(), first), file);
    set_stop(text, positions, result);
    add_aspheres(text, result);
    read_fields(text, first, result);
    if (positions.size() > 1) add_configurations(text, positions, result);
    note_surfaces(result);
    return result;
}

}  // namespace ghostlight
