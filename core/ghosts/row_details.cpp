#include "core/ghosts/row_details.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/flare/tone_map.h"
#include "core/units.h"

namespace ghostlight {

double stop_area_mm2(const StopMask& mask) {
    const double a = mask.semi_diameter_mm;
    if (mask.picture) {
        // By middles of a grid: good to some 1e-3, as the image's own edges are.
        constexpr int across = 512;
        int open = 0;
        for (int j = 0; j < across; ++j)
            for (int i = 0; i < across; ++i)
                open += stop_passes(mask, a * ((2.0 * i + 1.0) / across - 1.0),
                                    a * ((2.0 * j + 1.0) / across - 1.0))
                            ? 1
                            : 0;
        return 4.0 * a * a * open / (across * across);
    }
    if (mask.blades < 3) return std::numbers::pi * a * a;
    const double half = std::numbers::pi / mask.blades;
    const double polygon = mask.blades * a * a * std::sin(half) * std::cos(half);
    if (mask.blade_curvature <= 0.0) return polygon;
    // Each edge is an arc of radius a / curvature over a chord of 2 a sin(half).
    const double radius = a / mask.blade_curvature;
    const double angle = 2.0 * std::asin(std::min(1.0, mask.blade_curvature * std::sin(half)));
    return polygon + mask.blades * 0.5 * radius * radius * (angle - std::sin(angle));
}

double vignetting(const OpticalSystem& system, const ParaxialGhost& paraxial,
                  const LightDirection& light, double pupil_area_mm2) {
    const double scale = paraxial.to_stop.a;
    const double image = stop_area_mm2(system.stop_mask) / (scale * scale) *
                         std::abs(std::cos(rad_from_deg(light.field_deg)));
    if (!(image > 0.0) || !std::isfinite(image)) return std::numeric_limits<double>::quiet_NaN();
    return 1.0 - pupil_area_mm2 / image;
}

double image_area_per_steradian_mm2(const OpticalSystem& system, const LightDirection& light,
                                    double u_mm, double v_mm) {
    constexpr double step_rad = 1e-3;  // central differences: off by the square of it
    const BeamFrame frame = beam_frame(light);
    const glm::dvec3 origin(u_mm * frame.e1.x + v_mm * frame.e2.x,
                            u_mm * frame.e1.y + v_mm * frame.e2.y,
                            u_mm * frame.e1.z + v_mm * frame.e2.z);
    auto land = [&](double along_e1, double along_e2, glm::dvec2& at) {
        const double forward = std::sqrt(1.0 - along_e1 * along_e1 - along_e2 * along_e2);
        glm::dvec3 direction;
        for (int k = 0; k < 3; ++k)
            direction[k] =
                forward * frame.direction[k] + along_e1 * frame.e1[k] + along_e2 * frame.e2[k];
        const TracedRay ray = trace_ray(system, {}, {origin, direction});
        at = {ray.sensor_point.x, ray.sensor_point.y};
        return ray.status.reaches_sensor();
    };
    glm::dvec2 e1_less, e1_more, e2_less, e2_more;
    if (!land(-step_rad, 0.0, e1_less) || !land(step_rad, 0.0, e1_more) ||
        !land(0.0, -step_rad, e2_less) || !land(0.0, step_rad, e2_more))
        return std::numeric_limits<double>::quiet_NaN();
    const glm::dvec2 d1 = e1_more - e1_less, d2 = e2_more - e2_less;
    return std::abs(d1.x * d2.y - d1.y * d2.x) / (4.0 * step_rad * step_rad);
}

std::string srgb_swatch(double r, double g, double b) {
    const double largest = std::max({r, g, b});
    auto byte = [&](double value) {
        if (!(largest > 0.0)) return 0;
        const float share = static_cast<float>(std::clamp(value / largest, 0.0, 1.0));
        return static_cast<int>(std::lround(255.0F * srgb_encoded(share)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(r), byte(g), byte(b));
}

std::vector<std::string> media_of(const Prescription& lens) {
    std::vector<std::string> media;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        media.push_back(describe(medium_before(lens, row)));
    media.push_back(describe(lens.surfaces.back().medium_after));
    return media;
}

std::string sensor_medium_of(const Sensor& sensor) {
    const auto* films =
        sensor.reflectance ? std::get_if<SensorFilms>(&*sensor.reflectance) : nullptr;
    return films ? describe(films->substrate) : "sensor";
}

}  // namespace ghostlight
