#include "core/io/layout_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/ghosts/pupil.h"
#include "core/optics/trace.h"

namespace ghostlight {
namespace {

constexpr double width_px = 1100.0;
constexpr int points_of_a_profile = 24;

double sag_mm(const SurfaceAt& surface, double r_mm) {
    const double c = surface.curvature_per_mm, r2 = r_mm * r_mm;
    const double root = 1.0 - (1.0 + surface.conic) * c * c * r2;
    double sag = c * r2 / (1.0 + std::sqrt(std::max(0.0, root)));
    double power = r2;
    for (const double a : surface.aspheric) sag += a * (power *= r2);
    return sag;
}

/// From mm in the lens to the drawing: z to the right, y upwards.
struct Paper {
    double z0_mm, y1_mm, scale;
    std::string at(double z_mm, double y_mm) const {
        return fmt::format("{:.2f} {:.2f}", (z_mm - z0_mm) * scale, (y1_mm - y_mm) * scale);
    }
};

/// A surface's profile from one rim to the other, `up` from below to above.
std::string profile(const Paper& paper, const SurfaceAt& surface, bool up, const char* first) {
    std::string path;
    for (int k = 0; k <= points_of_a_profile; ++k) {
        const double share = 2.0 * k / points_of_a_profile - 1.0;
        const double y = surface.semi_diameter_mm * (up ? share : -share);
        path += (k == 0 ? first : "L") + paper.at(surface.vertex_z_mm + sag_mm(surface, y), y);
    }
    return path;
}

std::string elements(const Paper& paper, const OpticalSystem& system) {
    std::string svg;
    for (std::size_t k = 0; k < system.surfaces.size(); ++k) {
        const SurfaceAt& front = system.surfaces[k];
        if (k + 1 < system.surfaces.size() && front.n_after > 1.0) {
            const SurfaceAt& back = system.surfaces[k + 1];
            svg += fmt::format("<path d=\"{}{}Z\" fill=\"#cfe3f3\" fill-opacity=\"{:.2f}\"/>\n",
                               profile(paper, front, true, "M"), profile(paper, back, false, "L"),
                               std::clamp(0.5 + front.n_after - 1.5, 0.3, 1.0));
            // The edges, straight from rim to rim.
            for (const double side : {-1.0, 1.0})
                svg +=
                    fmt::format("<path d=\"M{}L{}\" stroke=\"#557\" fill=\"none\"/>\n",
                                paper.at(front.vertex_z_mm + sag_mm(front, front.semi_diameter_mm),
                                         side * front.semi_diameter_mm),
                                paper.at(back.vertex_z_mm + sag_mm(back, back.semi_diameter_mm),
                                         side * back.semi_diameter_mm));
        }
        if (front.n_before != front.n_after)
            svg += fmt::format("<path d=\"{}\" stroke=\"#335\" fill=\"none\"/>\n",
                               profile(paper, front, true, "M"));
    }
    return svg;
}

std::string stop_and_sensor(const Paper& paper, const OpticalSystem& system) {
    const SurfaceAt& stop = system.surfaces[system.stop];
    const double open = system.stop_mask.semi_diameter_mm;
    const double rim = std::max(1.25 * stop.semi_diameter_mm, open + 2.0);
    std::string svg;
    for (const double side : {-1.0, 1.0})
        svg += fmt::format("<path d=\"M{}L{}\" stroke=\"#000\" stroke-width=\"3\"/>\n",
                           paper.at(stop.vertex_z_mm, side * open),
                           paper.at(stop.vertex_z_mm, side * rim));
    svg += fmt::format("<path d=\"M{}L{}\" stroke=\"#a22\" stroke-width=\"3\"/>\n",
                       paper.at(system.sensor_z_mm, -0.5 * system.sensor_height_mm),
                       paper.at(system.sensor_z_mm, 0.5 * system.sensor_height_mm));
    return svg;
}

std::string rays_of(const Paper& paper, const OpticalSystem& system, double field_deg,
                    const DrawnPath& drawn, double lead_mm) {
    const LightDirection light{field_deg, 90.0};
    const BeamFrame frame = beam_frame(light);
    const Pupil pupil =
        find_pupil(system, trace_path<double>(system, drawn.path), frame, PupilSearch::quick);
    std::string svg;
    for (int k = 0; k < drawn.rays && !pupil.empty(); ++k) {
        const double v = std::lerp(pupil.box.v0_mm, pupil.box.v1_mm, (k + 0.5) / drawn.rays);
        const glm::dvec3 origin = v * frame.e2;
        const TracedRay ray = trace_ray(system, drawn.path, {origin, frame.direction});
        if (ray.status.fate != RayFate::ok) continue;
        const glm::dvec3 start =
            origin - (lead_mm + origin.z) / std::max(frame.direction.z, 0.1) * frame.direction;
        std::string path = "M" + paper.at(start.z, start.y);
        for (const RayHit& hit : ray.hits) path += "L" + paper.at(hit.point.z, hit.point.y);
        path += "L" + paper.at(ray.sensor_point.z, ray.sensor_point.y);
        svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-opacity=\"{}\"/>\n",
                           path, drawn.color, drawn.opacity);
    }
    return svg;
}

}  // namespace

std::string layout_svg(const OpticalSystem& system, double field_deg,
                       const std::vector<DrawnPath>& paths) {
    double radius = 0.5 * system.sensor_height_mm, first_z = 0.0;
    for (const SurfaceAt& surface : system.surfaces) {
        radius = std::max(radius, 1.05 * surface.semi_diameter_mm);
        first_z =
            std::min(first_z, surface.vertex_z_mm + sag_mm(surface, surface.semi_diameter_mm));
    }
    const double lead = 0.12 * system.sensor_z_mm - first_z;
    const double margin = 0.02 * system.sensor_z_mm;
    const double length = lead + system.sensor_z_mm + margin;
    const Paper paper{-lead, radius + margin, width_px / length};
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
        "stroke-width=\"1\" stroke-linejoin=\"round\">\n",
        width_px, 2.0 * (radius + margin) * paper.scale);
    svg += fmt::format("<path d=\"M{}L{}\" stroke=\"#aaa\" stroke-dasharray=\"12 4 2 4\"/>\n",
                       paper.at(-lead, 0.0), paper.at(system.sensor_z_mm, 0.0));
    svg += elements(paper, system);
    for (const DrawnPath& drawn : paths) svg += rays_of(paper, system, field_deg, drawn, lead);
    return svg + stop_and_sensor(paper, system) + "</svg>\n";
}

}  // namespace ghostlight
