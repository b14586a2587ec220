#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/io/import_steps.h"
#include "core/io/json_value.h"
#include "core/optics/rim.h"
#include "core/units.h"

namespace ghostlight {
namespace {

using Fate = Note::Fate;
using Severity = Note::Severity;

/// A stop within this of twice what the aperture needs is a diameter: lenses have rims a few
/// percent wider than their beams, not 80 %.
constexpr double least_diameter_ratio = 1.8, most_diameter_ratio = 2.2;
/// Smooth lens surfaces have radii of millimetres and more; curvatures are far below.
constexpr double largest_curvature_like_radius = 0.5;
/// Two focal lengths that differ by less are the same, rounded or at another wavelength.
constexpr double same_focal_length = 0.03;
/// Lengths from the first surface to the sensor, mm, outside which a unit may be mistaken.
constexpr double shortest_usual_mm = 1.0, longest_usual_mm = 5000.0;
/// Share of the focal length by which sensor and focus may differ before it looks like a slip.
constexpr double largest_usual_defocus = 0.05;

struct UnitRatio {
    double ratio;
    const char* meaning;
};
/// Stated over computed focal length, and what then was mistaken for what.
constexpr std::array unit_ratios = {
    UnitRatio{10.0, "the numbers look like centimetres"},
    UnitRatio{0.1, "the numbers look ten times too large"},
    UnitRatio{25.4, "the numbers look like inches"},
    UnitRatio{1.0 / 25.4, "the numbers look like millimetres that were converted from inches"},
    UnitRatio{1000.0, "the numbers look like metres"},
    UnitRatio{0.001, "the numbers look like micrometres"},
};

std::string listed(const std::vector<std::size_t>& rows) {
    std::string text;
    for (const std::size_t row : rows)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", row + 1);
    return text;
}

bool is_stated(const ImportedLens& imported, std::size_t row) {
    return imported.surfaces[row].semi_diameter_mm.value_or(0.0) > 0.0;
}

/// The stop as the stated aperture needs it, over the listed one, inverted; nothing if not stated.
std::optional<double> stop_ratio(const ImportedLens& imported) {
    const Prescription& lens = imported.lens;
    const std::size_t stop = lens.stop.surface;
    const auto order = first_order_of(lens);
    if (!order || !is_stated(imported, stop)) return std::nullopt;
    double pupil_radius = 0.0;
    if (imported.entrance_pupil_diameter_mm)
        pupil_radius = 0.5 * *imported.entrance_pupil_diameter_mm;
    else if (const auto f = imported.f_number ? imported.f_number : lens.published.f_number)
        pupil_radius = 0.5 * std::abs(order->efl_mm) / *f;
    const double ratio = order->entrance_pupil_radius_mm / pupil_radius;
    if (!std::isfinite(ratio) || !(ratio > 0.0)) return std::nullopt;
    return ratio;
}

void check_diameters(const ImportedLens& imported, Notes& notes) {
    const Prescription& lens = imported.lens;
    std::vector<std::size_t> beyond, still_beyond;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        if (!is_stated(imported, row)) continue;
        const double edge = edge_height_mm(lens.surfaces[row]);
        if (lens.surfaces[row].semi_diameter_mm > edge) beyond.push_back(row);
        if (0.5 * lens.surfaces[row].semi_diameter_mm > edge) still_beyond.push_back(row);
    }
    const auto ratio = stop_ratio(imported);
    const bool stop_says_so =
        ratio && *ratio >= least_diameter_ratio && *ratio <= most_diameter_ratio;
    const bool rims_say_so =
        !beyond.empty() && still_beyond.empty() && !(ratio && *ratio < least_diameter_ratio);
    if (!stop_says_so && !rims_say_so) return;
    std::string why;
    if (stop_says_so)
        why = fmt::format("the stop is {:.3g} times as wide as the stated aperture needs", *ratio);
    if (!beyond.empty())
        why += fmt::format("{}surface{} {} would be wider than {} radius of curvature",
                           why.empty() ? "" : ", and ", beyond.size() == 1 ? "" : "s",
                           listed(beyond), beyond.size() == 1 ? "its" : "their");
    notes.push_back({Severity::warning, "semi-diameters",
                     "the semi-diameters look like diameters: " + why, Fate::noticed, true,
                     "halve the semi-diameters (convert --halve-semi-diameters)"});
}

void check_radii(const ImportedLens& imported, Notes& notes) {
    double largest = 0.0, track_mm = 0.0;
    std::size_t curved = 0;
    for (const Surface& surface : imported.lens.surfaces) {
        track_mm += surface.thickness_mm;
        const double c = curvature_per_mm(surface.curve);
        if (c == 0.0) continue;
        ++curved;
        largest = std::max(largest, 1.0 / std::abs(c));
    }
    if (curved == 0 || largest > largest_curvature_like_radius || track_mm < 2.0 * largest) return;
    notes.push_back(
        {Severity::warning, "radii",
         fmt::format("no radius of curvature is above {:.3g} mm in a lens {:.4g} mm long: the "
                     "radii look like curvatures",
                     largest, track_mm),
         Fate::noticed, true, "take the radii as curvatures (convert --radii-are-curvatures)"});
}

void check_units(const ImportedLens& imported, Notes& notes) {
    const auto order = first_order_of(imported.lens);
    const auto stated =
        imported.stated_efl_mm ? imported.stated_efl_mm : imported.lens.published.efl_mm;
    if (order && stated && *stated > 0.0 && std::isfinite(order->efl_mm)) {
        const double ratio = *stated / std::abs(order->efl_mm);
        if (std::abs(ratio - 1.0) <= same_focal_length) return;
        const std::string found = fmt::format(
            "the stated focal length is {:.6g} mm, that of the "
            "surfaces {:.6g} mm",
            *stated, order->efl_mm);
        for (const UnitRatio& unit : unit_ratios)
            if (std::abs(ratio / unit.ratio - 1.0) <= same_focal_length) {
                notes.push_back(
                    {Severity::warning, "units", found + ": " + unit.meaning, Fate::noticed, true,
                     fmt::format("scale the lens by {} (convert --scale {})",
                                 format_number(unit.ratio), format_number(unit.ratio))});
                return;
            }
        notes.push_back({Severity::warning, "units", found, Fate::noticed, true,
                         fmt::format("if the lens is normalised, scale it by {:.6g} (convert "
                                     "--scale {:.6g}); else look for a mistyped number",
                                     ratio, ratio)});
        return;
    }
    double length_mm = 0.0;
    for (const Surface& surface : imported.lens.surfaces) length_mm += surface.thickness_mm;
    if (imported.lens.sensor.at_paraxial_focus && order) length_mm += order->bfd_mm;
    if (length_mm > 0.0 && (length_mm < shortest_usual_mm || length_mm > longest_usual_mm))
        notes.push_back({Severity::warning, "units",
                         fmt::format("the lens is {:.4g} mm long, which is unusual", length_mm),
                         Fate::noticed, true,
                         "if the numbers are in another unit, scale the lens (convert --scale F)"});
}

void check_overlaps(const ImportedLens& imported, Notes& notes) {
    const std::vector<Surface>& rows = imported.lens.surfaces;
    for (std::size_t row = 0; row + 1 < rows.size(); ++row) {
        const RimGap rims = rim_gap(imported.lens, row);
        // Rounded listings of cemented and touching surfaces overlap by a hair.
        if (!rims.crosses()) continue;
        notes.push_back(
            {Severity::warning, imported.surfaces[row].where,
             fmt::format("surfaces {} and {} cross: at {:.4g} mm from the axis they overlap by "
                         "{:.3g} mm",
                         row + 1, row + 2, rims.height_mm, -rims.gap_mm),
             Fate::noticed, true, "check the thickness, the order and the semi-diameters"});
    }
}

void check_focus(const ImportedLens& imported, Notes& notes) {
    if (!imported.sensor_distance_mm || imported.lens.sensor.at_paraxial_focus) return;
    const auto order = first_order_of(imported.lens);
    if (!order || !std::isfinite(order->efl_mm)) return;
    const double defocus_mm = imported.lens.surfaces.back().thickness_mm - order->bfd_mm;
    if (std::abs(defocus_mm) <= largest_usual_defocus * std::abs(order->efl_mm)) return;
    notes.push_back({Severity::warning, "sensor",
                     fmt::format("the sensor is {:.4g} mm {} the paraxial focus of a far object",
                                 std::abs(defocus_mm), defocus_mm > 0.0 ? "behind" : "before"),
                     Fate::noticed, true,
                     "right for a near object; else set the sensor to the paraxial focus"});
}

}  // namespace

void check_import(const ImportedLens& imported, Notes& notes) {
    Notes found;
    check_diameters(imported, found);
    check_radii(imported, found);
    check_units(imported, found);
    check_overlaps(imported, found);
    check_focus(imported, found);
    notes.insert(notes.end(), found.begin(), found.end());
}

}  // namespace ghostlight
