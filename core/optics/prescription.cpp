#include "core/optics/prescription.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ghostlight {
namespace {

struct CurvatureOf {
    double operator()(const Plane&) const { return 0.0; }
    double operator()(const Radius& radius) const { return 1.0 / radius.mm; }
    double operator()(const Curvature& curvature) const { return curvature.per_mm; }
};

[[noreturn]] void refuse_configuration(const Prescription& lens, std::string_view name) {
    std::string known;
    for (const Configuration& each : lens.configurations)
        known += fmt::format("{}'{}'", known.empty() ? "" : ", ", each.name);
    throw Error({.problem = "the lens has no such configuration",
                 .file = {},
                 .where = "configurations",
                 .found = fmt::format("'{}'", name),
                 .expected = known.empty() ? "none: it has no configurations" : known});
}

}  // namespace

double curvature_per_mm(const BaseCurve& curve) { return std::visit(CurvatureOf{}, curve); }

double sag_mm(const Surface& surface, double y_mm) {
    const double c = curvature_per_mm(surface.curve);
    const double bend = (1.0 + surface.conic) * c * c;
    const double y2 = bend * y_mm * y_mm > 1.0 ? 1.0 / bend : y_mm * y_mm;
    double sag = c * y2 / (1.0 + std::sqrt(std::max(0.0, 1.0 - bend * y2)));
    double power = y2 * y2;
    for (const double term : surface.aspheric) {
        sag += term * power;
        power *= y2;
    }
    return sag;
}

const Medium& medium_before(const Prescription& lens, std::size_t row) {
    static const Medium air;
    return row == 0 ? air : lens.surfaces.at(row - 1).medium_after;
}

Prescription configured(const Prescription& lens, std::string_view configuration) {
    Prescription result = lens;
    result.configurations.clear();
    if (configuration.empty()) return result;
    const auto found = std::ranges::find(lens.configurations, configuration, &Configuration::name);
    if (found == lens.configurations.end()) refuse_configuration(lens, configuration);
    for (const auto& [row, thickness_mm] : found->thickness_mm) {
        if (row >= result.surfaces.size())
            throw Error({.problem = "the configuration changes a row that does not exist",
                         .file = {},
                         .where = fmt::format("configurations['{}'].thickness_mm", configuration),
                         .found = fmt::format("row {}", row + 1),
                         .expected = fmt::format("1 to {}", result.surfaces.size())});
        result.surfaces[row].thickness_mm = thickness_mm;
    }
    // A width without an f-number is the stop of this position, whatever the lens as listed has.
    if (found->stop_semi_diameter_mm) {
        result.stop.semi_diameter_mm = found->stop_semi_diameter_mm;
        result.stop.f_number.reset();
    }
    if (found->f_number) result.stop.f_number = found->f_number;
    if (found->published != Published{}) result.published = found->published;
    return result;
}

Prescription with_air_coating(const Prescription& lens, const Coating& coating) {
    Prescription result = lens;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const bool one_side =
            is_air(medium_before(lens, row)) != is_air(lens.surfaces[row].medium_after);
        result.surfaces[row].coating = one_side ? coating : Coating{Uncoated{}};
    }
    return result;
}

}  // namespace ghostlight
