#include "core/flare/radial_flare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "core/elapsed.h"
#include "core/flare/color_raster.h"
#include "core/flare/draw_picture.h"
#include "core/flare/grid_light.h"
#include "core/flare/radial_profile.h"
#include "core/ghosts/double_trace.h"
#include "core/ghosts/incoherent_stack.h"
#include "core/ghosts/path_stability.h"
#include "core/ghosts/pupil.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t search_cells = 128;
constexpr int most_zooms = 8;
/// The search is over when the rays that pass are this share of the line.
constexpr std::size_t enough_passing = search_cells / 3;
constexpr std::size_t compared_rays = 8;
constexpr int most_parts = 6;    ///< rings between two rays
constexpr double band_px = 0.5;  ///< colours that land closer are drawn as one
constexpr int most_bands = 16;
/// Of the steps from ring to ring: each ring is even, its light at most half a ring off.
constexpr double step_share = 0.25;

std::size_t cells_for(double tolerance) {
    return tolerance >= 0.02 ? 64 : tolerance >= 0.0075 ? 128 : 256;
}

struct Span {
    double low = 0.0, high = 0.0;
};

template <int C>
struct Ring {
    double from_px = 0.0, to_px = 0.0;
    std::array<double, C> flux{};  ///< value × px²
};

template <int C>
class RadialGhosts {
   public:
    RadialGhosts(const FlareScene& scene, const FlareRequest& request, const PixelFrame& frame)
        : scene_(scene),
          frame_(frame),
          beam_(beam_frame({0.0, 90.0})),
          widest_mm_(entrance_box(scene.system(), beam_).v1_mm),
          cells_(cells_for(request.tolerance)) {
        for (const SpectralSample& s : scene.samples)
            node_shares_.push_back(scene.interpolation(s.wavelength_nm));
    }

    std::vector<Ring<C>> draw(PlannedGhost& planned) const {
        const Lines lines = lines_of(planned);
        std::vector<Ring<C>> rings;
        if (planned.fate != GhostFate::drawn) return rings;
        const std::vector<float> weights = weights_of(lines, planned);
        const double half = 0.5 * shift_px(lines);
        planned.bands = std::clamp(static_cast<int>(std::ceil(half / band_px)), 1, most_bands);
        const ColorAxis axis(scene_.samples);
        for (int band = 0; band < planned.bands; ++band) {
            std::vector<double> shares(lines.rays.size(), 0.0);
            if (planned.bands > 1)
                shares = scene_.interpolation(axis.wavelength_nm((band + 0.5) / planned.bands));
            else
                shares[scene_.main] = 1.0;
            add_rings(lines, weights, shares, channel_shares<C>(scene_, band, planned.bands), rings,
                      planned);
        }
        judge(rings, planned);
        return rings;
    }

   private:
    const FlareScene& scene_;
    const PixelFrame& frame_;
    BeamFrame beam_;
    double widest_mm_;
    std::size_t cells_;
    std::vector<std::vector<double>> node_shares_;  ///< of each sample

    /// A ghost's line of rays at each geometry wavelength.
    struct Lines {
        std::vector<Bundle<float>> rays;
        bool in_double = false;
    };

    void trace(const GhostPath& path, std::size_t node, bool in_double, Weights weights,
               Bundle<float>& rays) const {
        const OpticalSystem& system = scene_.geometry[node];
        if (in_double)
            trace_in_double(system, path, beam_, weights, rays);
        else
            trace_bundle(trace_path<float>(system, path), beam_, weights, rays);
    }

    static void lay(const Span& span, std::size_t cells, Bundle<float>& rays) {
        rays.u_mm.assign(cells + 1, 0.0F);
        rays.v_mm.clear();
        for (std::size_t k = 0; k <= cells; ++k)
            rays.v_mm.push_back(static_cast<float>(std::lerp(
                span.low, span.high, static_cast<double>(k) / static_cast<double>(cells))));
    }

