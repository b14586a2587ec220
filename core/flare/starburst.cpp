#include "core/flare/starburst.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

#include "core/elapsed.h"
#include "core/flare/draw_picture.h"
#include "core/flare/masked_pattern.h"
#include "core/ghosts/flux_quadrature.h"
#include "core/optics/optical_system.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// Steps of 4.7 nm: at 550 nm less than a ring of the pattern.
constexpr int spectral_steps = 64;
/// Wavelengths at which the direct path's flux is worked out; it is smooth between them.
constexpr int flux_nodes = 5;
/// Out of focus by less than this, what a pattern changes is below a hundredth of its peak.
constexpr double sharp_fresnel_number = 0.05;
/// A blur that ends within so much of a pixel does not show.
constexpr double unseen_blur_px = 0.5;
/// Patterns out of focus are not scaled copies of each other: so many over the spectrum.
constexpr int defocused_patterns = 5;
/// How far out patterns go: past the corner opposite to an image at a corner.
constexpr double reach_in_diagonals = 1.6;

/// Flux at a wavelength by the polynomial through the nodes.
double interpolated(const std::vector<SpectralSample>& nodes, const std::vector<double>& values,
                    double wavelength_nm) {
    double sum = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        double share = 1.0;
        for (std::size_t k = 0; k < nodes.size(); ++k)
            if (k != i)
                share *= (wavelength_nm - nodes[k].wavelength_nm) /
                         (nodes[i].wavelength_nm - nodes[k].wavelength_nm);
        sum += share * values[i];
    }
    return std::max(0.0, sum);
}

struct Model {
    std::optional<StarburstTable> table;  ///< nothing where no light comes through
    StarburstTable::Placement placement;
};

std::optional<ApertureOutline> opening(const DirectBeam& beam, const StopMask& mask) {
    const ApertureOutline blades = outline_of(mask);
    if (!beam.limits) return blades;
    return blades.is_unit_circle ? *beam.limits : intersection(*beam.limits, blades);
}

/// Radius of the disc that the beam out of focus fills.
double blur_mm(const DirectBeam& beam) {
    return 2.0 * std::numbers::pi * std::abs(beam.fresnel_number * beam.radius_per_k_mm);
}

std::optional<std::vector<PolarPattern>> patterns_of(
    const Prescription& lens, const OpticalSystem& system, const DirectBeam& beam,
    const std::vector<SpectralSample>& samples, double last_k, double pitch_mm, unsigned threads,
    const std::stop_token& stop) {
    std::vector<PolarPattern> patterns;
    const bool sharp = std::abs(beam.fresnel_number) < sharp_fresnel_number ||
                       blur_mm(beam) < unseen_blur_px * pitch_mm;
    if (sharp && !system.stop_mask.picture && lens.stop.dirt.is_clean()) {
        patterns.push_back(pattern_of(*opening(beam, system.stop_mask), last_k, threads, stop));
        if (stop.stop_requested()) return std::nullopt;
        return patterns;
    }
    const PatternMask mask{system.stop_mask, lens.stop.dirt, beam.limits};
    const std::size_t count = sharp ? 1 : std::min<std::size_t>(samples.size(), defocused_patterns);
    for (std::size_t p = 0; p < count; ++p) {
        const std::size_t middle = (2 * p + 1) * samples.size() / (2 * count);
        const double number =
            sharp ? 0.0 : beam.fresnel_number * beam.wavelength_nm / samples[middle].wavelength_nm;
        auto pattern = masked_pattern(mask, number, last_k, threads, stop);
        if (!pattern) return std::nullopt;
        patterns.push_back(std::move(*pattern));
    }
    if (count == 1) return patterns;
    std::vector<PolarPattern> of_samples;
    for (std::size_t w = 0; w < samples.size(); ++w)
        of_samples.push_back(patterns[w * count / samples.size()]);
    return of_samples;
}

