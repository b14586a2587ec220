#include "widgets/fit_apply.h"

#include <algorithm>

namespace ghostlight {

Prescription with_fitted(const Prescription& lens, const std::string& configuration,
                         const std::vector<FittedNumber>& numbers, const Prescription& found) {
    FittedLens fitted{configured(lens, configuration), {}};
    Prescription result = lens;
    for (std::size_t row = 0; row < result.surfaces.size(); ++row) {
        fitted.lens.surfaces[row].coating = found.surfaces[row].coating;
        result.surfaces[row].coating = found.surfaces[row].coating;
    }
    const auto own = std::ranges::find(result.configurations, configuration, &Configuration::name);
    const bool has_own = !configuration.empty() && own != result.configurations.end();
    for (const FittedNumber& number : numbers) {
        const FitParameter& p = number.parameter;
        if (number.knowledge == FitKnowledge::not_felt) {
            continue;  // held
        }
        set(fitted, p, number.value);
        for (const std::size_t row : p.rows) {
            const Surface& from = fitted.lens.surfaces[row];
            Surface& to = result.surfaces[row];
            if (p.kind != FitKind::gap) {
                const double thickness_mm = to.thickness_mm;
                to = from;
                to.thickness_mm = thickness_mm;
            } else if (has_own && own->thickness_mm.contains(row)) {
                own->thickness_mm[row] = from.thickness_mm;
            } else {
                to.thickness_mm = from.thickness_mm;
            }
        }
        if (p.kind == FitKind::stop_size && has_own &&
            (own->f_number || own->stop_semi_diameter_mm)) {
            own->f_number = fitted.lens.stop.f_number;
            own->stop_semi_diameter_mm = fitted.lens.stop.semi_diameter_mm;
        } else if (p.rows.empty()) {
            result.stop = fitted.lens.stop;
        }
    }
    return result;
}

}  // namespace ghostlight