    /// ≥ 0 where a ray passes all rims; continuous.
    double clearance(const Bundle<float>& rays, std::size_t k) const {
        double least = 1.0 - static_cast<double>(rays.r_rel[k]);
        const double stop_mm = scene_.system().stop_mask.semi_diameter_mm;
        for (int s = 0; s < rays.stop_crossings; ++s) {
            const double at = static_cast<double>(rays.stop_v_mm[static_cast<std::size_t>(s)][k]);
            least = std::min(least, 1.0 - std::abs(at) / stop_mm);
        }
        return least;
    }

    /// Zooms in on what passes.
    Lines lines_of(PlannedGhost& planned) const {
        Lines lines;
        Span span{0.0, widest_mm_};
        Bundle<float> rays;
        for (int zoom = 0; zoom < most_zooms; ++zoom) {
            lay(span, search_cells, rays);
            trace(planned.path, scene_.main, lines.in_double, Weights::none, rays);
            planned.rays += rays.size();
            if (zoom == 0) {
                PathStability seen;
                seen.position_worst_mm = float_displacement_mm(scene_.system(), planned.path, beam_,
                                                               rays, compared_rays);
                lines.in_double = is_ill_conditioned(seen, frame_.pitch_mm * frame_.width_px);
            }
            std::size_t first = rays.size(), last = 0, passing = 0;
            for (std::size_t k = 0; k < rays.size(); ++k) {
                if (rays.margin[k] < 0.0F || clearance(rays, k) < 0.0) continue;
                first = std::min(first, k);
                last = k;
                ++passing;
            }
            if (passing == 0) {
                planned.fate = GhostFate::nothing_passes;
                return lines;
            }
            // Room for what lies between rays, and for other colours.
            const auto low = static_cast<double>(rays.v_mm[first > 1 ? first - 2 : 0]);
            const auto high = static_cast<double>(rays.v_mm[std::min(last + 2, search_cells)]);
            span = {low, high};
            if (passing >= enough_passing) break;
        }
        planned.box = {-span.high, span.high, -span.high, span.high};
        planned.cells = static_cast<int>(cells_);
        for (std::size_t g = 0; g < scene_.geometry.size(); ++g) {
            Bundle<float>& line = lines.rays.emplace_back();
            lay(span, cells_, line);
            line.keep_cosines = true;
            trace(planned.path, g, lines.in_double, Weights::none, line);
            planned.rays += line.size();
        }
        return lines;
    }

    double shift_px(const Lines& lines) const {
        const Bundle<float>&a = lines.rays.front(), &b = lines.rays.back();
        double most = 0.0;
        for (std::size_t k = 0; k < a.size(); ++k)
            if (a.margin[k] >= 0.0F && b.margin[k] >= 0.0F && clearance(a, k) >= 0.0)
                most = std::max(most, std::abs(static_cast<double>(a.y_mm[k] - b.y_mm[k])));
        return most / frame_.pitch_mm;
    }

    /// At each ray the scene's samples: films at each geometry wavelength's own angles, between
    /// them interpolated like positions. All planes of incidence are one.
    std::vector<float> weights_of(const Lines& lines, const PlannedGhost& planned) const {
        const std::size_t samples = scene_.samples.size(), stride = scene_.films.stride();
        const std::size_t count = lines.rays.front().size();
        std::vector<float> result(count * samples, 0.0F), own, polarised;
        for (std::size_t g = 0; g < lines.rays.size(); ++g) {
            const auto path = trace_path<float>(scene_.geometry[g], planned.path);
            scene_.films.weights(path, lines.rays[g], own);
            if (scene_.coating_model == CoatingModel::exact)
                scene_.films.polarisation(path, lines.rays[g], polarised);
            else
                polarised.assign(own.size(), 1.0F);
            for (std::size_t k = 0; k < count; ++k)
                for (std::size_t w = 0; w < samples; ++w)
                    result[k * samples + w] += static_cast<float>(node_shares_[w][g]) *
                                               polarised[k * stride + w] * own[k * stride + w];
        }
        for (float& weight : result) weight = std::max(weight, 0.0F);
        return result;
    }

