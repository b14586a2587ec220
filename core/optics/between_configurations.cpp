#include "core/optics/between_configurations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ghostlight {

namespace {

/// What a position overrides; nothing for the lens as listed.
Configuration overrides_of(const Prescription& lens, std::string_view name) {
    const auto found = std::ranges::find(lens.configurations, name, &Configuration::name);
    return found == lens.configurations.end() ? Configuration{} : *found;
}

}  // namespace

Configuration between_configurations(const Prescription& lens, std::string_view first,
                                     std::string_view second, double share) {
    if (!(share >= 0.0 && share <= 1.0))
        throw Error({"not a place between two configurations",
                     {},
                     {},
                     fmt::format("{}", share),
                     "a share from 0 to 1"});
    const Prescription from = configured(lens, first);
    const Prescription to = configured(lens, second);
    const Configuration a = overrides_of(lens, first), b = overrides_of(lens, second);
    Configuration between;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        if (a.thickness_mm.contains(row) || b.thickness_mm.contains(row))
            between.thickness_mm[row] =
                std::lerp(from.surfaces[row].thickness_mm, to.surfaces[row].thickness_mm, share);
    const auto sets_stop = [](const Configuration& of) {
        return of.f_number.has_value() || of.stop_semi_diameter_mm.has_value();
    };
    if (!sets_stop(a) && !sets_stop(b)) return between;
    if (from.stop.f_number && to.stop.f_number) {
        between.f_number = std::lerp(*from.stop.f_number, *to.stop.f_number, share);
    } else if (!from.stop.f_number && !to.stop.f_number) {
        const auto size_mm = [](const Prescription& of) {
            return of.stop.semi_diameter_mm.value_or(
                of.surfaces.at(of.stop.surface).semi_diameter_mm);
        };
        between.stop_semi_diameter_mm = std::lerp(size_mm(from), size_mm(to), share);
    } else {
        // One by its f-number and one by its size: there is no between; the nearer one's holds.
        const Configuration& nearer = share < 0.5 ? a : b;
        between.f_number = nearer.f_number;
        between.stop_semi_diameter_mm = nearer.stop_semi_diameter_mm;
    }
    return between;
}

}  // namespace ghostlight
