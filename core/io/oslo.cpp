#include "core/io/oslo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/import_notes.h"
#include "core/io/import_steps.h"
#include "core/io/imported_asphere.h"
#include "core/io/listed_surface.h"
#include "core/io/oslo_text.h"
#include "core/io/stated_glass.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// OSLO's infinity is 1e10 lens units or more, its "no limit" for apertures 1e6 and more.
constexpr double infinite_distance = 1e8;
constexpr double infinite_aperture = 1e6;

/// n(λ) = nd + B (1/λ² − 1/λd²): B from the shortest and the longest wavelength, nd from the one
/// nearest to d. With the lines d, F and C that is nd and Vd as they are defined.
Medium model_glass(const std::string& name, std::span<const double> wavelengths_um,
                   std::span<const double> indices, const Place& place, Notes& notes) {
    const auto inverse_square = [](double um) { return 1.0 / (um * um); };
    const double at_d = inverse_square(um_from_nm(d_line_nm));
    std::size_t shortest = 0, longest = 0, nearest = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (wavelengths_um[i] < wavelengths_um[shortest]) shortest = i;
        if (wavelengths_um[i] > wavelengths_um[longest]) longest = i;
        if (std::abs(wavelengths_um[i] - um_from_nm(d_line_nm)) <
            std::abs(wavelengths_um[nearest] - um_from_nm(d_line_nm)))
            nearest = i;
    }
    const double spread =
        inverse_square(wavelengths_um[shortest]) - inverse_square(wavelengths_um[longest]);
    const double b = spread > 0.0 ? (indices[shortest] - indices[longest]) / spread : 0.0;
    const double nd = indices[nearest] - b * (inverse_square(wavelengths_um[nearest]) - at_d);
    const double f_minus_c =
        inverse_square(um_from_nm(f_line_nm)) - inverse_square(um_from_nm(c_line_nm));
    const double vd = b > 0.0 ? (nd - 1.0) / (b * f_minus_c) : 0.0;
    double worst = 0.0;
    for (std::size_t i = 0; i < indices.size(); ++i)
        worst = std::max(
            worst, std::abs(nd + b * (inverse_square(wavelengths_um[i]) - at_d) - indices[i]));
    note_converted(
        notes, place.where,
        fmt::format("glass {}: nd {:.5f} and Vd {:.2f} from the indices at {} wavelengths, which "
                    "they meet within {:.1g}",
                    in_quotes(name), nd, vd, indices.size(), worst));
    return medium_of({.name = {}, .nd = nd, .vd = vd}, place, notes);
}

/// O_PBH1, H_LAF2: a letter for the maker before the name.
Medium named_glass(const std::string& name, const Place& place, Notes& notes) {
    Notes of_name;
    const Medium medium = medium_of({.name = name}, place, of_name);
    const bool has_maker = name.size() > 2 && name[1] == '_';
    if (has_maker && std::holds_alternative<UnknownGlass>(medium.dispersion)) {
        Notes of_rest;
        const Medium rest = medium_of({.name = name.substr(2)}, place, of_rest);
        if (!std::holds_alternative<UnknownGlass>(rest.dispersion)) {
            note_converted(notes, place.where,
                           fmt::format("glass {}: its first letter is the maker's, {} is looked up",
                                       in_quotes(name), in_quotes(name.substr(2))));
            notes.insert(notes.end(), of_rest.begin(), of_rest.end());
            return rest;
        }
    }
    notes.insert(notes.end(), of_name.begin(), of_name.end());
    return medium;
}

Medium medium_of_parts(const OsloSurface& surface, Notes& notes) {
    const auto& parts = surface.glass;
    const Place& place = surface.glass_place;
    if (parts.empty()) return {};
    std::string name;
    std::vector<double> numbers;
    const bool is_model = is_same_name(parts[0], "MOD");
    for (std::size_t i = is_model ? 1 : 0; i < parts.size(); ++i) {
        if (const auto number = parse_number(parts[i]))
            numbers.push_back(*number);
        else if (name.empty())
            name = clipped(parts[i], 60);
    }
    if (!is_model && !name.empty()) return named_glass(name, place, notes);
    if (numbers.empty())
        place.refuse("no glass is named", in_quotes(parts[0]), "a glass or its indices");
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (!(numbers[i] >= 1.0 && (numbers[i] <= 10.0 || i > 0)))
            place.refuse("not a usable index", fmt::format("{}", numbers[i]),
                         "an index from 1 to 10");
    // MOD 1.6 50: index and Abbe number.
    if (numbers.size() == 2 && numbers[1] > 10.0)
        return medium_of({.nd = numbers[0], .vd = numbers[1]}, place, notes);
    std::span<const double> wavelengths = surface.glass_wavelengths_um;
    const std::size_t both = std::min(wavelengths.size(), numbers.size());
    const bool differs = std::ranges::any_of(numbers, [&](double n) { return n != numbers[0]; });
    if (both < 2 || !differs) return medium_of({.nd = numbers[0]}, place, notes);
    return model_glass(name, wavelengths.first(both), std::span(numbers).first(both), place, notes);
}