    void add_rings(const Lines& lines, const std::vector<float>& weights,
                   const std::vector<double>& at, const std::vector<float>& shares,
                   std::vector<Ring<C>>& rings, PlannedGhost& planned) const {
        const std::size_t samples = scene_.samples.size();
        struct Node {
            double s = 0.0, y_px = 0.0, margin = 1.0, clearance = 0.0;
            std::array<double, C> light{};
        };
        const auto node = [&](std::size_t k) {
            Node n;
            for (std::size_t g = 0; g < lines.rays.size(); ++g) {
                const Bundle<float>& line = lines.rays[g];
                n.y_px += at[g] * static_cast<double>(line.y_mm[k]) / frame_.pitch_mm;
                n.clearance += at[g] * clearance(line, k);
                n.margin = std::min(n.margin, static_cast<double>(line.margin[k]));
            }
            n.s = static_cast<double>(lines.rays.front().v_mm[k]);
            for (std::size_t w = 0; w < samples; ++w)
                for (std::size_t c = 0; c < C; ++c)
                    n.light[c] += static_cast<double>(shares[w * C + c] * weights[k * samples + w]);
            return n;
        };
        const auto between = [](const Node& a, const Node& b, double t) {
            Node n;
            n.s = std::lerp(a.s, b.s, t);
            n.y_px = std::lerp(a.y_px, b.y_px, t);
            for (std::size_t c = 0; c < C; ++c) n.light[c] = std::lerp(a.light[c], b.light[c], t);
            return n;
        };
        std::vector<Node> nodes;
        for (std::size_t k = 0; k < lines.rays.front().size(); ++k) nodes.push_back(node(k));
        for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
            Node a = nodes[k], b = nodes[k + 1];
            // Where a ray fails, its place and its light mean nothing.
            if (a.margin < 0.0 && b.margin < 0.0) continue;
            if (a.margin < 0.0) std::tie(a.y_px, a.light) = std::tie(b.y_px, b.light);
            if (b.margin < 0.0) std::tie(b.y_px, b.light) = std::tie(a.y_px, a.light);
            double from = 0.0, to = 1.0;
            for (const auto& [fa, fb] :
                 {std::pair{a.margin, b.margin}, std::pair{a.clearance, b.clearance}}) {
                if (fa < 0.0 && fb < 0.0) to = from;
                if (fa < 0.0 && fb >= 0.0) from = std::max(from, fa / (fa - fb));
                if (fa >= 0.0 && fb < 0.0) to = std::min(to, fa / (fa - fb));
            }
            if (!(from < to)) continue;
            // Places by a cubic through four rays: rings of about a pixel follow it.
            const Node* before = k > 0 ? &nodes[k - 1] : nullptr;
            const Node* after = k + 2 < nodes.size() ? &nodes[k + 2] : nullptr;
            const bool smooth = before != nullptr && after != nullptr && before->margin >= 0.0 &&
                                a.margin >= 0.0 && b.margin >= 0.0 && after->margin >= 0.0;
            const auto at_share = [&](double t) {
                Node n = between(a, b, t);
                if (smooth) {
                    const double bend_a = before->y_px - 2.0 * a.y_px + b.y_px;
                    const double bend_b = a.y_px - 2.0 * b.y_px + after->y_px;
                    n.y_px -= t * (1.0 - t) / 6.0 * ((2.0 - t) * bend_a + (1.0 + t) * bend_b);
                }
                return n;
            };
            const int parts =
                smooth ? std::clamp(static_cast<int>(std::ceil(std::abs(b.y_px - a.y_px))), 1,
                                    most_parts)
                       : 1;
            Node inner = at_share(from);
            for (int part = 1; part <= parts; ++part) {
                const Node outer = at_share(std::lerp(from, to, static_cast<double>(part) / parts));
                add_ring(inner, outer, rings, planned);
                inner = outer;
            }
        }
    }

    template <class Node>
    void add_ring(const Node& a, const Node& b, std::vector<Ring<C>>& rings,
                  PlannedGhost& planned) const {
        const double area_mm2 = pi * (b.s * b.s - a.s * a.s);
        std::array<double, C> flux;
        for (std::size_t c = 0; c < C; ++c)
            flux[c] = area_mm2 * 0.5 * (a.light[c] + b.light[c]) / frame_.pixel_area_mm2();
        const double low = std::abs(a.y_px), high = std::abs(b.y_px);
        planned.whole_flux_mm2 += flux[C - 1] * frame_.pixel_area_mm2();
        planned.spot.xx_mm2 += flux[C - 1] * 0.25 * (low * low + high * high);
        if (a.y_px * b.y_px >= 0.0) {
            rings.push_back({low, high, flux});
            return;
        }
        // Through the axis: a disc on either side of it.
        Ring<C> one{0.0, low, flux}, other{0.0, high, flux};
        for (std::size_t c = 0; c < C; ++c) {
            one.flux[c] *= low / (low + high);
            other.flux[c] *= high / (low + high);
        }
        rings.push_back(one);
        rings.push_back(other);
    }

    /// What of a circle lies on the frame.
    double share_on_frame(double radius_px) const {
        double share = 1.0;
        for (const int side_px : {frame_.width_px, frame_.height_px})
            if (radius_px > 0.5 * side_px) share -= 2.0 / pi * std::acos(0.5 * side_px / radius_px);
        return std::max(0.0, share);
    }

    /// Light on the sensor, moments, and the error that even rings leave.
    void judge(const std::vector<Ring<C>>& rings, PlannedGhost& planned) const {
        const double pixel_mm2 = frame_.pixel_area_mm2();
        const auto density = [](const Ring<C>& ring) {
            const double area =
                pi * std::abs(ring.to_px * ring.to_px - ring.from_px * ring.from_px);
            return std::pair{area > 0.0 ? ring.flux[C - 1] / area : 0.0, area};
        };
        for (std::size_t k = 0; k < rings.size(); ++k) {
            const double share = share_on_frame(std::sqrt(
                0.5 * (rings[k].from_px * rings[k].from_px + rings[k].to_px * rings[k].to_px)));
            planned.flux_mm2 += share * rings[k].flux[C - 1] * pixel_mm2;
            const auto [value, area] = density(rings[k]);
            // Rings of a pixel or less are even in the picture.
            const double breadth = std::abs(rings[k].to_px - rings[k].from_px);
            if (k == 0 || breadth < 1.0) continue;
            const auto [before, its_area] = density(rings[k - 1]);
            if (!(its_area > 0.0)) continue;
            planned.error_mm2 += std::min(share * rings[k].flux[C - 1],
                                          share * step_share * area * std::abs(value - before)) *
                                 pixel_mm2;
        }
        if (planned.whole_flux_mm2 > 0.0)
            planned.spot.xx_mm2 *= pixel_mm2 * pixel_mm2 / planned.whole_flux_mm2;
        planned.spot.yy_mm2 = planned.spot.xx_mm2;
        planned.spot.flux_mm2.fill(planned.whole_flux_mm2);
        planned.allowance_mm2 = planned.error_mm2;
        if (!(planned.whole_flux_mm2 > 0.0))
            planned.fate = GhostFate::nothing_passes;
        else if (!(planned.flux_mm2 > 0.0))
            planned.fate = GhostFate::off_sensor;
    }
};

