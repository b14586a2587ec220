#include "core/fit/synthetic_photo.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/fit/light_place.h"
#include "core/flare/tone_map.h"
#include "core/ghosts/flux_quadrature.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// The level of the brightest thousandth, the light's own image aside.
double bright_level(const std::vector<float>& rgb) {
    std::vector<float> levels;
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
        const float level = std::max({rgb[i], rgb[i + 1], rgb[i + 2]});
        if (level > 0.0F) levels.push_back(level);
    }
    if (levels.empty()) return 1.0;
    const auto place =
        levels.begin() + static_cast<std::ptrdiff_t>(levels.size() - 1 - levels.size() / 1000);
    std::ranges::nth_element(levels, place);
    return static_cast<double>(*place);
}

double rounded(double value, const SyntheticPhotoRequest& request) {
    const double most = std::exp2(request.bits) - 1.0;
    if (!request.srgb) return std::round(most * value) / most;
    const float encoded = srgb_encoded(static_cast<float>(value));
    return static_cast<double>(
        srgb_decoded(static_cast<float>(std::round(most * static_cast<double>(encoded)) / most)));
}

/// The light's own image: a disc as large as the light looks, with the direct path's flux. Where
/// it lies matters, and that it saturates.
void add_light(const Prescription& lens, const LightDirection& light, double light_deg,
               FlareImage& image) {
    const OpticalSystem system = compile(lens, d_line_nm);
    const auto at = image_of_light(system, light);
    if (!at) return;
    const BeamFrame frame = beam_frame(light);
    const double flux_mm2 = PathQuadrature(system, GhostPath{}, frame).start().sums.flux;
    const PixelFrame pixels =
        pixel_frame(image.sensor_width_mm, image.sensor_height_mm, image.width_px);
    const double efl_mm = std::abs(first_order(system).efl_mm);
    const double radius_px = std::max(
        1.0, efl_mm * std::tan(0.5 * light_deg * std::numbers::pi / 180.0) / pixels.pitch_mm);
    const double column = pixels.column(at->x_mm), row = pixels.row(at->y_mm);
    const double level =
        flux_mm2 / (std::numbers::pi * radius_px * radius_px * pixels.pixel_area_mm2());
    const int reach = static_cast<int>(std::ceil(radius_px)) + 1;
    const int c0 = static_cast<int>(column), r0 = static_cast<int>(row);
    for (int y = std::max(0, r0 - reach); y <= std::min(image.height_px - 1, r0 + reach); ++y)
        for (int x = std::max(0, c0 - reach); x <= std::min(image.width_px - 1, c0 + reach); ++x) {
            const double from_edge = radius_px - std::hypot(x + 0.5 - column, y + 0.5 - row);
            const auto share = static_cast<float>(level * std::clamp(from_edge + 0.5, 0.0, 1.0));
            float* rgb = &image.rgb[3 * static_cast<std::size_t>(y * image.width_px + x)];
            for (int c = 0; c < 3; ++c) rgb[c] += share;
        }
}

}  // namespace

std::optional<FlareImage> photo_subject(const Prescription& lens,
                                        const SyntheticPhotoRequest& request,
                                        std::stop_token stop) {
    FlareRequest flare;
    flare.light = {request.light.field_deg + request.field_offset_deg,
                   request.light.azimuth_deg + request.azimuth_offset_deg};
    flare.spectrum = request.spectrum;
    flare.method = FlareMethod::reference;
    flare.width_px = request.width_px;
    flare.tolerance = request.tolerance;
    flare.threads = request.threads;
    return render_flare(lens, flare, std::move(stop));
}

Photo exposed(const FlareImage& picture, const Prescription& lens,
              const SyntheticPhotoRequest& request) {
    FlareImage image = picture;
    const double gain =
        request.exposure_ev ? std::exp2(*request.exposure_ev) : 0.5 / bright_level(image.rgb);
    add_light(lens,
              {request.light.field_deg + request.field_offset_deg,
               request.light.azimuth_deg + request.azimuth_offset_deg},
              request.light_deg, image);
    Photo photo;
    photo.width_px = image.width_px;
    photo.height_px = image.height_px;
    photo.rgb.resize(image.rgb.size());
    // Var(n) of a value n / N counted as N electrons at saturation is n / N.
    const double electrons = request.noise > 0.0 ? 1.0 / (request.noise * request.noise) : 0.0;
    const double level_step =
        request.bits > 0 && !request.srgb ? 1.0 / (std::exp2(request.bits) - 1.0) : 0.0;
    photo.noise = {.shot = request.noise * request.noise,
                   .read = request.read_noise * request.read_noise + level_step * level_step / 12.0,
                   .estimated = false};
    std::mt19937_64 random(request.seed);
    std::normal_distribution<double> normal;
    const double gains[3] = {request.gains.r, request.gains.g, request.gains.b};
    const double middle_x = 0.5 * image.width_px, middle_y = 0.5 * image.height_px;
    const double corner2 = middle_x * middle_x + middle_y * middle_y;
    for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px; ++x) {
            const double dx = x + 0.5 - middle_x, dy = y + 0.5 - middle_y;
            const double passes = 1.0 - request.shading * (dx * dx + dy * dy) / corner2;
            const std::size_t i = 3 * static_cast<std::size_t>(y * image.width_px + x);
            for (std::size_t c = 0; c < 3; ++c) {
                double value = gain * gains[c] * passes * static_cast<double>(image.rgb[i + c]) +
                               request.background;
                if (electrons > 0.0 && value > 0.0)
                    value = static_cast<double>(std::poisson_distribution<long>(
                                std::min(value, 4.0) * electrons)(random)) /
                            electrons;
                if (request.read_noise > 0.0) value += request.read_noise * normal(random);
                value = std::min(value, 1.0);
                if (request.bits > 0) value = rounded(std::max(0.0, value), request);
                photo.rgb[i + c] = static_cast<float>(value);
            }
        }
    return photo;
}

std::optional<Photo> synthetic_photo(const Prescription& lens, const SyntheticPhotoRequest& request,
                                     std::stop_token stop) {
    const auto picture = photo_subject(lens, request, std::move(stop));
    if (!picture) return std::nullopt;
    return exposed(*picture, lens, request);
}

}  // namespace ghostlight
