#include "core/ghosts/double_trace.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {
namespace {

void round_to(const std::vector<double>& from, std::vector<float>& to) {
    to.resize(from.size());
    std::ranges::transform(from, to.begin(), [](double x) { return static_cast<float>(x); });
}

}  // namespace

void trace_in_double(const OpticalSystem& system, const GhostPath& path, const BeamFrame& frame,
                     Weights weights, Bundle<float>& rays) {
    Bundle<double> full;
    full.u_mm.assign(rays.u_mm.begin(), rays.u_mm.end());
    full.v_mm.assign(rays.v_mm.begin(), rays.v_mm.end());
    full.keep_cosines = rays.keep_cosines;
    trace_bundle(trace_path<double>(system, path), frame, weights, full);
    round_to(full.x_mm, rays.x_mm);
    round_to(full.y_mm, rays.y_mm);
    round_to(full.weight, rays.weight);
    round_to(full.weight_average, rays.weight_average);
    round_to(full.margin, rays.margin);
    round_to(full.r_rel, rays.r_rel);
    for (std::size_t k = 0; k < max_stop_crossings; ++k) {
        round_to(full.stop_u_mm[k], rays.stop_u_mm[k]);
        round_to(full.stop_v_mm[k], rays.stop_v_mm[k]);
    }
    for (std::size_t k = 0; k < max_reflections; ++k) {
        round_to(full.reflectance[k], rays.reflectance[k]);
        round_to(full.onset[k], rays.onset[k]);
    }
    rays.stop_crossings = full.stop_crossings;
    rays.reflections = full.reflections;
    round_to(full.cosines, rays.cosines);
    rays.cosine_stride = full.cosine_stride;
    round_to(full.lengths_mm, rays.lengths_mm);
}

double float_displacement_mm(const OpticalSystem& system, const GhostPath& path,
                             const BeamFrame& frame, const Bundle<float>& traced,
                             std::size_t rays) {
    const double reach_mm = 0.5 * std::hypot(system.sensor_width_mm, system.sensor_height_mm);
    auto lands = [&](std::size_t k) {
        return traced.margin[k] >= 0.0F && traced.r_rel[k] <= 1.0F &&
               std::hypot(static_cast<double>(traced.x_mm[k]),
                          static_cast<double>(traced.y_mm[k])) <= reach_mm;
    };
    std::vector<std::size_t> landed;
    for (std::size_t k = 0; k < traced.size(); ++k)
        if (lands(k)) landed.push_back(k);
    // Spread over the beam: those at its rim are off by most.
    const std::size_t count = std::min(rays, landed.size());
    Bundle<double> full;
    std::vector<std::size_t> compared;
    for (std::size_t n = 0; n < count; ++n) {
        compared.push_back(landed[count > 1 ? n * (landed.size() - 1) / (count - 1) : 0]);
        full.u_mm.push_back(static_cast<double>(traced.u_mm[compared.back()]));
        full.v_mm.push_back(static_cast<double>(traced.v_mm[compared.back()]));
    }
    if (count == 0) return 0.0;
    trace_bundle(trace_path<double>(system, path), frame, Weights::none, full);
    double worst = 0.0;
    for (std::size_t n = 0; n < count; ++n)
        worst = std::max(worst,
                         std::hypot(full.x_mm[n] - static_cast<double>(traced.x_mm[compared[n]]),
                                    full.y_mm[n] - static_cast<double>(traced.y_mm[compared[n]])));
    return worst;
}

}  // namespace ghostlight