/// Turns a profile about the middle: `put(pixel, values)` for every pixel, row by row and its
/// mirror images.
template <int C, class Put>
bool turned(const RadialProfile<C>& profile, const PixelFrame& frame, unsigned threads,
            const std::stop_token& stop, Put put) {
    const auto filtered = profile.filtered();
    const int width = frame.width_px, height = frame.height_px;
    const int columns = (width + 1) / 2, rows = (height + 1) / 2;
    return parallel_for(static_cast<std::size_t>(rows), threads, stop, [&](std::size_t j) {
        std::vector<float> line(static_cast<std::size_t>(columns) * C);
        const int row = static_cast<int>(j);
        filtered.draw_row(row, line);
        for (const int at : {row, height - 1 - row}) {
            for (int i = 0; i < width; ++i)
                put(static_cast<std::size_t>(at * width + i), at,
                    line.data() + std::min(i, width - 1 - i) * C);
            if (at == height - 1 - at) break;
        }
    });
}

template <int C>
std::optional<FlareImage> render(const FlareScene& scene, const FlareRequest& request,
                                 const std::stop_token& stop) {
    const auto began = Clock::now();
    const OpticalSystem& system = scene.system();
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    FlareImage image = empty_image(system, frame);
    const std::vector<GhostPath>& paths = request.only.empty() ? scene.ghosts : request.only;
    image.ghosts = paths.size();
    FlarePlan& plan = image.plan;
    plan.tolerance = request.tolerance;
    plan.not_modelled = higher_order_share(system);
    plan.ghosts.resize(paths.size());
    std::vector<std::vector<Ring<C>>> rings(paths.size());
    const RadialGhosts<C> ghosts(scene, request, frame);
    if (!parallel_for(paths.size(), request.threads, stop, [&](std::size_t g) {
            plan.ghosts[g].path = paths[g];
            rings[g] = ghosts.draw(plan.ghosts[g]);
        }))
        return std::nullopt;
    image.times.trace_ms = ms_since(began);

    const auto rastered = Clock::now();
    RadialProfile<C> profile(frame);
    RadialProfile<gray_channels> highlight(frame);
    for (std::size_t g = 0; g < paths.size(); ++g) {
        const PlannedGhost& planned = plan.ghosts[g];
        plan.flux_mm2 += planned.flux_mm2;
        plan.error_mm2 += planned.error_mm2;
        image.flux_mm2 += planned.whole_flux_mm2;
        image.rays += planned.rays;
        image.cells += rings[g].size();
        const bool is_highlighted =
            std::ranges::find(request.highlighted, planned.path) != request.highlighted.end();
        for (const Ring<C>& ring : rings[g]) {
            profile.add(ring.from_px, ring.to_px, ring.flux);
            if (is_highlighted) highlight.add(ring.from_px, ring.to_px, {ring.flux[C - 1]});
        }
    }
    const auto pixels =
        static_cast<std::size_t>(frame.width_px) * static_cast<std::size_t>(frame.height_px);
    image.irradiance.resize(pixels);
    image.rgb.resize(3 * pixels);
    std::vector<double> row_sums(static_cast<std::size_t>(frame.height_px), 0.0);
    const bool drawn = turned<C>(
        profile, frame, request.threads, stop, [&](std::size_t pixel, int row, const float* from) {
            // What rounding leaves below zero is no light; colours outside the gamut stay.
            const float value = std::max(0.0F, from[C - 1]);
            image.irradiance[pixel] = value;
            for (std::size_t c = 0; c < 3; ++c)
                image.rgb[3 * pixel + c] = C == gray_channels ? value : from[c];
            row_sums[static_cast<std::size_t>(row)] += static_cast<double>(value);
        });
    if (!drawn) return std::nullopt;
    for (const double sum : row_sums) image.flux_on_sensor_mm2 += sum * frame.pixel_area_mm2();
    if (!request.highlighted.empty()) {
        image.highlight.resize(pixels);
        if (!turned<gray_channels>(highlight, frame, request.threads, stop,
                                   [&](std::size_t pixel, int, const float* from) {
                                       image.highlight[pixel] = std::max(0.0F, *from);
                                   }))
            return std::nullopt;
    }
    image.times.raster_ms = ms_since(rastered);
    image.times.total_ms = ms_since(began);
    return image;
}

}  // namespace

bool is_radial(const FlareScene& scene, const FlareRequest& request) {
    const StopMask& mask = scene.system().stop_mask;
    return request.light.field_deg == 0.0 && mask.blades == 0 && !mask.picture &&
           !scene.system().sensor_face && !request.ringing && request.folded_share == 0.0 &&
           request.economies == PlanEconomies{};
}

std::optional<FlareImage> render_radial(const FlareScene& scene, const FlareRequest& request,
                                        std::stop_token stop) {
    return scene.is_gray() ? render<gray_channels>(scene, request, stop)
                           : render<color_channels>(scene, request, stop);
}

}  // namespace ghostlight
