#include "core/flare/random_rays.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/ghosts/bundle.h"
#include "core/ghosts/pupil.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr std::size_t rays_at_once = 8192;
/// Below this a block's sum is not normally distributed: it joins the rest.
constexpr std::size_t fewest_hits = 40;

/// Sums of one ghost, sparse: most ghosts reach few blocks.
struct GhostSums {
    std::vector<double> sum, squares;
    std::vector<std::size_t> hits;
};

/// 53 bits of the engine: the same numbers with every standard library.
double unit(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1.0p-53; }

bool passes(const OpticalSystem& system, const Bundle<double>& rays, std::size_t i) {
    if (rays.margin[i] < 0.0 || rays.r_rel[i] > 1.0) return false;
    for (std::size_t k = 0; k < static_cast<std::size_t>(rays.stop_crossings); ++k)
        if (!stop_passes(system.stop_mask, rays.stop_u_mm[k][i], rays.stop_v_mm[k][i]))
            return false;
    return true;
}

}  // namespace

std::optional<RandomRays> random_rays(const Prescription& lens, const RandomRaysRequest& request,
                                      std::stop_token stop) {
    const OpticalSystem system = compile(lens, request.wavelength_nm);
    const auto paths = request.only.empty() ? two_reflection_ghosts(system) : request.only;
    const BeamFrame frame = beam_frame(request.light);
    const PupilBox box = entrance_box(system, frame);
    RandomRays result;
    result.pixels = pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    result.block_px = request.block_px;
    result.across = (result.pixels.width_px + request.block_px - 1) / request.block_px;
    result.down = (result.pixels.height_px + request.block_px - 1) / request.block_px;
    const auto blocks =
        static_cast<std::size_t>(result.across) * static_cast<std::size_t>(result.down);
    const auto count = static_cast<double>(request.rays_per_ghost);

    std::vector<GhostSums> sums(paths.size());
    const bool finished = parallel_for(paths.size(), request.threads, stop, [&](std::size_t g) {
        GhostSums& own = sums[g];
        own.sum.assign(blocks, 0.0);
        own.squares.assign(blocks, 0.0);
        own.hits.assign(blocks, 0);
        std::mt19937_64 engine(request.seed * 1'000'003 + g);
        const TracePath<double> path = trace_path<double>(system, paths[g]);
        for (std::size_t done = 0; done < request.rays_per_ghost; done += rays_at_once) {
            Bundle<double> rays;
            const std::size_t more = std::min(rays_at_once, request.rays_per_ghost - done);
            for (std::size_t i = 0; i < more; ++i) {
                rays.u_mm.push_back(std::lerp(box.u0_mm, box.u1_mm, unit(engine)));
                rays.v_mm.push_back(std::lerp(box.v0_mm, box.v1_mm, unit(engine)));
            }
            trace_bundle(path, frame, Weights::polarised, rays);
            for (std::size_t i = 0; i < more; ++i) {
                if (!passes(system, rays, i)) continue;
                const double column = result.pixels.column(rays.x_mm[i]);
                const double row = result.pixels.row(rays.y_mm[i]);
                if (!(column >= 0.0 && column < result.pixels.width_px && row >= 0.0 &&
                      row < result.pixels.height_px))
                    continue;
                const auto at = static_cast<std::size_t>(row / request.block_px) *
                                    static_cast<std::size_t>(result.across) +
                                static_cast<std::size_t>(column / request.block_px);
                own.sum[at] += rays.weight[i];
                own.squares[at] += rays.weight[i] * rays.weight[i];
                ++own.hits[at];
            }
        }
    });
    if (!finished) return std::nullopt;

    result.flux_mm2.assign(blocks, 0.0);
    result.variance_mm4.assign(blocks, 0.0);
    result.hits.assign(blocks, 0);
    const double area = box.area_mm2();
    for (const GhostSums& own : sums)
        for (std::size_t b = 0; b < blocks; ++b) {
            const double mean = own.sum[b] / count;
            result.flux_mm2[b] += area * mean;
            result.variance_mm4[b] += area * area * (own.squares[b] / count - mean * mean) / count;
            result.hits[b] += own.hits[b];
        }
    return result;
}

RayAgreement agreement(const RandomRays& rays, const std::vector<float>& irradiance,
                       const std::vector<float>& error) {
    const double pixel_area = rays.pixels.pixel_area_mm2();
    std::vector<double> light(rays.flux_mm2.size(), 0.0), doubt(rays.flux_mm2.size(), 0.0);
    for (int row = 0; row < rays.pixels.height_px; ++row)
        for (int column = 0; column < rays.pixels.width_px; ++column) {
            const auto b = static_cast<std::size_t>(row / rays.block_px * rays.across +
                                                    column / rays.block_px);
            const auto i = static_cast<std::size_t>(row * rays.pixels.width_px + column);
            light[b] += pixel_area * static_cast<double>(irradiance[i]);
            doubt[b] += pixel_area * static_cast<double>(error[i]);
        }
    RayAgreement result;
    double own = 0.0, all = 0.0, total = 0.0, counted = 0.0, scatter = 0.0;
    struct Sum {
        double light = 0.0, doubt = 0.0, flux = 0.0, variance = 0.0;
        std::size_t hits = 0;
    };
    auto compare = [&](const Sum& sum) {
        const double variance = sum.variance + sum.doubt * sum.doubt;
        if (!(variance > 0.0)) return;
        const double difference = sum.light - sum.flux;
        result.chi2 += difference * difference / variance;
        own += sum.doubt * sum.doubt;
        all += variance;
        ++result.blocks;
    };
    Sum rest;
    for (std::size_t b = 0; b < light.size(); ++b) {
        total += light[b];
        counted += rays.flux_mm2[b];
        scatter += rays.variance_mm4[b];
        const Sum one{light[b], doubt[b], rays.flux_mm2[b], rays.variance_mm4[b], rays.hits[b]};
        if (one.hits >= fewest_hits) {
            compare(one);
            continue;
        }
        rest.light += one.light;
        rest.doubt += one.doubt;
        rest.flux += one.flux;
        rest.variance += one.variance;
        rest.hits += one.hits;
    }
    if (rest.hits >= fewest_hits) compare(rest);
    if (result.blocks > 0) {
        const auto k = static_cast<double>(result.blocks);
        result.deviation =
            (std::cbrt(result.chi2 / k) - (1.0 - 2.0 / (9.0 * k))) / std::sqrt(2.0 / (9.0 * k));
    }
    if (counted > 0.0) {
        result.flux_ratio = total / counted;
        result.flux_ratio_sigma = std::sqrt(scatter) / counted;
    }
    result.share_of_picture_error = all > 0.0 ? own / all : 0.0;
    return result;
}

}  // namespace ghostlight