/// The marginal ray through the lens, which solves the thicknesses and curvatures that are left to
/// it. Heights in lens units at each surface.
struct MarginalRay {
    double height, slope;
    std::vector<double> heights = {};
};

/// Nothing for a glass that nobody knows; the report has it already.
std::optional<double> index_of(const Medium& medium, double wavelength_nm) {
    try {
        return refractive_index(medium, wavelength_nm);
    } catch (const Error&) {
        return std::nullopt;
    }
}

void require_ray(bool known, bool has_beam, double wanted, const OsloSurface& surface) {
    if (!known)
        surface.place.refuse("a solve needs the index of a glass that nobody knows", "PY or PU",
                             "the solved number itself, or a known glass");
    if (!has_beam && wanted != 0.0)
        surface.place.refuse("a solve needs the height of the entrance beam", "no EBR",
                             "EBR, or the solved number itself");
}

void solve(OsloText& text, std::span<const Medium> media, MarginalRay& ray, Notes& notes) {
    const double wavelength_nm =
        text.wavelengths_um.empty() ? d_line_nm : nm_from_um(text.wavelengths_um[0]);
    const bool has_beam = text.beam_radius.has_value();
    double before = 1.0;
    bool known = true;
    ray.heights.assign(text.surfaces.size(), 0.0);
    for (std::size_t i = 1; i + 1 < text.surfaces.size(); ++i) {
        OsloSurface& surface = text.surfaces[i];
        const auto index = index_of(media[i], wavelength_nm);
        if (known) ray.heights[i] = ray.height;
        known = known && index;
        const double after = index.value_or(1.0);
        if (surface.slope_solve && !surface.radius && !surface.curvature) {
            require_ray(known, has_beam, *surface.slope_solve, surface);
            const double power = ray.height * (after - before);
            if (power == 0.0)
                surface.place.refuse("a curvature solve that has no answer", "PU",
                                     "a change of index and a ray off the axis");
            surface.curvature = (before * ray.slope - after * *surface.slope_solve) / power;
            note_converted(notes, surface.place.where,
                           fmt::format("curvature {} per lens unit from the solve PU {}",
                                       *surface.curvature, *surface.slope_solve));
        }
        double c = surface.curvature.value_or(0.0);
        if (surface.radius && *surface.radius != 0.0) c = 1.0 / *surface.radius;
        const auto square = surface.terms.find(2);
        if (square != surface.terms.end()) c += 2.0 * square->second;
        ray.slope = (before * ray.slope - ray.height * c * (after - before)) / after;
        if (surface.height_solve && !surface.thickness && i + 2 < text.surfaces.size()) {
            require_ray(known, has_beam, *surface.height_solve, surface);
            if (ray.slope == 0.0)
                surface.place.refuse("a thickness solve that has no answer", "PY",
                                     "a ray that is not parallel to the axis");
            surface.thickness = (*surface.height_solve - ray.height) / ray.slope;
            note_converted(notes, surface.place.where,
                           fmt::format("thickness {} lens units from the solve PY {}",
                                       *surface.thickness, *surface.height_solve));
        }
        ray.height += ray.slope * surface.thickness.value_or(0.0);
        before = after;
    }
}

