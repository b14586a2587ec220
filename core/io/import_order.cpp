#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/import_steps.h"
#include "core/io/json_value.h"
#include "core/units.h"

namespace ghostlight {
namespace {

std::ptrdiff_t offset(std::size_t row) { return static_cast<std::ptrdiff_t>(row); }

double listed_thickness(const ImportedLens& imported, std::size_t row) {
    const bool is_last = row + 1 == imported.lens.surfaces.size();
    return is_last ? imported.sensor_distance_mm.value_or(0.0)
                   : imported.lens.surfaces[row].thickness_mm;
}

void add_thickness(ImportedLens& imported, std::size_t row, double more_mm) {
    imported.lens.surfaces[row].thickness_mm += more_mm;
    const bool is_last = row + 1 == imported.lens.surfaces.size();
    if (is_last && imported.sensor_distance_mm) *imported.sensor_distance_mm += more_mm;
}

/// Takes a row out; the gap behind it goes to the row before it.
void erase_row(ImportedLens& imported, std::size_t row) {
    Prescription& lens = imported.lens;
    for (Configuration& each : lens.configurations) {
        std::map<std::size_t, double> kept;
        const auto value = [&](std::size_t of) {
            const auto found = each.thickness_mm.find(of);
            return found != each.thickness_mm.end() ? found->second
                                                    : listed_thickness(imported, of);
        };
        if (row > 0 && (each.thickness_mm.contains(row) || each.thickness_mm.contains(row - 1)))
            kept[row - 1] = value(row - 1) + value(row);
        for (const auto& [of, mm] : each.thickness_mm)
            if (of != row && (row == 0 || of != row - 1)) kept[of > row ? of - 1 : of] = mm;
        each.thickness_mm = std::move(kept);
    }
    const bool is_last = row + 1 == lens.surfaces.size();
    const double behind_mm = lens.surfaces[row].thickness_mm;
    const double before_mm = row > 0 ? lens.surfaces[row - 1].thickness_mm : 0.0;
    lens.surfaces.erase(lens.surfaces.begin() + offset(row));
    imported.surfaces.erase(imported.surfaces.begin() + offset(row));
    if (is_last && row > 0) {
        if (imported.sensor_distance_mm) *imported.sensor_distance_mm += before_mm;
        lens.surfaces[row - 1].thickness_mm = imported.sensor_distance_mm.value_or(0.0);
    } else if (row > 0) {
        add_thickness(imported, row - 1, behind_mm);
    }
    if (imported.stop && *imported.stop > row) --*imported.stop;
}

double index_after(const Prescription& lens, std::ptrdiff_t row) {
    return row < 0 ? 1.0
                   : refractive_index(lens.surfaces[static_cast<std::size_t>(row)].medium_after,
                                      d_line_nm);
}

/// A plane across the axis: behind which row (−1: before the first), how far, and how heights
/// there compare with those in the plane it is an image of.
struct ImagedPlane {
    std::ptrdiff_t row = -1;
    double distance_mm = 0.0, magnification = 1.0;
};

/// The real image, inside the lens, of a plane `distance_mm` behind row `row` (whichever way):
/// a ray through its middle is followed until it crosses the axis where light really is.
std::optional<ImagedPlane> real_image(const Prescription& lens, std::ptrdiff_t row,
                                      double distance_mm, double gap_to_sensor_mm) {
    const auto count = static_cast<std::ptrdiff_t>(lens.surfaces.size());
    const auto gap = [&](std::ptrdiff_t of) {
        return of + 1 == count ? gap_to_sensor_mm
                               : lens.surfaces[static_cast<std::size_t>(of)].thickness_mm;
    };
    const auto power = [&](std::ptrdiff_t of) {
        return curvature_per_mm(lens.surfaces[static_cast<std::size_t>(of)].curve) *
               (index_after(lens, of) - index_after(lens, of - 1));
    };
    // Heights y = height at the plane 1 and slope 0 (beam), and height 0 and slope 1 (chief).
    double y = row < 0 ? 0.0 : gap(row) - distance_mm, u = 1.0;
    double beam_y = 1.0, beam_u = 0.0;
    if (row < 0) y = -distance_mm;
    for (std::ptrdiff_t next = row + 1; next < count; ++next) {
        const double n1 = index_after(lens, next - 1), n2 = index_after(lens, next);
        u = (n1 * u - y * power(next)) / n2;
        beam_u = (n1 * beam_u - beam_y * power(next)) / n2;
        const double to_axis = -y / u;
        if (to_axis >= 0.0 && to_axis <= gap(next))
            return ImagedPlane{next, to_axis, std::abs(beam_y + to_axis * beam_u)};
        y += gap(next) * u;
        beam_y += gap(next) * beam_u;
    }
    y = -distance_mm;
    u = 1.0;
    beam_y = 1.0;
    beam_u = 0.0;
    for (std::ptrdiff_t last = row; last > 0; --last) {
        const double n1 = index_after(lens, last - 1), n2 = index_after(lens, last);
        u = (n2 * u + y * power(last)) / n1;
        beam_u = (n2 * beam_u + beam_y * power(last)) / n1;
        const double before = y / u;
        if (before >= 0.0 && before <= gap(last - 1))
            return ImagedPlane{last - 1, gap(last - 1) - before,
                               std::abs(beam_y - before * beam_u)};
        y -= gap(last - 1) * u;
        beam_y -= gap(last - 1) * beam_u;
    }
    return std::nullopt;
}

bool is_beside_negative_gap(const ImportedLens& imported, std::size_t row) {
    if (row > 0 && imported.lens.surfaces[row - 1].thickness_mm < 0.0) return true;
    return listed_thickness(imported, row) < 0.0;
}

[[noreturn]] void refuse(const ImportedLens& imported, const std::string& file, std::size_t row,
                         double found_mm, std::string problem) {
    throw Error({.problem = std::move(problem),
                 .file = file,
                 .where = imported.surfaces[row].where,
                 .found = fmt::format("{} mm to the next surface", format_number(found_mm)),
                 .expected = "surfaces in the order in which light meets them"});
}

/// The stop's plane is not where light comes: put it where its image is.
void move_stop(ImportedLens& imported, const std::string& file) {
    const std::size_t row = *imported.stop;
    const Surface stop = imported.lens.surfaces[row];
    const ImportedSurface said = imported.surfaces[row];
    const double before_mm = row > 0 ? imported.lens.surfaces[row - 1].thickness_mm : 0.0;
    const double behind_mm = listed_thickness(imported, row);
    if (imported.lens.surfaces.size() == 1) refuse(imported, file, row, behind_mm, "a stop alone");
    imported.stop.reset();
    const double odd_mm = before_mm < 0.0 ? before_mm : behind_mm;
    ImportedSurface named = said;
    erase_row(imported, row);
    // The plane's distance from the row before it, or (in front of the lens) from the first.
    const auto before = static_cast<std::ptrdiff_t>(row) - 1;
    const Prescription known = traceable(imported.lens);
    const auto image = real_image(known, before, row > 0 ? before_mm : -behind_mm,
                                  std::max(imported.sensor_distance_mm.value_or(0.0), 0.0));
    if (!image) {
        imported.surfaces.insert(imported.surfaces.begin(), named);
        refuse(imported, file, 0, odd_mm,
               "the stop stands where light does not come, and has no real image in the lens");
    }
    Surface moved = stop;
    const auto at = static_cast<std::size_t>(image->row);
    const bool is_last = at + 1 == imported.lens.surfaces.size();
    moved.curve = Plane{};
    moved.medium_after = imported.lens.surfaces[at].medium_after;
    moved.thickness_mm = listed_thickness(imported, at) - image->distance_mm;
    imported.lens.surfaces[at].thickness_mm = image->distance_mm;
    if (is_last && imported.sensor_distance_mm) imported.sensor_distance_mm = moved.thickness_mm;
    if (named.semi_diameter_mm) *named.semi_diameter_mm *= image->magnification;
    if (auto& width = imported.lens.stop.semi_diameter_mm) *width *= image->magnification;
    for (Configuration& each : imported.lens.configurations)
        if (each.stop_semi_diameter_mm) *each.stop_semi_diameter_mm *= image->magnification;
    imported.lens.surfaces.insert(imported.lens.surfaces.begin() + offset(at) + 1, moved);
    imported.surfaces.insert(imported.surfaces.begin() + offset(at) + 1, named);
    for (Configuration& each : imported.lens.configurations) {
        std::map<std::size_t, double> kept;
        for (const auto& [of, mm] : each.thickness_mm) kept[of > at ? of + 1 : of] = mm;
        if (each.thickness_mm.contains(at)) {
            // The gap that holds the stop varies: what it varies by is behind the stop.
            kept[at + 1] = std::max(each.thickness_mm.at(at) - image->distance_mm, 0.0);
            kept.erase(at);
        }
        each.thickness_mm = std::move(kept);
    }
    imported.stop = at + 1;
    imported.notes.push_back(
        {Note::Severity::warning, said.where,
         fmt::format("the stop stands {} mm from its neighbour, where light does not come (it is a "
                     "pupil): moved to its image, {} mm behind surface {}",
                     format_number(odd_mm), format_number(image->distance_mm), at + 1),
         Note::Fate::converted, true, "check where the lens has its iris"});
}

}  // namespace

bool is_dummy(const Prescription& lens, std::size_t row) {
    return medium_before(lens, row) == lens.surfaces[row].medium_after;
}

void settle_order(ImportedLens& imported, const std::string& file) {
    for (std::size_t row = 0; row < imported.lens.surfaces.size();) {
        const bool merge = imported.lens.surfaces.size() > 1 && imported.stop != row &&
                           is_dummy(imported.lens, row) && is_beside_negative_gap(imported, row);
        if (!merge) {
            ++row;
            continue;
        }
        imported.notes.push_back(
            {Note::Severity::info,
             imported.surfaces[row].where,
             "a surface without glass before a negative thickness: merged into the gap that it "
             "lies in",
             Note::Fate::converted,
             false,
             {}});
        erase_row(imported, row);
        row = 0;
    }
    if (imported.stop && is_dummy(imported.lens, *imported.stop) &&
        is_beside_negative_gap(imported, *imported.stop) &&
        !(*imported.stop + 1 == imported.lens.surfaces.size() &&
          !(imported.lens.surfaces[*imported.stop - (*imported.stop > 0 ? 1 : 0)].thickness_mm <
            0.0)))
        move_stop(imported, file);
    for (std::size_t row = 0; row + 1 < imported.lens.surfaces.size(); ++row) {
        const double mm = imported.lens.surfaces[row].thickness_mm;
        if (!(mm >= 0.0))
            refuse(imported, file, row, mm,
                   "surfaces are out of order: a negative thickness (a mirror?)");
    }
}

}  // namespace ghostlight
