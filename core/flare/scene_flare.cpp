#include "core/flare/scene_flare.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/flare/draw_picture.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// Ghosts whose kernel is narrower than this share of the sensor's width are always drawn: people
/// see their shapes, and the series would need many orders.
constexpr double narrowest_folded = 1.0 / 40.0;

/// Patches across the pattern where a picture has to be sampled.
constexpr int sampled_patches = 5;

/// The ghosts of one light that are drawn, and the moments of the others.
struct Folded {
    std::vector<GhostPath> drawn;
    std::vector<GhostSpot> moments;
    bool is_any() const { return !moments.empty(); }
};

std::optional<Folded> fold(const SceneView& view, const FlareScene& compiled,
                           const FlareRequest& request, const std::stop_token& stop) {
    Folded folded;
    const Scene& scene = view.scene;
    if (!(scene.veil.folded_share > 0.0) || !scene.layers.shows(LayerKind::veil)) return folded;
    const auto moments = ghost_spots(compiled, compiled.ghosts, request, stop);
    if (!moments) return std::nullopt;
    const auto chosen = foldable(*moments, scene.veil.folded_share, view.lens.sensor.width_mm,
                                 view.lens.sensor.height_mm);
    std::vector<char> is_folded(moments->size(), 0);
    for (const std::size_t g : chosen) is_folded[g] = 1;
    for (std::size_t g = 0; g < moments->size(); ++g) {
        if (!is_folded[g]) {
            folded.drawn.push_back(compiled.ghosts[g]);
            continue;
        }
        const GhostLook look = look_of(scene.artistic, compiled.ghosts[g]);
        if (!look.on) continue;
        GhostSpot ghost = (*moments)[g];
        for (std::size_t c = 0; c < 4; ++c) ghost.flux_mm2[c] *= look.gain[c];
        ghost.x_mm += look.offset_x_mm;
        ghost.y_mm += look.offset_y_mm;
        folded.moments.push_back(ghost);
    }
    return folded;
}

FlareRequest of_light(FlareRequest request, const Light& light) {
    request.light = light.direction;
    request.spectrum = light.spectrum;
    return request;
}

/// By an engine that draws ghosts as they are: a light of some extent is sampled, and an artist's
/// changes are made ghost by ghost, offsets to whole pixels.
std::optional<FlareImage> engine_image(const SceneView& view, const FlareRequest& request,
                                       const LightPattern& pattern,
                                       const std::vector<GhostPath>& ghosts,
                                       const std::stop_token& stop) {
    const auto whole = [&](const FlareRequest& one) {
        return pattern.is_point() ? render_flare(view.lens, one, stop)
                                  : render_sampled(view.lens, one, pattern, sampled_patches, stop);
    };
    const Artistic& artistic = view.scene.artistic;
    if (artistic.is_neutral()) return whole(request);
    FlareImage sum = black_image(view.lens.sensor, request.width_px);
    const double pitch_mm =
        pixel_frame(view.lens.sensor.width_mm, view.lens.sensor.height_mm, request.width_px)
            .pitch_mm;
    for (const GhostPath& path : request.only.empty() ? ghosts : request.only) {
        const GhostLook look = look_of(artistic, path);
        if (!look.on) continue;
        FlareRequest one = request;
        one.only = {path};
        std::optional<FlareImage> image = whole(one);
        if (!image) return std::nullopt;
        move_image(*image, static_cast<int>(std::lround(look.offset_x_mm / pitch_mm)),
                   static_cast<int>(std::lround(look.offset_y_mm / pitch_mm)));
        add_image(sum, *image, look.gain);
        ++sum.ghosts;
    }
    return sum;
}

std::optional<FlareImage> ghosts_of(const SceneView& view, const Light& light,
                                    const FlareRequest& request, const std::stop_token& stop) {
    const FlareScene& compiled = view.spectra.of(view.lens, light.spectrum);
    FlareRequest one = of_light(request, light);
    const auto folded = fold(view, compiled, one, stop);
    if (!folded) return std::nullopt;
    if (folded->is_any()) one.only = folded->drawn;
    const LightPattern pattern = view.pattern_of(light.size);
    const bool planned = request.method == FlareMethod::planned &&
                         can_be_planned(compiled.system(), light.direction);
    const Artistic& artistic = view.scene.artistic;
    std::optional<FlareImage> image;
    if (!planned) {
        image = engine_image(view, one, pattern, compiled.ghosts, stop);
    } else if (pattern.is_point() && artistic.is_neutral()) {
        image = view.draw(compiled, one, stop);
    } else {
        image = render_extended(compiled, one, pattern, artistic, stop);
    }
    if (image && folded->is_any())
        for (const GhostPath& path : compiled.ghosts)
            if (std::ranges::find(folded->drawn, path) == folded->drawn.end()) {
                PlannedGhost ghost;
                ghost.path = path;
                ghost.fate = GhostFate::folded;
                image->plan.ghosts.push_back(std::move(ghost));
            }
    return image;
}

