#include "core/ghosts/path_stability.h"

#include <ceres/jet.h>

#include <Eigen/Core>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/ghosts/bundle.h"
#include "core/ghosts/pupil.h"
#include "core/optics/trace_steps.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr int grid_cells = 32;
constexpr std::size_t conditioned_rays = 24;  ///< of a ghost: derivatives cost many times a trace

constexpr int state_size = 6;  ///< position and direction
using Jet = ceres::Jet<double, state_size>;
using Step = Eigen::Matrix<double, state_size, state_size>;
using Landing = Eigen::Matrix<double, 2, state_size>;

/// A ray as jets by its own six coordinates.
RayAt<Jet> seeded(const RayAt<double>& ray) {
    const Vec3<double>&p = ray.position, &d = ray.direction;
    return {{Jet(p.x, 0), Jet(p.y, 1), Jet(p.z, 2)}, {Jet(d.x, 3), Jet(d.y, 4), Jet(d.z, 5)}};
}

RayAt<double> values(const RayAt<Jet>& ray) {
    const Vec3<Jet>&p = ray.position, &d = ray.direction;
    return {{p.x.a, p.y.a, p.z.a}, {d.x.a, d.y.a, d.z.a}};
}

Step derivatives(const RayAt<Jet>& ray) {
    const Jet* state[state_size] = {&ray.position.x,  &ray.position.y,  &ray.position.z,
                                    &ray.direction.x, &ray.direction.y, &ray.direction.z};
    Step step;
    for (int i = 0; i < state_size; ++i) step.row(i) = state[i]->v.transpose();
    return step;
}

template <class T>
bool passes(const OpticalSystem& system, const Bundle<T>& rays, std::size_t i) {
    if (!(rays.margin[i] >= T(0)) || !(rays.r_rel[i] <= T(1))) return false;
    for (std::size_t k = 0; k < static_cast<std::size_t>(rays.stop_crossings); ++k)
        if (!stop_passes(system.stop_mask, static_cast<double>(rays.stop_u_mm[k][i]),
                         static_cast<double>(rays.stop_v_mm[k][i])))
            return false;
    return true;
}

RayCondition condition_of(const TracePath<Jet>& path, const BeamFrame& frame, double u_mm,
                          double v_mm) {
    const glm::dvec3 origin = u_mm * frame.e1 + v_mm * frame.e2;
    RayAt<double> ray{{origin.x, origin.y, origin.z},
                      {frame.direction.x, frame.direction.y, frame.direction.z}};
    RayCondition condition;
    std::vector<Step> steps;
    std::vector<double> sizes_mm;  ///< after each step
    for (const TraceStep<Jet>& step : path.steps) {
        RayAt<Jet> jets = seeded(ray);
        const Meeting<Jet> meeting = meet(step, path.aspheric.data(), Jet(1.0), jets);
        if (!(meeting.miss_margin.a >= 0.0)) return condition;
        const Jet cos2_squared = turn(step, meeting, jets);
        if (!step.reflects && cos2_squared.a < 0.0) return condition;
        steps.push_back(derivatives(jets));
        const RayAt<double> next = values(jets);
        auto length = [](const Vec3<double>& p) { return std::hypot(p.x, p.y, p.z); };
        sizes_mm.push_back(
            std::max({length(ray.position), length(next.position), std::abs(step.gap_mm.a)}));
        ray = next;
    }
    if (!(ray.direction.z > 0.0)) return condition;
    const RayAt<Jet> last = seeded(ray);
    const Jet t = -(last.position.z + path.sensor_gap_mm) / last.direction.z;
    const Jet landed[2] = {last.position.x + t * last.direction.x,
                           last.position.y + t * last.direction.y};
    Landing by_state;
    by_state.row(0) = landed[0].v.transpose();
    by_state.row(1) = landed[1].v.transpose();
    double squares = std::pow(landed[0].a, 2) + std::pow(landed[1].a, 2);
    for (std::size_t k = steps.size(); k-- > 0;) {
        squares += by_state.leftCols<3>().squaredNorm() * sizes_mm[k] * sizes_mm[k] +
                   by_state.rightCols<3>().squaredNorm();
        by_state = by_state * steps[k];
    }
    for (int axis = 0; axis < 2; ++axis) {
        auto along_beam = [&](const glm::dvec3& e) {
            return by_state(axis, 0) * e.x + by_state(axis, 1) * e.y + by_state(axis, 2) * e.z;
        };
        condition.by_entrance[static_cast<std::size_t>(2 * axis)] = along_beam(frame.e1);
        condition.by_entrance[static_cast<std::size_t>(2 * axis + 1)] = along_beam(frame.e2);
    }
    condition.amplification_mm = std::sqrt(squares);
    condition.valid = std::isfinite(condition.amplification_mm);
    return condition;
}

