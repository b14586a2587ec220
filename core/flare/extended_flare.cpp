#include "core/flare/extended_flare.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "core/elapsed.h"
#include "core/flare/draw_picture.h"
#include "core/flare/picture_levels.h"
#include "core/flare/planned_ghost.h"
#include "core/flare/probe_all.h"
#include "core/flare/ringing.h"
#include "core/flare/spread_mesh.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// Change of a ghost's flux or size over the light that folding may pass over: what is odd in it
/// cancels over the light, so that the error is of second order.
constexpr double rigid_share = 0.15;
constexpr int most_patches = 6;  ///< across
/// Pixels that a pattern has across at the scale where it is folded.
constexpr double folded_px = 12.0;
/// A pattern smaller than this many pixels is a point.
constexpr double point_px = 0.7;
/// Nearer to the axis a ghost moves across the field as it does along it.
constexpr double near_axis = 0.02;
/// Half the step for derivatives where the light itself has no extent to speak of.
constexpr double least_step_deg = 0.05;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

PixelFrame padded(const PixelFrame& frame, int pad_px) {
    PixelFrame wide = frame;
    wide.width_px += 2 * pad_px;
    wide.height_px += 2 * pad_px;
    wide.left_mm -= pad_px * frame.pitch_mm;
    wide.bottom_mm -= pad_px * frame.pitch_mm;
    return wide;
}

/// How one ghost takes part.
struct Part {
    GhostPath path;
    GhostLook look;
    GhostShift shift;
    double change = 0.0;  ///< of flux or size over the pattern
    int patches = 1;      ///< across
};

double size_of(const GhostSpot& moments) { return std::sqrt(moments.xx_mm2 + moments.yy_mm2); }

/// How a ghost moves and changes from its moments at three fields `step_rad` apart.
void set_shift(const std::array<const GhostSpot*, 3>& at, const LightDirection& light,
               double step_rad, double radius_rad, double pitch_mm, Part& part) {
    const double azimuth = rad_from_deg(light.azimuth_deg);
    const auto along = [&](const GhostSpot& m) {
        return m.x_mm * std::cos(azimuth) + m.y_mm * std::sin(azimuth);
    };
    const auto& [before, here, after] = at;
    if (!(before->flux() > 0.0 && here->flux() > 0.0 && after->flux() > 0.0)) {
        part.change = 1.0;  // it comes or goes within the light
        return;
    }
    part.shift.along_px = (along(*after) - along(*before)) / (2.0 * step_rad * pitch_mm);
    const double sine = std::sin(rad_from_deg(light.field_deg));
    part.shift.across_px =
        std::abs(sine) > near_axis ? along(*here) / (sine * pitch_mm) : part.shift.along_px;
    const double reach = radius_rad / step_rad;
    const double smear_mm = radius_rad * std::abs(part.shift.along_px) * pitch_mm;
    for (const GhostSpot* side : {before, after}) {
        const double flux = std::abs(side->flux() / here->flux() - 1.0);
        const double size =
            std::abs(size_of(*side) - size_of(*here)) / std::hypot(size_of(*here), smear_mm, 1e-9);
        part.change = std::max(part.change, reach * std::max(flux, size));
    }
}

