#include "core/optics/mend.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"

namespace ghostlight {
namespace {

struct ScaledCurve {
    double factor;
    BaseCurve operator()(const Plane& plane) const { return plane; }
    BaseCurve operator()(const Radius& radius) const { return Radius{radius.mm * factor}; }
    BaseCurve operator()(const Curvature& curve) const { return Curvature{curve.per_mm / factor}; }
};

struct InvertedCurve {
    BaseCurve operator()(const Plane& plane) const { return plane; }
    BaseCurve operator()(const Radius& radius) const { return Curvature{radius.mm}; }
    BaseCurve operator()(const Curvature& curve) const { return Radius{curve.per_mm}; }
};

}  // namespace

Prescription scaled(const Prescription& lens, double factor) {
    if (!(factor > 0.0) || !std::isfinite(factor))
        throw Error({.problem = "a lens cannot be scaled by this",
                     .file = {},
                     .where = {},
                     .found = fmt::format("{}", factor),
                     .expected = "a factor above 0"});
    Prescription result = lens;
    for (Surface& surface : result.surfaces) {
        surface.curve = std::visit(ScaledCurve{factor}, surface.curve);
        for (std::size_t i = 0; i < surface.aspheric.size(); ++i)
            surface.aspheric[i] *= std::pow(factor, -3.0 - 2.0 * static_cast<double>(i));
        surface.thickness_mm *= factor;
        surface.semi_diameter_mm *= factor;
    }
    if (result.stop.semi_diameter_mm) *result.stop.semi_diameter_mm *= factor;
    if (lens.sensor.width_mm != Sensor{}.width_mm || lens.sensor.height_mm != Sensor{}.height_mm) {
        result.sensor.width_mm *= factor;
        result.sensor.height_mm *= factor;
    }
    for (Configuration& each : result.configurations) {
        for (auto& [row, thickness_mm] : each.thickness_mm) thickness_mm *= factor;
        if (each.stop_semi_diameter_mm) *each.stop_semi_diameter_mm *= factor;
    }
    return result;
}

Prescription with_halved_semi_diameters(const Prescription& lens) {
    Prescription result = lens;
    for (Surface& surface : result.surfaces)
        if (!surface.semi_diameter_sized) surface.semi_diameter_mm *= 0.5;
    return result;
}

Prescription with_radii_as_curvatures(const Prescription& lens) {
    Prescription result = lens;
    for (Surface& surface : result.surfaces)
        surface.curve = std::visit(InvertedCurve{}, surface.curve);
    return result;
}

}  // namespace ghostlight