std::optional<Model> model_of(const Prescription& lens, const StarburstRequest& request,
                              const std::stop_token& stop) {
    const auto nodes = nested_samples(request.spectrum, flux_nodes);
    std::vector<OpticalSystem> systems;
    for (const SpectralSample& node : nodes) systems.push_back(compile(lens, node.wavelength_nm));
    const OpticalSystem& system = systems[systems.size() / 2];
    const auto beam = direct_beam(systems, request.light, request.threads, stop);
    if (!beam) return std::nullopt;
    Model model;
    if (beam->is_dark() || beam->radius_per_k_mm == 0.0) return model;

    const auto samples = sample(request.spectrum, spectral_steps);
    const double clear = clear_share(system.stop_mask, lens.stop.dirt);
    std::vector<double> weights;
    for (const SpectralSample& s : samples)
        weights.push_back(s.weight * clear * interpolated(nodes, beam->flux_mm2, s.wavelength_nm));
    const double reach_mm =
        reach_in_diagonals * std::hypot(system.sensor_width_mm, system.sensor_height_mm) +
        std::hypot(beam->x_mm, beam->y_mm);
    const double per_k_per_nm = beam->radius_per_k_mm / beam->wavelength_nm;
    const double shortest_nm =
        std::ranges::min(samples, {}, &SpectralSample::wavelength_nm).wavelength_nm;
    const double last_k =
        std::max(PolarPattern::first_k * 2.0, reach_mm / (std::abs(per_k_per_nm) * shortest_nm));
    const auto patterns =
        patterns_of(lens, system, *beam, samples, last_k, system.sensor_width_mm / request.width_px,
                    request.threads, stop);
    if (!patterns) return std::nullopt;
    model.table.emplace(*patterns, samples, sample_colors(request.spectrum, samples), weights,
                        per_k_per_nm, blur_mm(*beam), request.smoothing_deg, request.threads);
    const double cosine = beam->cos_image_angle;
    model.placement = {.x_mm = beam->x_mm,
                       .y_mm = beam->y_mm,
                       .tangential_rad = beam->tangential_rad,
                       .sagittal_stretch = 1.0 / cosine,
                       .tangential_stretch = 1.0 / (cosine * cosine * cosine),
                       .gain = 1.0};
    return model;
}

void darken(const PixelFrame& frame, FlareImage& image) {
    const auto count =
        static_cast<std::size_t>(frame.width_px) * static_cast<std::size_t>(frame.height_px);
    image.rgb.assign(3 * count, 0.0F);
    image.irradiance.assign(count, 0.0F);
}

/// Row by row, so that the sum does not depend on threads.
double flux_on_sensor_mm2(const FlareImage& image, const PixelFrame& frame) {
    double sum = 0.0;
    const auto width = static_cast<std::ptrdiff_t>(frame.width_px);
    for (auto row = image.irradiance.begin(); row != image.irradiance.end(); row += width)
        sum += std::accumulate(row, row + width, 0.0);
    return sum * frame.pixel_area_mm2();
}

}  // namespace

std::optional<FlareImage> render_starburst(const Prescription& lens,
                                           const StarburstRequest& request, std::stop_token stop) {
    const auto began = Clock::now();
    const OpticalSystem system = compile(lens, d_line_nm);
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    FlareImage image = empty_image(system, frame);
    const auto model = model_of(lens, request, stop);
    if (!model) return std::nullopt;
    image.times.trace_ms = ms_since(began);
    const auto drawn = Clock::now();
    if (model->table) {
        if (!model->table->draw(model->placement, frame, request.threads, stop, image))
            return std::nullopt;
        image.flux_mm2 = model->table->flux_mm2();
        image.flux_on_sensor_mm2 = flux_on_sensor_mm2(image, frame);
    } else {
        darken(frame, image);
    }
    image.times.raster_ms = ms_since(drawn);
    image.times.total_ms = ms_since(began);
    return image;
}

namespace {

/// Fields within this share one kept pattern.
constexpr double kept_step_deg = 4.0;
/// And azimuths, where rims limit the beam or the field stretches it.
constexpr double kept_azimuth_deg = 15.0;

}  // namespace

struct MovingStarburst::Kept {
    int field = 0, azimuth = 0;
    PixelFrame frame;        ///< twice as wide and high, the pattern in its middle
    std::vector<float> rgb;  ///< 3 a pixel
    std::vector<float> irradiance;
    double flux_mm2 = 0.0;
};

MovingStarburst::MovingStarburst(Prescription lens, StarburstRequest request)
    : lens_(std::move(lens)), request_(std::move(request)), system_(compile(lens_, d_line_nm)) {}
MovingStarburst::~MovingStarburst() = default;

