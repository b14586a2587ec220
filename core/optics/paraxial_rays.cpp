#include "core/optics/paraxial_rays.h"

#include "core/optics/paraxial.h"

namespace ghostlight {
namespace {

void refract(const SurfaceAt& surface, ParaxialRayAt& ray) {
    ray.incidence = ray.u + ray.y_mm * surface.curvature_per_mm;
    const double power =
        surface.curvature_per_mm * (surface.n_after - surface.n_before) / surface.n_after;
    ray.u = ray.u * surface.n_before / surface.n_after - ray.y_mm * power;
}

double lagrange(double n, const ParaxialRayAt& marginal, const ParaxialRayAt& chief) {
    return n * (marginal.u * chief.y_mm - chief.u * marginal.y_mm);
}

}  // namespace

std::vector<ParaxialRaysAt> paraxial_rays(const OpticalSystem& system, double field_tangent) {
    const FirstOrder order = first_order(system);
    ParaxialRayAt marginal{order.entrance_pupil_radius_mm, 0.0, 0.0};
    ParaxialRayAt chief{-order.entrance_pupil_z_mm * field_tangent, field_tangent, 0.0};
    std::vector<ParaxialRaysAt> table;
    double z = 0.0;
    auto go_to = [&](double to_z) {
        marginal.y_mm += marginal.u * (to_z - z);
        chief.y_mm += chief.u * (to_z - z);
        z = to_z;
    };
    for (const SurfaceAt& surface : system.surfaces) {
        go_to(surface.vertex_z_mm);
        refract(surface, marginal);
        refract(surface, chief);
        table.push_back({marginal, chief, lagrange(surface.n_after, marginal, chief)});
    }
    go_to(system.sensor_z_mm);
    marginal.incidence = marginal.u;
    chief.incidence = chief.u;
    table.push_back({marginal, chief, lagrange(system.surfaces.back().n_after, marginal, chief)});
    return table;
}

}  // namespace ghostlight