std::optional<std::vector<Part>> parts_of(const FlareScene& scene, const FlareRequest& request,
                                          const LightPattern& pattern, const Artistic& artistic,
                                          double pitch_mm, const std::stop_token& stop) {
    std::vector<Part> parts;
    for (const GhostPath& path : request.only.empty() ? scene.ghosts : request.only) {
        Part part{.path = path, .look = look_of(artistic, path), .shift = {}};
        if (part.look.on) parts.push_back(std::move(part));
    }
    if (pattern.is_point()) return parts;
    std::vector<GhostPath> paths;
    for (const Part& part : parts) paths.push_back(part.path);
    const double step_deg =
        std::max(least_step_deg, deg_from_rad(pattern.radius_rad()) / std::numbers::sqrt2);
    std::array<std::vector<GhostSpot>, 3> moments;
    for (const int side : {0, 1, 2}) {
        FlareRequest turned = request;
        turned.light.field_deg += (side - 1) * step_deg;
        if (std::abs(turned.light.field_deg) >= 90.0) turned.light = request.light;
        auto found = ghost_spots(scene, paths, turned, stop);
        if (!found) return std::nullopt;
        moments[idx(side)] = std::move(*found);
    }
    for (std::size_t g = 0; g < parts.size(); ++g) {
        set_shift({&moments[0][g], &moments[1][g], &moments[2][g]}, request.light,
                  rad_from_deg(step_deg), pattern.radius_rad() / std::numbers::sqrt2, pitch_mm,
                  parts[g]);
        parts[g].patches =
            std::clamp(static_cast<int>(std::ceil(parts[g].change / rigid_share)), 1, most_patches);
    }
    return parts;
}

/// The level at which a ghost is drawn before it is folded.
int level_of(const LightPattern& pattern, const GhostShift& shift, int planned) {
    if (pattern.is_point()) return planned;
    const double least_px = std::max(spread_px(pattern, shift)[0], 1.0);
    const int own = static_cast<int>(std::floor(std::log2(least_px / folded_px)));
    return std::clamp(std::max(own, planned), 0, picture_levels - 1);
}

/// Pictures of all levels of a frame, 4 values a pixel.
struct Levels {
    explicit Levels(const PixelFrame& of) : frame(of), pictures(picture_levels) {}
    void add(const Spot& spot) {
        if (spot.values.empty()) return;
        std::vector<float>& picture = pictures[idx(spot.level)];
        const RasterSize size = level_size(frame, spot.level);
        picture.resize(idx(size.width_px * size.height_px) * 4);
        add_spot(spot, frame, picture);
    }
    /// Brings them together.
    const std::vector<float>& together(unsigned threads) {
        for (int level = picture_levels - 2; level >= 0; --level) {
            const auto& coarser = pictures[idx(level) + 1];
            const RasterSize size = level_size(frame, level);
            auto& finer = pictures[idx(level)];
            finer.resize(idx(size.width_px * size.height_px) * 4);
            if (coarser.empty()) continue;
            parallel_for(idx(size.height_px), threads, {}, [&](std::size_t row) {
                add_coarser_rows<color_channels>(coarser, level_size(frame, level + 1), size,
                                                 static_cast<int>(row), static_cast<int>(row) + 1,
                                                 finer);
            });
        }
        return pictures.front();
    }
    PixelFrame frame;
    std::vector<std::vector<float>> pictures;
};