const FlareImage& MovingStarburst::frame(const LightDirection& light) {
    const PixelFrame frame =
        pixel_frame(system_.sensor_width_mm, system_.sensor_height_mm, request_.width_px);
    const int field = static_cast<int>(std::lround(light.field_deg / kept_step_deg));
    const int azimuth =
        field == 0 ? 0 : static_cast<int>(std::lround(light.azimuth_deg / kept_azimuth_deg));
    auto found = std::ranges::find_if(
        kept_, [&](const auto& kept) { return kept->field == field && kept->azimuth == azimuth; });
    if (found == kept_.end()) {
        auto kept = std::make_unique<Kept>();
        kept->field = field;
        kept->azimuth = azimuth;
        StarburstRequest request = request_;
        request.light = {field * kept_step_deg,
                         field == 0 ? light.azimuth_deg : azimuth * kept_azimuth_deg};
        const auto model = model_of(lens_, request, {});
        kept->frame = frame;
        kept->frame.width_px = 2 * frame.width_px + 1;
        kept->frame.height_px = 2 * frame.height_px + 1;
        kept->frame.left_mm = -0.5 * kept->frame.width_px * frame.pitch_mm;
        kept->frame.bottom_mm = -0.5 * kept->frame.height_px * frame.pitch_mm;
        FlareImage picture = empty_image(system_, kept->frame);
        if (model->table) {
            StarburstTable::Placement placement = model->placement;
            placement.x_mm = placement.y_mm = 0.0;
            model->table->draw(placement, kept->frame, request.threads, {}, picture);
            kept->flux_mm2 = model->table->flux_mm2();
        } else {
            darken(kept->frame, picture);
        }
        kept->rgb = std::move(picture.rgb);
        kept->irradiance = std::move(picture.irradiance);
        kept_.push_back(std::move(kept));
        found = kept_.end() - 1;
    }
    const Kept& kept = **found;
    if (frame_.width_px == 0) {
        frame_ = empty_image(system_, frame);
        const auto pixels =
            static_cast<std::size_t>(frame.width_px) * static_cast<std::size_t>(frame.height_px);
        frame_.rgb.resize(3 * pixels);
        frame_.irradiance.resize(pixels);
    }
    // Where the middle ray of the light lands now; the pattern goes there by whole pixels.
    const PathQuadrature quadrature(system_, {}, beam_frame(light));
    PathFlux coarse = quadrature.start();
    quadrature.refine(coarse, 1.0, 0.0, {});  // as it stands, for its centroid
    if (!(coarse.sums.flux > 0.0)) {
        std::ranges::fill(frame_.rgb, 0.0F);
        std::ranges::fill(frame_.irradiance, 0.0F);
        frame_.flux_mm2 = frame_.flux_on_sensor_mm2 = 0.0;
        return frame_;
    }
    const int column = static_cast<int>(std::floor(frame.column(coarse.sums.x / coarse.sums.flux)));
    const int row = static_cast<int>(std::floor(frame.row(coarse.sums.y / coarse.sums.flux)));
    const int width = frame.width_px, height = frame.height_px;
    if (column < 0 || column >= width || row < 0 || row >= height) {
        StarburstRequest request = request_;
        request.light = light;
        frame_ = *render_starburst(lens_, request);
        return frame_;
    }
    // The kept picture's middle pixel is (width, height).
    const int shift_x = width - column, shift_y = height - row;
    parallel_for(static_cast<std::size_t>(height), request_.threads, {}, [&](std::size_t j) {
        const std::size_t from = (j + static_cast<std::size_t>(shift_y)) *
                                     static_cast<std::size_t>(kept.frame.width_px) +
                                 static_cast<std::size_t>(shift_x);
        const std::size_t to = j * static_cast<std::size_t>(width);
        std::memcpy(&frame_.rgb[3 * to], &kept.rgb[3 * from],
                    3 * sizeof(float) * static_cast<std::size_t>(width));
        std::memcpy(&frame_.irradiance[to], &kept.irradiance[from],
                    sizeof(float) * static_cast<std::size_t>(width));
    });
    frame_.flux_mm2 = kept.flux_mm2;
    frame_.flux_on_sensor_mm2 = 0.0;  // not summed: that would cost as much as the frame
    return frame_;
}

}  // namespace ghostlight
