// Compiled once per instruction set, like the kernels it is compared with.
#include "tests/bench/scalar_trace.h"

#include <cmath>
#include <cstddef>

#include "core/optics/trace_steps.h"

#define GHOSTLIGHT_JOIN_(a, b) a##b
#define GHOSTLIGHT_JOIN(a, b) GHOSTLIGHT_JOIN_(a, b)
#define scalar_isa GHOSTLIGHT_JOIN(scalar_, GHOSTLIGHT_ISA)

namespace ghostlight::bench::scalar_isa {
namespace {

template <Weights mode>
void trace_ray_of(const TracePath<double>& path, const BeamFrame& frame, Bundle<double>& b,
                  std::size_t i) {
    RayAt<double> ray{b.u_mm[i] * frame.e1 + b.v_mm[i] * frame.e2, frame.direction};
    JonesState<double> jones{};
    if constexpr (mode == Weights::polarised) jones = jones_start<double>(frame.e1);
    double margin = 1.0, r2_rel = 0.0, average = 1.0;
    std::size_t crossing = 0, reflection = 0;
    for (const TraceStep<double>& step : path.steps) {
        const Meeting<double> meeting = meet(step, path.aspheric.data(), margin, ray);
        margin = smaller(margin, smaller(meeting.turned_margin,
                                         smaller(meeting.miss_margin, meeting.hemisphere_margin)));
        const glm::dvec3 at = ray.position;
        if (step.at_stop) {
            b.stop_u_mm[crossing][i] = at.x;
            b.stop_v_mm[crossing][i] = at.y;
            ++crossing;
        } else {
            r2_rel = larger(r2_rel, ghostlight::r2_rel(step, at));
        }
        const glm::dvec3 before = ray.direction;
        const double cos2_squared = turn(step, meeting, ray);
        if (!step.reflects)
            margin = smaller(margin, cos2_squared);
        else
            b.onset[reflection][i] = cos2_squared;
        if constexpr (mode != Weights::none) {
            if (!step.invisible) {
                const Amplitudes<double> film =
                    amplitudes(step, path.layers.data(), meeting.cos_incidence);
                const double mean = 0.5 * (step.reflects ? norm(film.r_s) + norm(film.r_p)
                                                         : norm(film.t_s) + norm(film.t_p));
                if (step.reflects) b.reflectance[reflection][i] = mean;
                average *= mean;
                if constexpr (mode == Weights::polarised)
                    apply(film, step.reflects, meeting, before, jones);
            }
        }
        if (step.reflects) ++reflection;
    }
    const double t = -(ray.position.z + path.sensor_gap_mm) / ray.direction.z;
    double weight = average;
    if constexpr (mode == Weights::polarised)
        weight = 0.5 * (jones.intensity(0) + jones.intensity(1));
    if constexpr (mode == Weights::none) weight = 0.0;
    b.x_mm[i] = ray.position.x + t * ray.direction.x;
    b.y_mm[i] = ray.position.y + t * ray.direction.y;
    b.weight[i] = weight;
    b.weight_average[i] = average;
    b.margin[i] = smaller(margin, ray.direction.z);
    b.r_rel[i] = std::sqrt(r2_rel);
}

template <Weights mode>
void trace_all(const TracePath<double>& path, const BeamFrame& frame, Bundle<double>& bundle) {
    for (std::size_t i = 0; i < bundle.size(); ++i) trace_ray_of<mode>(path, frame, bundle, i);
}

}  // namespace

void trace_rays(const TracePath<double>& path, const BeamFrame& frame, Weights weights,
                Bundle<double>& bundle) {
    switch (weights) {
        case Weights::none:
            return trace_all<Weights::none>(path, frame, bundle);
        case Weights::average:
            return trace_all<Weights::average>(path, frame, bundle);
        case Weights::polarised:
            return trace_all<Weights::polarised>(path, frame, bundle);
    }
}

}  // namespace ghostlight::bench::scalar_isa