PathStability stability(const OpticalSystem& system, const BeamFrame& frame,
                        const GhostPath& path) {
    PathStability result;
    result.path = path;
    const auto exact = trace_path<double>(system, path);
    const Pupil pupil = find_pupil(system, exact, frame);
    if (pupil.empty()) return result;
    Bundle<float> single;
    lay_grid(pupil.box, grid_cells, single);
    // The same points in both: those that single precision can hold.
    Bundle<double> full;
    full.u_mm.assign(single.u_mm.begin(), single.u_mm.end());
    full.v_mm.assign(single.v_mm.begin(), single.v_mm.end());
    trace_bundle(exact, frame, Weights::polarised, full);
    trace_bundle(trace_path<float>(system, path), frame, Weights::polarised, single);
    const double reach_mm = 0.5 * std::hypot(system.sensor_width_mm, system.sensor_height_mm);
    std::vector<std::size_t> landed;
    double squares = 0.0, weight_squares = 0.0, carried = 0.0, averaged = 0.0;
    std::size_t differ = 0, compared = 0, compared_weights = 0;
    for (std::size_t i = 0; i < full.size(); ++i) {
        const bool in_full = passes(system, full, i), in_single = passes(system, single, i);
        differ += in_full != in_single ? 1 : 0;
        if (!in_full) continue;
        ++result.rays;
        carried += full.weight[i];
        averaged += full.weight_average[i];
        const bool lands = std::hypot(full.x_mm[i], full.y_mm[i]) <= reach_mm;
        if (lands) landed.push_back(i);
        if (!in_single) continue;
        if (lands) {
            ++compared;
            const double off_mm = std::hypot(static_cast<double>(single.x_mm[i]) - full.x_mm[i],
                                             static_cast<double>(single.y_mm[i]) - full.y_mm[i]);
            squares += off_mm * off_mm;
            result.position_worst_mm = std::max(result.position_worst_mm, off_mm);
        }
        if (!(full.weight[i] > 0.0)) continue;
        ++compared_weights;
        const double off = std::abs(static_cast<double>(single.weight[i]) / full.weight[i] - 1.0);
        weight_squares += off * off;
        result.weight_worst = std::max(result.weight_worst, off);
    }
    if (result.rays == 0) return result;
    result.landed = landed.size();
    if (compared > 0) result.position_rms_mm = std::sqrt(squares / static_cast<double>(compared));
    if (compared_weights > 0)
        result.weight_rms = std::sqrt(weight_squares / static_cast<double>(compared_weights));
    result.fates_differ = static_cast<double>(differ) / static_cast<double>(result.rays);
    result.averaging_error = carried > 0.0 ? averaged / carried - 1.0 : 0.0;
    result.flux_mm2 = carried * pupil.box.area_mm2() / (grid_cells * grid_cells);
    const auto jets = trace_path<Jet>(system, path);
    const std::size_t stride = std::max<std::size_t>(1, landed.size() / conditioned_rays);
    for (std::size_t k = 0; k < landed.size(); k += stride) {
        const RayCondition condition =
            condition_of(jets, frame, full.u_mm[landed[k]], full.v_mm[landed[k]]);
        if (condition.valid)
            result.amplification_mm = std::max(result.amplification_mm, condition.amplification_mm);
    }
    return result;
}

}  // namespace

RayCondition ray_condition(const OpticalSystem& system, const GhostPath& path,
                           const BeamFrame& frame, double u_mm, double v_mm) {
    return condition_of(trace_path<Jet>(system, path), frame, u_mm, v_mm);
}

bool is_ill_conditioned(const PathStability& ghost, double sensor_width_mm) {
    const double limit_mm = ill_conditioned_px * sensor_width_mm / 1280.0;
    return ghost.position_worst_mm > limit_mm || float_rounding * ghost.amplification_mm > limit_mm;
}

std::optional<std::vector<PathStability>> stability_of(
    const OpticalSystem& system, const LightDirection& light, const std::vector<GhostPath>& paths,
    unsigned threads, std::stop_token stop, const std::function<void(double)>& progress) {
    const BeamFrame frame = beam_frame(light);
    std::vector<PathStability> result(paths.size());
    std::atomic<std::size_t> done{0};
    const bool finished = parallel_for(paths.size(), threads, stop, [&](std::size_t g) {
        result[g] = stability(system, frame, paths[g]);
        if (progress) progress(static_cast<double>(++done) / static_cast<double>(paths.size()));
    });
    if (!finished) return std::nullopt;
    return result;
}

}  // namespace ghostlight
