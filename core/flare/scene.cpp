#include "core/flare/scene.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight {

double half_field_deg(const Prescription& configured) {
    constexpr double unknown_deg = 20.0;
    if (configured.published.half_field_deg) {
        return *configured.published.half_field_deg;
    }
    try {
        const double efl_mm = first_order(compile(configured, d_line_nm)).efl_mm;
        const double half_diagonal_mm =
            0.5 * std::hypot(configured.sensor.width_mm, configured.sensor.height_mm);
        if (std::isfinite(efl_mm) && efl_mm != 0.0) {
            return deg_from_rad(std::atan(half_diagonal_mm / std::abs(efl_mm)));
        }
    } catch (const Error&) {
    }
    return unknown_deg;
}

std::vector<LightDirection> other_lights(const Scene& scene) {
    std::vector<LightDirection> lights;
    for (std::size_t k = 0; k < scene.lights.size(); ++k)
        if (k != scene.active_light && scene.lights[k].on)
            lights.push_back(scene.lights[k].direction);
    return lights;
}

Scene default_scene(const Prescription& lens) {
    // Well inside the picture's short side, where most of the flare is seen with its light.
    Scene scene;
    double inside_deg = 10.0;
    try {
        const double efl_mm = first_order(compile(lens, d_line_nm)).efl_mm;
        if (std::isfinite(efl_mm) && efl_mm != 0.0)
            inside_deg = deg_from_rad(std::atan(0.35 * lens.sensor.height_mm / std::abs(efl_mm)));
    } catch (const Error&) {
    }
    inside_deg = std::min({10.0, inside_deg, 0.6 * half_field_deg(lens)});
    scene.light().direction.field_deg = std::round(inside_deg * 10.0) / 10.0;
    return scene;
}

bool has_plain_ghosts(const Scene& scene) {
    const Light& light = scene.light();
    const bool folds = scene.veil.folded_share > 0.0 && scene.layers.shows(LayerKind::veil);
    return scene.lights.size() == 1 && light.on && light.size == LightSize{} &&
           light.intensity_ev == 0.0 && scene.artistic.is_neutral() && !folds;
}

double drawing_wavelength_nm(const Scene& scene) {
    return line_nm(scene.light().spectrum).value_or(d_line_nm);
}

}  // namespace ghostlight