bool is_neutral(const std::array<double, 4>& gain) {
    return std::ranges::all_of(gain, [](double each) { return each == 1.0; });
}

void measure(FlareImage& image) {
    const PixelFrame frame =
        pixel_frame(image.sensor_width_mm, image.sensor_height_mm, image.width_px);
    double sum = 0.0;
    for (const float value : image.irradiance) sum += static_cast<double>(value);
    image.flux_on_sensor_mm2 = sum * frame.pixel_area_mm2();
}

}  // namespace

FlareImage black_image(const Sensor& sensor, int width_px) {
    const PixelFrame frame = pixel_frame(sensor.width_mm, sensor.height_mm, width_px);
    FlareImage image;
    image.width_px = frame.width_px;
    image.height_px = frame.height_px;
    image.sensor_width_mm = sensor.width_mm;
    image.sensor_height_mm = sensor.height_mm;
    const auto count =
        static_cast<std::size_t>(frame.width_px) * static_cast<std::size_t>(frame.height_px);
    image.rgb.assign(3 * count, 0.0F);
    image.irradiance.assign(count, 0.0F);
    return image;
}

const FlareScene& CompiledSpectra::of(const Prescription& lens, const Spectrum& spectrum) {
    if (lens_ != lens) {
        scenes_.clear();
        lens_ = lens;
    }
    for (const auto& scene : scenes_)
        if (scene->spectrum == spectrum) return *scene;
    if (scenes_.size() >= most_lights) scenes_.erase(scenes_.begin());
    scenes_.push_back(std::make_unique<const FlareScene>(
        flare_scene(lens, spectrum, FlareScene::usual_samples, 0, model_)));
    return *scenes_.back();
}

std::array<double, 4> gain_of(const Scene& scene, const Light& light) {
    const double gain = gain_of_ev(light.intensity_ev);
    const Rgb color = balanced_for(scene.lights.front().spectrum, light.spectrum);
    return {gain * color.r, gain * color.g, gain * color.b, gain};
}

std::optional<FlareImage> ghosts_layer(const SceneView& view, const FlareRequest& request,
                                       std::stop_token stop) {
    std::optional<FlareImage> sum;
    const Scene& scene = view.scene;
    for (std::size_t n = 0; n < scene.lights.size(); ++n) {
        const Light& light = scene.lights[n];
        if (!light.on) continue;
        std::optional<FlareImage> image = ghosts_of(view, light, request, stop);
        if (!image) return std::nullopt;
        const std::array<double, 4> gain = gain_of(scene, light);
        if (!sum && is_neutral(gain)) {
            sum = std::move(image);
            continue;
        }
        const bool is_first = !sum;
        if (is_first) {
            sum = black_image(view.lens.sensor, request.width_px);
            sum->ghosts = image->ghosts;
        }
        add_image(*sum, *image, gain);
        if (is_first || n == scene.active_light) sum->plan = std::move(image->plan);
    }
    return sum ? std::move(sum) : black_image(view.lens.sensor, request.width_px);
}

std::optional<FlareImage> starburst_layer(const SceneView& view, const FlareRequest& request,
                                          const DrawStarburst& draw, std::stop_token stop) {
    FlareImage sum = black_image(view.lens.sensor, request.width_px);
    for (const Light& light : view.scene.lights) {
        if (!light.on) continue;
        StarburstRequest one;
        one.light = light.direction;
        one.spectrum = light.spectrum;
        one.width_px = request.width_px;
        one.threads = request.threads;
        const LightPattern pattern = view.pattern_of(light.size);
        std::optional<FlareImage> image;
        if (pattern.is_point()) {
            image = draw(view.lens, one, stop);
        } else {
            const FlareScene& compiled = view.spectra.of(view.lens, light.spectrum);
            const auto spread =
                image_spread(compiled, of_light(request, light), pattern, GhostPath{}, stop);
            if (!spread) return std::nullopt;
            // What the fold brings in from beside the frame.
            Prescription wide = view.lens;
            const double pitch_mm = wide.sensor.width_mm / request.width_px;
            wide.sensor.width_mm += 2.0 * spread->pad_px * pitch_mm;
            wide.sensor.height_mm += 2.0 * spread->pad_px * pitch_mm;
            one.width_px += 2 * spread->pad_px;
            image = draw(wide, one, stop);
            if (image) image = spread_image(*image, *spread, pattern, light.direction, request);
        }
        if (!image) return std::nullopt;
        add_image(sum, *image, gain_of(view.scene, light));
    }
    return sum;
}

