#include "core/io/zmx_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/io/import_notes.h"
#include "core/io/imported_asphere.h"

namespace ghostlight {
namespace {

enum class Kind {
    sphere,            ///< and conics
    even,              ///< PARM i: r^(2i)
    odd,               ///< PARM i: r^i
    extended_even,     ///< XDAT: count, radius, then (r/radius)^(2i)
    extended_odd,      ///< XDAT: count, radius, then (r/radius)^i
    coordinate_break,  ///< PARM 1 to 5: decentres and tilts
    toroid,            ///< PARM 1: radius of rotation, 0 for a cylinder; PARM 2 on: terms in y
    biconic,           ///< PARM 1, 2: radius and conic in x
    plain_if_empty,    ///< plain when every parameter is 0: gratings, sag polynomials
    nothing,           ///< acts on polarisation or drawing alone
    ideal              ///< no surface at all
};

struct KnownType {
    std::string_view name;
    Kind kind;
    std::string_view meaning;
};
constexpr std::array known_types = {
    KnownType{"STANDARD", Kind::sphere, "sphere or conic"},
    KnownType{"EVENASPH", Kind::even, "even asphere"},
    KnownType{"ODDASPHE", Kind::odd, "odd asphere"},
    KnownType{"XASPHERE", Kind::extended_even, "extended asphere"},
    KnownType{"XOSPHERE", Kind::extended_odd, "extended odd asphere"},
    KnownType{"COORDBRK", Kind::coordinate_break, "coordinate break"},
    KnownType{"TOROIDAL", Kind::toroid, "toroid"},
    KnownType{"BICONICX", Kind::biconic, "biconic"},
    KnownType{"PARAXIAL", Kind::ideal, "ideal thin lens"},
    KnownType{"PARAX_XY", Kind::ideal, "ideal thin lens"},
    KnownType{"DGRATING", Kind::plain_if_empty, "diffraction grating"},
    KnownType{"BINARY_1", Kind::plain_if_empty, "diffractive surface"},
    KnownType{"BINARY_2", Kind::plain_if_empty, "diffractive surface"},
    KnownType{"BINARY_3", Kind::plain_if_empty, "diffractive surface"},
    KnownType{"XPOLYNOM", Kind::plain_if_empty, "extended polynomial"},
    KnownType{"POLYNOMI", Kind::plain_if_empty, "polynomial"},
    KnownType{"SZERNSAG", Kind::plain_if_empty, "Zernike sag"},
    KnownType{"FZERNSAG", Kind::plain_if_empty, "Zernike sag"},
    KnownType{"SZERNPHA", Kind::plain_if_empty, "Zernike phase"},
    KnownType{"FZERNPHA", Kind::plain_if_empty, "Zernike phase"},
    KnownType{"IRREGULA", Kind::plain_if_empty, "irregular surface"},
    KnownType{"TILTSURF", Kind::plain_if_empty, "tilted surface"},
    KnownType{"CHEBYSHE", Kind::plain_if_empty, "Chebyshev polynomial"},
    KnownType{"ATMOSPHR", Kind::nothing, "atmosphere"},
    KnownType{"JONESMAT", Kind::nothing, "Jones matrix"},
};

constexpr std::string_view of_revolution =
    "surfaces of revolution about the axis (STANDARD, EVENASPH, ODDASPHE, XASPHERE, XOSPHERE)";

double parameter(const std::map<int, double>& values, int number) {
    const auto found = values.find(number);
    return found == values.end() ? 0.0 : found->second;
}

bool all_zero(const std::map<int, double>& values, int from) {
    return std::ranges::all_of(
        values, [from](const auto& each) { return each.first < from || each.second == 0.0; });
}

/// a_p in mm^(1−p) from a coefficient in the file's unit.
double in_mm(double coefficient, int power, double mm_per_unit) {
    return coefficient * std::pow(mm_per_unit, 1 - power);
}

/// Terms of a polynomial in r; `step` 2 for even powers alone.
std::map<int, double> power_terms(const ZmxSurface& surface, int step, double mm_per_unit) {
    std::map<int, double> terms;
    for (const auto& [number, value] : surface.parameters)
        if (number >= 1 && number <= 8 && value != 0.0)
            terms[step * number] = in_mm(value, step * number, mm_per_unit);
    return terms;
}

std::map<int, double> extended_terms(const ZmxSurface& surface, int step, double mm_per_unit,
                                     const Place& place) {
    const double count = parameter(surface.extra, 1);
    constexpr double most = 240.0;
    if (!(count >= 0.0 && count <= most))
        place.refuse("not a usable number of terms", fmt::format("{}", count), "0 to 240");
    const double unit_radius = parameter(surface.extra, 2) * mm_per_unit;
    std::map<int, double> terms;
    for (int i = 1; i <= static_cast<int>(count); ++i) {
        const double value = parameter(surface.extra, 2 + i);
        if (value == 0.0) continue;
        if (!(unit_radius > 0.0))
            place.refuse("the extended asphere has no normalising radius",
                         fmt::format("{}", unit_radius), "XDAT 2 above 0");
        const int power = step * i;
        terms[power] = value * mm_per_unit / std::pow(unit_radius, power);
    }
    return terms;
}

void check_coordinate_break(ImportedLens& lens, const ZmxSurface& surface, bool bends_light_later,
                            const Place& place) {
    const bool moves = std::ranges::any_of(surface.parameters, [](const auto& each) {
        return each.first >= 1 && each.first <= 5 && each.second != 0.0;
    });
    if (!moves) {
        note_read(lens.notes, place.where,
                  "a coordinate break that moves nothing: a plane without glass");
    } else if (bends_light_later) {
        place.refuse("a coordinate break decentres or tilts the surfaces behind it",
                     "ghosts of a lens off its axis would be wrong here",
                     std::string(of_revolution));
    } else {
        note_left_out(lens.notes, place.where,
                      "a coordinate break behind the last glass tilts or decentres the image plane",
                      true, "the sensor stands upright on the axis here");
    }
}

/// A toroid or biconic of equal curvatures is a surface of revolution.
void require_round(const ZmxSurface& surface, Kind kind, std::string_view meaning,
                   const Place& place) {
    const double radius_x = parameter(surface.parameters, 1);
    const double x = radius_x == 0.0 ? 0.0 : 1.0 / radius_x;
    const double conic_x = kind == Kind::biconic ? parameter(surface.parameters, 2) : surface.conic;
    // Equal to the digits of a file.
    const bool round = std::abs(x - surface.curvature) <= 1e-9 * std::abs(x) &&
                       (x == 0.0 || conic_x == surface.conic) &&
                       all_zero(surface.parameters, kind == Kind::biconic ? 3 : 2) &&
                       all_zero(surface.extra, 1);
    if (!round)
        place.refuse(
            fmt::format("a {} ({}): its ghosts would be wrong here", meaning, surface.type),
            fmt::format("curvatures {} in y and {} in x", surface.curvature, x),
            std::string(of_revolution));
}

}  // namespace

void set_zmx_shape(ImportedLens& lens, std::size_t row, const ZmxSurface& surface,
                   double mm_per_unit, bool bends_light_later, const std::string& file) {
    const Place place{file, surface.where};
    const auto known = std::ranges::find(known_types, surface.type, &KnownType::name);
    if (known == known_types.end())
        place.refuse("a kind of surface that is not known here", surface.type,
                     std::string(of_revolution));
    Surface& made = lens.lens.surfaces[row];
    if (surface.curvature != 0.0) made.curve = Curvature{surface.curvature / mm_per_unit};
    made.conic = surface.conic;
    RadialSurface radial{surface.curvature / mm_per_unit, surface.conic, {}};
    switch (known->kind) {
        case Kind::sphere:
            break;
        case Kind::even:
            radial.terms = power_terms(surface, 2, mm_per_unit);
            break;
        case Kind::odd:
            radial.terms = power_terms(surface, 1, mm_per_unit);
            break;
        case Kind::extended_even:
            radial.terms = extended_terms(surface, 2, mm_per_unit, place);
            break;
        case Kind::extended_odd:
            radial.terms = extended_terms(surface, 1, mm_per_unit, place);
            break;
        case Kind::coordinate_break:
            check_coordinate_break(lens, surface, bends_light_later, place);
            made.curve = Plane{};
            made.conic = 0.0;
            break;
        case Kind::toroid:
        case Kind::biconic:
            require_round(surface, known->kind, known->meaning, place);
            break;
        case Kind::plain_if_empty: {
            // Counts and normalising radii come first in XDAT; alone they shape nothing.
            if (!all_zero(surface.parameters, 1) || !all_zero(surface.extra, 3))
                place.refuse(fmt::format("a {} ({}): its ghosts would be wrong here",
                                         known->meaning, surface.type),
                             "parameters other than 0", std::string(of_revolution));
            note_noticed(lens.notes, place.where,
                         fmt::format("{} ({}) without any terms: a plain surface", known->meaning,
                                     surface.type));
            break;
        }
        case Kind::nothing:
            note_left_out(
                lens.notes, place.where,
                fmt::format("{} ({}): only its plane is kept", known->meaning, surface.type), true);
            break;
        case Kind::ideal:
            place.refuse(fmt::format("an {} ({}) has no surfaces that could reflect",
                                     known->meaning, surface.type),
                         fmt::format("focal length {}", parameter(surface.parameters, 1)),
                         "the real lens in its place, or a file without it");
    }
    if (!radial.terms.empty()) set_asphere(lens, row, radial, place);
}

}  // namespace ghostlight