/// The clear radius in mm; none when it is to be sized.
std::optional<double> clear_radius(const OsloSurface& surface, double marginal, double unit_mm,
                                   bool sized_by_beam, Notes& notes) {
    const std::string& where = surface.aperture_place.where;
    if (!surface.aperture || *surface.aperture == 0.0) return std::nullopt;
    const double radius_mm = *surface.aperture * unit_mm;
    if (*surface.aperture >= infinite_aperture) return std::nullopt;
    if (surface.aperture_checked) {
        note_read(notes, where, fmt::format("AP CHK: rays beyond {} mm are stopped", radius_mm));
        return radius_mm;
    }
    if (sized_by_beam) {
        note_left_out(notes, where,
                      "AP of the stop only sizes the drawing: the stop follows the entrance beam");
        return std::nullopt;
    }
    if (std::abs(marginal) * unit_mm > radius_mm) {
        note_left_out(notes, where,
                      fmt::format("AP {} mm without CHK is only drawn, and less than the beam on "
                                  "the axis needs: to be sized",
                                  radius_mm),
                      true);
        return std::nullopt;
    }
    note_noticed(notes, where,
                 fmt::format("AP without CHK only sizes the drawing in OSLO, which lets rays pass "
                             "beyond it; here the glass ends at {} mm",
                             radius_mm),
                 true, "raise the semi-diameter if the glass is larger");
    return radius_mm;
}

void read_system(const OsloText& text, ImportedLens& result) {
    const double unit = text.unit_mm;
    Published& published = result.lens.published;
    if (text.efl && *text.efl != 100.0 && *text.efl > 0.0 && *text.efl * unit <= 1e6) {
        result.stated_efl_mm = published.efl_mm = *text.efl * unit;
        note_read(result.notes, {}, fmt::format("focal length {} mm", *published.efl_mm));
    }
    if (text.beam_radius && *text.beam_radius > 0.0 && *text.beam_radius * unit <= 1e6) {
        result.entrance_pupil_diameter_mm = 2.0 * *text.beam_radius * unit;
        note_converted(result.notes, {},
                       fmt::format("entrance beam radius: entrance pupil {} mm wide",
                                   *result.entrance_pupil_diameter_mm));
    }
    if (text.f_number && *text.f_number > 0.0) {
        result.f_number = published.f_number = text.f_number;
        note_read(result.notes, {}, fmt::format("f/{}", *text.f_number));
    }
    const double distance = std::abs(text.surfaces.front().thickness.value_or(infinite_distance));
    const bool is_far = distance >= infinite_distance;
    if (!is_far)
        note_left_out(result.notes, text.surfaces.front().place.where,
                      fmt::format("the object is {} mm away; lights are at infinity here, and the "
                                  "sensor stays where the file has it",
                                  distance * unit),
                      true);
    std::optional<double> half_field;
    if (text.field_deg)
        half_field = std::abs(*text.field_deg);
    else if (text.object_height && distance > 0.0)
        half_field = deg_from_rad(std::atan(std::abs(*text.object_height) / distance));
    if (half_field && *half_field > 0.0 && *half_field < 90.0) {
        result.half_field_deg = published.half_field_deg = half_field;
        note_read(result.notes, {}, fmt::format("half field {:.4g} degrees", *half_field));
    }
    if (text.image_height && std::abs(*text.image_height) * unit <= 1e6)
        result.image_height_mm = std::abs(*text.image_height) * unit;
    if (text.object_na)
        note_left_out(result.notes, {},
                      fmt::format("an aperture at the object (NAO {}): the stop is sized by the "
                                  "surfaces' own apertures",
                                  *text.object_na),
                      true, "set the stop's f-number");
}

void check_unit(const OsloText& text, ImportedLens& result) {
    if (!text.has_unit)
        note_assumed(result.notes, "UNI", "no UNI: lens units are taken as millimetres");
    else if (text.unit_mm != 1.0)
        note_converted(result.notes, "UNI", fmt::format("lens units of {} mm", text.unit_mm));
    const auto order = first_order_of(result.lens);
    constexpr double smallest_camera_lens_mm = 10.0;
    if (text.unit_mm == 1.0 && order && std::abs(order->efl_mm) < smallest_camera_lens_mm)
        note_noticed(
            result.notes, "UNI",
            fmt::format("UNI 1 means millimetres in files that OSLO wrote, but centimetres "
                        "in some libraries: the focal length is {:.4g} mm",
                        order->efl_mm),
            true, "if the lens is 10 times too small, put UNI 10 in the file");
}

}  // namespace

bool is_oslo(std::string_view text) {
    std::size_t blocks = 0;
    bool begins = false;
    for_each_oslo_command(text.substr(0, 65536), {}, [&](const OsloCommand& command) {
        begins = begins || (command.word == "LEN" && !command.parts.empty() &&
                            is_same_name(command.parts[0], "NEW"));
        if (command.word == "NXT") ++blocks;
    });
    return begins || blocks > 1;
}

