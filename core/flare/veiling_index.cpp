#include "core/flare/veiling_index.h"

#include <cmath>
#include <numbers>

#include "core/flare/extended_flare.h"
#include "core/flare/flare_scene.h"
#include "core/flare/planned_flare.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr int width_px = 96;
/// The pictures' errors average out over directions.
constexpr double tolerance = 0.1;
/// Breadth of the spot's image over the sensor's width: ISO 9358 has a tenth of the picture.
constexpr double spot_share = 0.1;
/// For the direct image, whose flux ends at the sensor's edge.
constexpr int direct_steps = 8;

double ring_sr(double from_deg, double to_deg) {
    return 2.0 * std::numbers::pi *
           (std::cos(rad_from_deg(from_deg)) - std::cos(rad_from_deg(to_deg)));
}

/// Mean of the middle of a picture, without colour.
double middle_of(const FlareImage& image) {
    const int half = std::max(1, static_cast<int>(0.5 * spot_share * image.width_px));
    double sum = 0.0;
    for (int row = image.height_px / 2 - half; row < image.height_px / 2 + half; ++row)
        for (int column = image.width_px / 2 - half; column < image.width_px / 2 + half; ++column)
            sum += static_cast<double>(
                image.irradiance[static_cast<std::size_t>(row * image.width_px + column)]);
    return sum / (4.0 * half * half);
}

/// Share of a circle about the axis that lies on the sensor.
double share_on_sensor(double radius_mm, const Sensor& sensor) {
    constexpr int points = 256;  // of a quarter
    int inside = 0;
    for (int k = 0; k < points; ++k) {
        const double angle = 0.5 * std::numbers::pi * (k + 0.5) / points;
        inside += radius_mm * std::cos(angle) <= 0.5 * sensor.width_mm &&
                          radius_mm * std::sin(angle) <= 0.5 * sensor.height_mm
                      ? 1
                      : 0;
    }
    return static_cast<double>(inside) / points;
}

}  // namespace

std::optional<VeilingIndex> veiling_index(const Prescription& lens,
                                          const VeilingIndexRequest& request, std::stop_token stop,
                                          const std::function<void(double)>& progress) {
    const FlareScene scene =
        flare_scene(lens, request.spectrum, FlareScene::usual_samples, request.threads);
    const double area_mm2 = lens.sensor.width_mm * lens.sensor.height_mm;
    FlareRequest picture;
    picture.width_px = width_px;
    picture.tolerance = tolerance;
    picture.spectrum = request.spectrum;
    picture.threads = request.threads;
    const auto direct = [&](double field_deg) -> std::optional<GhostSpot> {
        FlareRequest one = picture;
        one.light = {field_deg, 90.0};
        const auto moments = ghost_spots(scene, {GhostPath{}}, one, stop);
        if (!moments) return std::nullopt;
        return moments->front();
    };

    VeilingIndex result;
    result.scatter_share = request.spread.share;
    const double breadth_deg = request.last_deg / request.fields;
    double outside = 0.0;
    for (int k = 0; k < request.fields; ++k) {
        VeilingRing ring;
        ring.field_deg = (k + 0.5) * breadth_deg;
        ring.solid_angle_sr = ring_sr(k * breadth_deg, (k + 1) * breadth_deg);
        for (int a = 0; a < request.azimuths; ++a) {
            FlareRequest one = picture;
            one.light = {ring.field_deg, 90.0 * (a + 0.5) / request.azimuths};
            const auto image = can_be_planned(scene.system(), one.light)
                                   ? render_planned(scene, one, stop)
                                   : render_flare(lens, one, stop);
            if (!image) return std::nullopt;
            ring.ghosts_mm2 += image->flux_on_sensor_mm2 / request.azimuths;
            ring.center_per_e0 += middle_of(*image) / request.azimuths;
        }
        double in_picture = 0.0;
        for (int s = 0; s < direct_steps; ++s) {
            const double from = (k + static_cast<double>(s) / direct_steps) * breadth_deg;
            const double to = from + breadth_deg / direct_steps;
            const auto spot = direct(0.5 * (from + to));
            if (!spot) return std::nullopt;
            const double on = share_on_sensor(std::hypot(spot->x_mm, spot->y_mm), lens.sensor);
            const double share = ring_sr(from, to) / ring.solid_angle_sr;
            if (spot->flux() > 0.0) {
                ring.direct_mm2 += share * on * spot->flux();
                in_picture += share * on;
            }
        }
        result.glare_sr += ring.solid_angle_sr * ring.ghosts_mm2 / area_mm2;
        result.center_glare_sr += ring.solid_angle_sr * ring.center_per_e0;
        result.direct_sr += ring.solid_angle_sr * ring.direct_mm2 / area_mm2;
        outside += (1.0 - in_picture) * ring.solid_angle_sr * ring.ghosts_mm2 / area_mm2;
        result.rings.push_back(ring);
        if (progress) progress(static_cast<double>(k + 1) / request.fields);
    }
    if (result.glare_sr > 0.0) result.outside_share = outside / result.glare_sr;
    // On the axis a steradian of the surround falls on the square of its image's growth.
    constexpr double step_deg = 0.5;
    const auto middle = direct(0.0), beside = direct(step_deg);
    if (!middle || !beside) return std::nullopt;
    const double growth_mm = (beside->y_mm - middle->y_mm) / rad_from_deg(step_deg);
    if (growth_mm != 0.0) result.center_direct_sr = middle->flux() / (growth_mm * growth_mm);
    return result;
}

}  // namespace ghostlight
