#include "core/ghosts/field_curves.h"

#include <cmath>
#include <limits>

#include "core/ghosts/flux_quadrature.h"
#include "core/ghosts/row_details.h"
#include "core/optics/paraxial.h"
#include "core/optics/real_rays.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double flux_tolerance = 1e-3;  ///< relative: curves are drawn, not read to five digits
constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

struct BeamAt {
    FluxSums sums;
    double area_per_sr_mm2 = not_there;
};

BeamAt beam_at(const OpticalSystem& system, double field_deg) {
    const LightDirection light{field_deg, 90.0};
    const PathQuadrature quadrature(system, {}, beam_frame(light));
    PathFlux flux = quadrature.start();
    quadrature.refine(flux, flux_tolerance, 0.0, {});
    BeamAt beam;
    beam.sums = flux.sums;
    const std::vector<BeamPart> parts = quadrature.parts(flux);
    double area = 0.0, u = 0.0, v = 0.0;
    for (const BeamPart& part : parts) {
        area += part.area_mm2;
        u += part.area_mm2 * part.u_mm;
        v += part.area_mm2 * part.v_mm;
    }
    if (area > 0.0)
        beam.area_per_sr_mm2 = image_area_per_steradian_mm2(system, light, u / area, v / area);
    return beam;
}

}  // namespace

std::vector<FieldPoint> field_curves(const OpticalSystem& system, double last_deg, int count) {
    const double efl_mm = first_order(system).efl_mm;
    std::vector<FieldPoint> points(static_cast<std::size_t>(count));
    std::vector<BeamAt> beams(points.size());
    parallel_for(points.size(), 0, {}, [&](std::size_t k) {
        FieldPoint& point = points[k];
        point.field_deg = last_deg * static_cast<double>(k) / (count - 1);
        const auto chief = ray_through_stop(system, point.field_deg, 0.0);
        point.image_height_mm = chief ? std::abs(chief->sensor_point.y) : not_there;
        point.paraxial_height_mm = std::abs(efl_mm) * std::tan(rad_from_deg(point.field_deg));
        // On axis the limit of the ratio is not 1 where the sensor is off the focus; it is left
        // out.
        point.distortion =
            k > 0 ? point.image_height_mm / point.paraxial_height_mm - 1.0 : not_there;
        beams[k] = beam_at(system, point.field_deg);
        point.pupil_area_mm2 = beams[k].sums.pupil_area_mm2;
        point.transmittance = beams[k].sums.flux / beams[k].sums.pupil_area_mm2;
    });
    const BeamAt& axis = beams.front();
    for (std::size_t k = 0; k < points.size(); ++k) {
        points[k].vignetting =
            1.0 - points[k].pupil_area_mm2 /
                      (axis.sums.pupil_area_mm2 * std::cos(rad_from_deg(points[k].field_deg)));
        points[k].relative_illumination = beams[k].sums.flux > 0.0
                                              ? beams[k].sums.flux / beams[k].area_per_sr_mm2 /
                                                    (axis.sums.flux / axis.area_per_sr_mm2)
                                              : 0.0;
    }
    return points;
}

}  // namespace ghostlight