/// Draws the ghosts of one patch of the light, a few at a time and added in their order.
bool draw_patch(const FlareScene& scene, const FlareRequest& request, const PatternPatch& patch,
                const std::vector<const Part*>& parts, const std::stop_token& stop, Levels& levels,
                Levels* highlight, FlareImage& image) {
    FlareRequest one = request;
    one.light = patch.light;
    one.only.clear();
    for (const Part* part : parts) one.only.push_back(part->path);
    const GhostPlanner planner(scene, one.light, levels.frame, one.search);
    auto probed = probe_all(scene, planner, one, stop);
    if (!probed) return false;
    double layer_flux_mm2 = 0.0;
    for (const ProbedGhost& ghost : *probed) layer_flux_mm2 += ghost.planned.flux_mm2;
    constexpr std::size_t at_once = 16;
    for (std::size_t first = 0; first < parts.size(); first += at_once) {
        std::vector<Spot> spots(std::min(at_once, parts.size() - first));
        std::vector<RungGhost> rung(spots.size());
        const bool finished = parallel_for(spots.size(), request.threads, stop, [&](std::size_t n) {
            ProbedGhost& ghost = (*probed)[first + n];
            if (ghost.planned.fate != GhostFate::drawn) return;
            const Part& part = *parts[first + n];
            ColorMesh<color_channels> mesh;
            planner.draw(ghost, mesh);
            const int level = level_of(patch.pattern, part.shift, ghost.planned.level);
            const bool small = spread_px(patch.pattern, part.shift)[1] < point_px;
            const SpreadKernel kernel =
                spread_kernel(small ? LightPattern{} : patch.pattern, patch.light, part.shift,
                              std::ldexp(1.0, -level));
            std::array<double, 4> gain = part.look.gain;
            for (double& each : gain) each *= patch.share;
            ghost.planned.level = level;
            RungMesh fringes;
            if (one.ringing)
                fringes =
                    ringing_of(scene, one, planner, ghost, layer_flux_mm2, probed->size(), stop);
            if (!fringes.empty()) rung[n] = fringes.report;
            spots[n] = draw_spot(mesh, fringes, levels.frame, level,
                                 part.look.offset_x_mm / levels.frame.pitch_mm,
                                 part.look.offset_y_mm / levels.frame.pitch_mm, gain, kernel);
        });
        if (!finished) return false;
        for (std::size_t n = 0; n < spots.size(); ++n) {
            levels.add(spots[n]);
            if (highlight && std::ranges::find(request.highlighted, parts[first + n]->path) !=
                                 request.highlighted.end())
                highlight->add(spots[n]);
            const RungGhost& own = rung[n];
            if (own.fresnel_number > 0.0 &&
                std::ranges::find(image.ringing, own.path, &RungGhost::path) == image.ringing.end())
                image.ringing.push_back(own);
        }
    }
    for (std::size_t g = 0; g < parts.size(); ++g) {
        const PlannedGhost& planned = (*probed)[g].planned;
        const double share = patch.share * parts[g]->look.gain[3];
        image.rays += planned.rays;
        image.flux_mm2 += share * planned.whole_flux_mm2;
        image.plan.flux_mm2 += share * planned.flux_mm2;
        image.plan.error_mm2 += share * planned.error_mm2;
    }
    FlarePlan plan = plan_of(scene, one, *probed);
    image.plan.not_modelled = plan.not_modelled;
    std::ranges::move(plan.ghosts, std::back_inserter(image.plan.ghosts));
    return true;
}

/// The frame out of the padded one.
void crop(const std::vector<float>& wide, int wide_px, int pad_px, const PixelFrame& frame,
          FlareImage& image) {
    const std::size_t count = idx(frame.width_px) * idx(frame.height_px);
    image.rgb.resize(3 * count);
    image.irradiance.resize(count);
    double sum = 0.0;
    for (int row = 0; row < frame.height_px; ++row)
        for (int column = 0; column < frame.width_px; ++column) {
            const float* from = wide.data() + idx((row + pad_px) * wide_px + column + pad_px) * 4;
            const std::size_t i = idx(row * frame.width_px + column);
            std::copy(from, from + 3, &image.rgb[3 * i]);
            image.irradiance[i] = std::max(0.0F, from[3]);
            sum += static_cast<double>(image.irradiance[i]);
        }
    image.flux_on_sensor_mm2 = sum * frame.pixel_area_mm2();
}

int padding_px(const LightPattern& pattern, const std::vector<Part>& parts,
               const PixelFrame& frame) {
    double pad_px = 0.0;
    for (const Part& part : parts)
        pad_px = std::max(
            pad_px, 0.5 * spread_px(pattern, part.shift)[1] +
                        std::max(std::abs(part.look.offset_x_mm), std::abs(part.look.offset_y_mm)) /
                            frame.pitch_mm);
    return static_cast<int>(std::ceil(std::min(pad_px, 0.5 * frame.width_px)));
}

}  // namespace

std::optional<std::vector<GhostSpot>> ghost_spots(const FlareScene& scene,
                                                  const std::vector<GhostPath>& paths,
                                                  const FlareRequest& request,
                                                  std::stop_token stop) {
    const OpticalSystem& system = scene.system();
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    const GhostPlanner planner(scene, request.light, frame, request.search);
    std::vector<GhostSpot> moments(paths.size());
    if (!parallel_for(paths.size(), request.threads, std::move(stop), [&](std::size_t g) {
            const ProbedGhost probed = planner.probe(paths[g]);
            if (probed.planned.fate != GhostFate::nothing_passes) moments[g] = planner.spot(probed);
        }))
        return std::nullopt;
    return moments;
}

