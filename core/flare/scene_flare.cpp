#include "core/flare/scene_flare.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/flare/fold_ghosts.h"
#include "core/flare/glare_spread.h"
#include "core/flare/probe_all.h"
#include "core/flare/veil_picture.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// Patches across the pattern where a picture has to be sampled.
constexpr int sampled_patches = 5;

/// The share of a scene's ghosts that its veil may have.
double folded_share(const Scene& scene) {
    return scene.layers.shows(LayerKind::veil) ? scene.veil.folded_share : 0.0;
}

/// As an artist has them.
std::vector<GhostSpot> looks_of(const Artistic& artistic, const FlarePlan& plan) {
    std::vector<GhostSpot> spots;
    for (const PlannedGhost& ghost : plan.ghosts) {
        const GhostLook look = look_of(artistic, ghost.path);
        if (ghost.fate != GhostFate::folded || !look.on) continue;
        spots.push_back(ghost.spot);
        for (std::size_t c = 0; c < 4; ++c) spots.back().flux_mm2[c] *= look.gain[c];
        spots.back().x_mm += look.offset_x_mm;
        spots.back().y_mm += look.offset_y_mm;
    }
    return spots;
}

/// Only that part of a plan that is of ghosts to be folded, for those that draw without one.
std::optional<FlarePlan> folded_ahead(const FlareScene& compiled, const FlareRequest& request,
                                      const std::stop_token& stop) {
    const OpticalSystem& system = compiled.system();
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    const GhostPlanner planner(compiled, request.light, frame, request.search, request.economies);
    auto probed = probe_all(compiled, planner, request, stop);
    if (!probed) return std::nullopt;
    FlarePlan plan = plan_of(compiled, request, *probed);
    std::erase_if(plan.ghosts,
                  [](const PlannedGhost& ghost) { return ghost.fate != GhostFate::folded; });
    return plan;
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
    one.folded_share = folded_share(view.scene);
    const LightPattern pattern = view.pattern_of(light.size);
    const bool planned = request.method == FlareMethod::planned &&
                         can_be_planned(compiled.system(), light.direction);
    const Artistic& artistic = view.scene.artistic;
    std::optional<FlareImage> image;
    if (planned && pattern.is_point() && artistic.is_neutral()) {
        image = view.draw(compiled, one, stop);
        if (image) image->folded = folded_spots(image->plan);
        return image;
    }
    std::optional<FlarePlan> ahead;
    if (one.folded_share > 0.0) {
        ahead = folded_ahead(compiled, one, stop);
        if (!ahead) return std::nullopt;
        one.folded_share = 0.0;
        one.only.clear();
        for (const GhostPath& path : request.only.empty() ? compiled.ghosts : request.only)
            if (std::ranges::find(ahead->ghosts, path, &PlannedGhost::path) == ahead->ghosts.end())
                one.only.push_back(path);
    }
    image = planned ? render_extended(compiled, one, pattern, artistic, stop)
                    : engine_image(view, one, pattern, compiled.ghosts, stop);
    if (image && ahead) {
        image->folded = looks_of(artistic, *ahead);
        image->plan.folded_mm2 = ahead->folded_mm2;
        std::ranges::move(ahead->ghosts, std::back_inserter(image->plan.ghosts));
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

namespace {

/// What a scene's veil has of its ghosts, lights together, where no ghosts' layer tells.
std::optional<std::vector<GhostSpot>> folded_anew(const SceneView& view,
                                                  const FlareRequest& request,
                                                  const std::stop_token& stop) {
    const Scene& scene = view.scene;
    std::vector<GhostSpot> all;
    for (const Light& light : scene.lights) {
        if (!light.on) continue;
        const FlareScene& compiled = view.spectra.of(view.lens, light.spectrum);
        FlareRequest one = of_light(request, light);
        one.folded_share = folded_share(scene);
        const auto plan = folded_ahead(compiled, one, stop);
        if (!plan) return std::nullopt;
        const std::array<double, 4> gain = gain_of(scene, light);
        for (GhostSpot ghost : looks_of(scene.artistic, *plan)) {
            for (std::size_t c = 0; c < 4; ++c) ghost.flux_mm2[c] *= gain[c];
            all.push_back(ghost);
        }
    }
    return all;
}

void draw_folded(const Scene& scene, const Sensor& sensor, std::vector<GhostSpot> ghosts,
                 const FlareRequest& request, FlareImage& image) {
    std::erase_if(ghosts, [&](const GhostSpot& ghost) {
        return !reaches_sensor(ghost, sensor.width_mm, sensor.height_mm);
    });
    if (ghosts.empty()) return;
    const VeilSize size = veil_size(ghosts, sensor.width_mm, sensor.height_mm);
    VeilSeries series(size.period_mm, size.orders);
    double narrowest_mm = size.period_mm;
    for (const GhostSpot& ghost : ghosts) {
        series.add(ghost, scene.veil.kernel);
        image.flux_mm2 += ghost.flux();
        narrowest_mm = std::min(narrowest_mm, ghost.sigmas_mm()[0]);
    }
    draw_veil(series, narrowest_mm,
              pixel_frame(sensor.width_mm, sensor.height_mm, request.width_px), request.threads,
              image);
}

}  // namespace

std::optional<FlareImage> veil_layer(const SceneView& view, const FlareRequest& request,
                                     std::stop_token stop, const FlareImage* ghosts) {
    FlareImage image = black_image(view.lens.sensor, request.width_px);
    const Scene& scene = view.scene;
    if (folded_share(scene) > 0.0) {
        auto folded =
            ghosts != nullptr ? std::optional(ghosts->folded) : folded_anew(view, request, stop);
        if (!folded) return std::nullopt;
        draw_folded(scene, view.lens.sensor, std::move(*folded), request, image);
    }
    for (const Light& light : scene.lights) {
        if (!light.on || !(scene.veil.spread.share > 0.0)) continue;
        const FlareScene& compiled = view.spectra.of(view.lens, light.spectrum);
        const auto direct = ghost_spots(compiled, {GhostPath{}}, of_light(request, light), stop);
        if (!direct) return std::nullopt;
        GhostSpot spot = direct->front();
        const std::array<double, 4> gain = gain_of(scene, light);
        for (std::size_t c = 0; c < 4; ++c) spot.flux_mm2[c] *= gain[c];
        add_glare_spread(scene.veil.spread, spot.flux_mm2, spot.x_mm, spot.y_mm,
                         first_order(compiled.system()).efl_mm, request.threads, image);
        image.flux_mm2 += scene.veil.spread.share * spot.flux();
    }
    measure(image);
    return image;
}

}  // namespace ghostlight