ImportedLens import_oslo(const FormatSource& source) {
    const std::string file = source.file.string();
    ImportedLens result;
    OsloText text = read_oslo_text(source.text, file, result.notes);
    result.lens.name = text.name;
    const std::size_t image = text.surfaces.size() - 1;
    std::vector<Medium> media;
    for (const OsloSurface& surface : text.surfaces)
        media.push_back(medium_of_parts(surface, result.notes));
    if (!is_air(media.front()))
        text.surfaces.front().place.refuse("the object is not in air", "a glass before the lens",
                                           "AIR");

    MarginalRay ray{text.beam_radius.value_or(1.0), 0.0};
    const double distance = text.surfaces.front().thickness.value_or(infinite_distance);
    if (distance < infinite_distance && distance > 0.0) ray.slope = ray.height / distance;
    solve(text, media, ray, result.notes);

    const bool focused = text.surfaces[image - 1].height_solve.has_value() &&
                         !text.surfaces[image - 1].thickness.has_value();
    for (std::size_t i = 1; i < image; ++i) {
        const OsloSurface& surface = text.surfaces[i];
        ListedSurface listed;
        listed.place = surface.place;
        listed.radius_mm = surface.radius.value_or(0.0) * text.unit_mm;
        if (!surface.radius && surface.curvature && *surface.curvature != 0.0)
            listed.radius_mm = text.unit_mm / *surface.curvature;
        if (i + 1 < image) listed.thickness_mm = surface.thickness.value_or(0.0) * text.unit_mm;
        listed.medium_after = media[i];
        listed.comment = surface.note;
        const bool by_beam = surface.is_stop && (text.beam_radius || text.f_number);
        listed.semi_diameter_mm = clear_radius(surface, text.beam_radius ? ray.heights[i] : 0.0,
                                               text.unit_mm, by_beam, result.notes);
        if (surface.is_stop && !result.stop) result.stop = result.lens.surfaces.size();
        append_surface(result, listed);
    }
    for (std::size_t i = 1; i < image; ++i) {
        const OsloSurface& surface = text.surfaces[i];
        if (surface.conic == 0.0 && surface.terms.empty()) continue;
        RadialSurface asphere{
            curvature_per_mm(result.lens.surfaces[i - 1].curve), surface.conic, {}};
        for (const auto& [power, term] : surface.terms)
            asphere.terms[power] = term * std::pow(text.unit_mm, 1 - power);
        set_asphere(result, i - 1, asphere, surface.place);
    }
    if (!result.stop) {
        result.stop = 0;
        note_assumed(result.notes, {}, "no AST: the stop is surface 1, as in OSLO", true,
                     "choose the stop");
    }
    result.lens.stop.surface = *result.stop;

    std::optional<double> sensor_mm;
    const double shift = text.surfaces[image].thickness.value_or(0.0) * text.unit_mm;
    if (!focused) {
        sensor_mm = text.surfaces[image - 1].thickness.value_or(0.0) * text.unit_mm + shift;
        if (shift != 0.0)
            note_converted(
                result.notes, text.surfaces[image].place.where,
                fmt::format("the image surface's own thickness, {} mm, shifts the sensor", shift));
        if (!(std::abs(*sensor_mm) <= 1e6))
            text.surfaces[image - 1].place.refuse("not a usable distance of the image",
                                                  fmt::format("{} mm", *sensor_mm),
                                                  "a length up to 1e6 mm");
        if (*sensor_mm == 0.0) sensor_mm.reset();
    } else {
        note_read(result.notes, text.surfaces[image - 1].place.where,
                  "the image is at the paraxial focus (PY)");
    }
    if (!is_air(media[image - 1]))
        note_noticed(result.notes, text.surfaces[image - 1].place.where,
                     "the image is inside glass", true);
    place_sensor(result, sensor_mm, file);
    if (text.surfaces[image].aperture && *text.surfaces[image].aperture > 0.0 &&
        *text.surfaces[image].aperture < infinite_aperture && !result.image_height_mm)
        result.image_height_mm = *text.surfaces[image].aperture * text.unit_mm;
    read_system(text, result);
    check_unit(text, result);
    note_surfaces(result);
    return result;
}

}  // namespace ghostlight