std::optional<FlareImage> render_extended(const FlareScene& scene, const FlareRequest& request,
                                          const LightPattern& pattern, const Artistic& artistic,
                                          std::stop_token stop) {
    const auto began = Clock::now();
    const OpticalSystem& system = scene.system();
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    FlareImage image = empty_image(system, frame);
    auto parts = parts_of(scene, request, pattern, artistic, frame.pitch_mm, stop);
    if (!parts) return std::nullopt;
    image.ghosts = parts->size();
    image.plan.tolerance = request.tolerance;
    image.times.bounds_ms = ms_since(began);

    const auto traced = Clock::now();
    const int pad_px = padding_px(pattern, *parts, frame);
    Levels levels(padded(frame, pad_px));
    Levels highlight(levels.frame);
    const bool highlights = !request.highlighted.empty();
    std::map<int, std::vector<const Part*>> by_patches;
    for (const Part& part : *parts) by_patches[part.patches].push_back(&part);
    for (const auto& [across, of_these] : by_patches)
        for (const PatternPatch& patch : patches(pattern, request.light, across))
            if (!draw_patch(scene, request, patch, of_these, stop, levels,
                            highlights ? &highlight : nullptr, image))
                return std::nullopt;
    image.times.trace_ms = ms_since(traced);

    const auto composed = Clock::now();
    crop(levels.together(request.threads), levels.frame.width_px, pad_px, frame, image);
    if (highlights) {
        FlareImage marked = empty_image(system, frame);
        crop(highlight.together(request.threads), levels.frame.width_px, pad_px, frame, marked);
        image.highlight = std::move(marked.irradiance);
    }
    image.times.composite_ms = ms_since(composed);
    image.times.total_ms = ms_since(began);
    return image;
}

std::optional<ImageSpread> image_spread(const FlareScene& scene, const FlareRequest& request,
                                        const LightPattern& pattern, const GhostPath& path,
                                        std::stop_token stop) {
    const OpticalSystem& system = scene.system();
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    FlareRequest one = request;
    one.only = {path};
    const auto parts = parts_of(scene, one, pattern, {}, frame.pitch_mm, stop);
    if (!parts) return std::nullopt;
    return ImageSpread{parts->front().shift, padding_px(pattern, *parts, frame)};
}

FlareImage spread_image(const FlareImage& wide, const ImageSpread& spread,
                        const LightPattern& pattern, const LightDirection& light,
                        const FlareRequest& request) {
    const PixelFrame frame =
        pixel_frame(wide.sensor_width_mm, wide.sensor_height_mm, wide.width_px);
    const int level = level_of(pattern, spread.shift, 0);
    const RasterSize size = level_size(frame, level);
    const int step = 1 << level;
    Spot spot{.level = level,
              .left = 0,
              .bottom = 0,
              .width = size.width_px,
              .height = size.height_px,
              .values = std::vector<float>(idx(size.width_px) * idx(size.height_px) * 4, 0.0F)};
    for (int row = 0; row < wide.height_px; ++row)
        for (int column = 0; column < wide.width_px; ++column) {
            const std::size_t from = idx(row * wide.width_px + column);
            float* to = &spot.values[idx((row / step + size.margin_px) * size.width_px +
                                         column / step + size.margin_px) *
                                     4];
            const float share = 1.0F / static_cast<float>(step * step);
            for (std::size_t c = 0; c < 3; ++c) to[c] += share * wide.rgb[3 * from + c];
            to[3] += share * wide.irradiance[from];
        }
    fold_spot(spread_kernel(pattern, light, spread.shift, size.scale), spot);
    Levels levels(frame);
    levels.add(spot);
    FlareImage image = wide;
    image.width_px -= 2 * spread.pad_px;
    image.height_px -= 2 * spread.pad_px;
    image.sensor_width_mm -= 2.0 * spread.pad_px * frame.pitch_mm;
    image.sensor_height_mm -= 2.0 * spread.pad_px * frame.pitch_mm;
    const PixelFrame inner =
        pixel_frame(image.sensor_width_mm, image.sensor_height_mm, image.width_px);
    crop(levels.together(request.threads), frame.width_px, spread.pad_px, inner, image);
    return image;
}