std::vector<std::size_t> foldable(std::span<const GhostSpot> ghosts, double share,
                                  double sensor_width_mm, double sensor_height_mm) {
    struct Candidate {
        std::size_t index;
        double irradiance;
    };
    std::vector<Candidate> candidates;
    double all = 0.0;
    for (std::size_t g = 0; g < ghosts.size(); ++g) {
        const GhostSpot& ghost = ghosts[g];
        if (!reaches_sensor(ghost, sensor_width_mm, sensor_height_mm)) continue;
        all += ghost.flux();
        const auto [narrow, broad] = ghost.sigmas_mm();
        if (narrow >= narrowest_folded * sensor_width_mm)
            candidates.push_back({g, ghost.flux() / (4.0 * std::numbers::pi * narrow * broad)});
    }
    std::ranges::stable_sort(candidates, {}, &Candidate::irradiance);
    std::vector<std::size_t> chosen;
    double sum = 0.0;
    for (const Candidate& candidate : candidates) {
        sum += ghosts[candidate.index].flux();
        if (sum > share * all) break;
        chosen.push_back(candidate.index);
    }
    return chosen;
}

std::optional<FlareImage> veil_layer(const SceneView& view, const FlareRequest& request,
                                     std::stop_token stop) {
    FlareImage image = black_image(view.lens.sensor, request.width_px);
    const Scene& scene = view.scene;
    const Sensor& sensor = view.lens.sensor;
    std::vector<GhostSpot> all;
    for (const Light& light : scene.lights) {
        if (!light.on) continue;
        const FlareScene& compiled = view.spectra.of(view.lens, light.spectrum);
        const FlareRequest one = of_light(request, light);
        const std::array<double, 4> gain = gain_of(scene, light);
        const auto brightened = [&](GhostSpot ghost) {
            for (std::size_t c = 0; c < 4; ++c) ghost.flux_mm2[c] *= gain[c];
            return ghost;
        };
        const auto folded = fold(view, compiled, one, stop);
        if (!folded) return std::nullopt;
        for (const GhostSpot& ghost : folded->moments)
            if (reaches_sensor(ghost, sensor.width_mm, sensor.height_mm))
                all.push_back(brightened(ghost));
        if (scene.veil.spread.share > 0.0) {
            const auto direct = ghost_spots(compiled, {GhostPath{}}, one, stop);
            if (!direct) return std::nullopt;
            const GhostSpot spot = brightened(direct->front());
            const double efl_mm = first_order(compiled.system()).efl_mm;
            add_glare_spread(scene.veil.spread, spot.flux_mm2, spot.x_mm, spot.y_mm, efl_mm,
                             request.threads, image);
            image.flux_mm2 += scene.veil.spread.share * spot.flux();
        }
    }
    if (!all.empty()) {
        const VeilSize size = veil_size(all, sensor.width_mm, sensor.height_mm);
        VeilSeries series(size.period_mm, size.orders);
        double narrowest_mm = size.period_mm;
        for (const GhostSpot& ghost : all) {
            series.add(ghost, scene.veil.kernel);
            image.flux_mm2 += ghost.flux();
            narrowest_mm = std::min(narrowest_mm, ghost.sigmas_mm()[0]);
        }
        const PixelFrame frame = pixel_frame(sensor.width_mm, sensor.height_mm, request.width_px);
        const auto values = veil_picture(series, narrowest_mm, frame, request.threads);
        for (std::size_t i = 0; i < image.irradiance.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * i + c] += values[4 * i + c];
            // The series of an ellipse rings about zero where there is no light.
            image.irradiance[i] += std::max(0.0F, values[4 * i + 3]);
        }
    }
    measure(image);
    return image;
}

}  // namespace ghostlight