std::optional<FlareImage> render_sampled(const Prescription& lens, const FlareRequest& request,
                                         const LightPattern& pattern, int across,
                                         std::stop_token stop) {
    std::optional<FlareImage> mean;
    for (const PatternPatch& patch : patches(pattern, request.light, across)) {
        FlareRequest one = request;
        one.light = patch.light;
        std::optional<FlareImage> image = render_flare(lens, one, stop);
        if (!image) return std::nullopt;
        const std::array<double, 4> gain = {patch.share, patch.share, patch.share, patch.share};
        if (!mean) {
            mean = *image;
            std::ranges::fill(mean->rgb, 0.0F);
            std::ranges::fill(mean->irradiance, 0.0F);
            std::ranges::fill(mean->highlight, 0.0F);
            mean->flux_mm2 = mean->flux_on_sensor_mm2 = 0.0;
            mean->rays = mean->cells = 0;
            mean->times = {};
        }
        add_image(*mean, *image, gain);
    }
    return mean;
}

void add_image(FlareImage& image, const FlareImage& other, const std::array<double, 4>& gain) {
    const std::array<float, 3> rgb = {static_cast<float>(gain[0]), static_cast<float>(gain[1]),
                                      static_cast<float>(gain[2])};
    for (std::size_t i = 0; i < image.rgb.size(); i += 3)
        for (std::size_t c = 0; c < 3; ++c) image.rgb[i + c] += rgb[c] * other.rgb[i + c];
    const auto level = static_cast<float>(gain[3]);
    for (std::size_t i = 0; i < image.irradiance.size(); ++i)
        image.irradiance[i] += level * other.irradiance[i];
    if (image.highlight.size() < other.highlight.size())
        image.highlight.resize(other.highlight.size(), 0.0F);
    for (std::size_t i = 0; i < other.highlight.size(); ++i)
        image.highlight[i] += level * other.highlight[i];
    for (GhostSpot spot : other.folded) {
        for (std::size_t c = 0; c < 4; ++c) spot.flux_mm2[c] *= gain[c];
        image.folded.push_back(spot);
    }
    image.flux_mm2 += gain[3] * other.flux_mm2;
    image.flux_on_sensor_mm2 += gain[3] * other.flux_on_sensor_mm2;
    image.rays += other.rays;
    image.cells += other.cells;
    image.times.bounds_ms += other.times.bounds_ms;
    image.times.trace_ms += other.times.trace_ms;
    image.times.raster_ms += other.times.raster_ms;
    image.times.composite_ms += other.times.composite_ms;
    image.times.total_ms += other.times.total_ms;
}

void move_image(FlareImage& image, int right_px, int up_px) {
    if (right_px == 0 && up_px == 0) return;
    const auto moved = [&](const std::vector<float>& from, int channels) {
        std::vector<float> to(from.size(), 0.0F);
        if (from.empty()) return to;
        for (int row = 0; row < image.height_px; ++row)
            for (int column = 0; column < image.width_px; ++column) {
                const int i = column - right_px, j = row - up_px;
                if (i < 0 || j < 0 || i >= image.width_px || j >= image.height_px) continue;
                for (int c = 0; c < channels; ++c)
                    to[idx((row * image.width_px + column) * channels + c)] =
                        from[idx((j * image.width_px + i) * channels + c)];
            }
        return to;
    };
    image.rgb = moved(image.rgb, 3);
    image.irradiance = moved(image.irradiance, 1);
    image.highlight = moved(image.highlight, 1);
}

}  // namespace ghostlight
