// Compiled once per instruction set; see core/CMakeLists.txt. Nothing here may call an inline
// function that is shared with the rest of the program.
#include "core/optics/trace_steps.h"

#include "core/ghosts/bundle_kernel.h"

#define GHOSTLIGHT_JOIN_(a, b) a##b
#define GHOSTLIGHT_JOIN(a, b) GHOSTLIGHT_JOIN_(a, b)

namespace ghostlight::GHOSTLIGHT_JOIN(kernels_, GHOSTLIGHT_ISA) {
namespace {

template <class T>
using Lanes = stdx::native_simd<T>;

template <class V, class T>
V load(const T* from) {
    return V(from, stdx::element_aligned);
}
template <class V, class T>
void store(const V& value, T* to) {
    value.copy_to(to, stdx::element_aligned);
}

enum { no_weights, average_weights, polarised_weights };

template <int mode, class T>
void trace_at(const BundleView<T>& b, std::size_t i) {
    using V = Lanes<T>;
    const V zero{T(0)};
    const V one{T(1)};
    const V u = load<V>(b.u + i), v = load<V>(b.v + i);
    RayAt<V> ray{Vec3<V>(V(u * b.e1[0] + v * b.e2[0]), V(u * b.e1[1] + v * b.e2[1]),
                         V(u * b.e1[2] + v * b.e2[2])),
                 Vec3<V>(V(b.direction[0]), V(b.direction[1]), V(b.direction[2]))};
    V margin = one;
    V r2_rel = zero;
    V average = one;
    JonesState<V> jones;
    if constexpr (mode == polarised_weights)
        jones = jones_start<V>(Vec3<T>(b.e1[0], b.e1[1], b.e1[2]));
    int crossing = 0, reflection = 0;
    for (std::size_t k = 0; k < b.step_count; ++k) {
        const TraceStep<T>& step = b.steps[k];
        const Meeting<V> meeting = meet(step, b.aspheric, ray);
        margin = smaller(margin, smaller(meeting.turned_margin,
                                         smaller(meeting.miss_margin, meeting.hemisphere_margin)));
        if (step.at_stop) {
            store(ray.position.x, b.stop_u[crossing] + i);
            store(ray.position.y, b.stop_v[crossing] + i);
            ++crossing;
        } else {
            const V r2 = ray.position.x * ray.position.x + ray.position.y * ray.position.y;
            r2_rel = larger(r2_rel, V(r2 * (step.inverse_clear * step.inverse_clear)));
        }
        const Vec3<V> before = ray.direction;
        const V cos2_squared = turn(step, meeting, ray);
        if (!step.reflects)
            margin = smaller(margin, cos2_squared);
        else if (reflection < 2)
            store(cos2_squared, b.onset[reflection] + i);
        if constexpr (mode != no_weights) {
            if (!step.invisible) {
                const Amplitudes<V> film = amplitudes(step, b.layers, meeting.cos_incidence);
                const V mean = T(0.5) * (step.reflects ? norm(film.r_s) + norm(film.r_p)
                                                       : norm(film.t_s) + norm(film.t_p));
                if (step.reflects && reflection < 2) store(mean, b.reflectance[reflection] + i);
                average = average * mean;
                if constexpr (mode == polarised_weights)
                    apply(film, step.reflects, meeting, before, jones);
            }
        }
        if (step.reflects) ++reflection;
    }
    margin = smaller(margin, ray.direction.z);
    ray.position.z = ray.position.z + b.sensor_gap_mm;
    const V t = -ray.position.z / ray.direction.z;
    V x = ray.position.x + t * ray.direction.x;
    V y = ray.position.y + t * ray.direction.y;
    V weight = average;
    if constexpr (mode == polarised_weights)
        weight = T(0.5) * (jones.intensity(0) + jones.intensity(1));
    if constexpr (mode == no_weights) weight = zero;
    // What went wild far outside the bundle must not reach any sum.
    const V check = x + y + weight + average + r2_rel + margin;
    const auto lost = !(check - check == zero);
    x = select(lost, zero, x);
    y = select(lost, zero, y);
    weight = select(lost, zero, weight);
    average = select(lost, zero, average);
    margin = select(lost, V(T(-1)), margin);
    r2_rel = select(lost, V(T(4)), r2_rel);
    store(x, b.x + i);
    store(y, b.y + i);
    store(weight, b.weight + i);
    store(average, b.weight_average + i);
    store(margin, b.margin + i);
    using std::sqrt;
    store(V(sqrt(r2_rel)), b.r_rel + i);
}

template <int mode, class T>
void trace_all(const BundleView<T>& b) {
    for (std::size_t i = 0; i < b.count; i += Lanes<T>::size()) trace_at<mode>(b, i);
}

template <class T>
void trace_mode(const BundleView<T>& b) {
    switch (b.weights) {
        case no_weights: return trace_all<no_weights>(b);
        case average_weights: return trace_all<average_weights>(b);
        default: return trace_all<polarised_weights>(b);
    }
}

}  // namespace

void trace_bundle_lanes(const BundleView<float>& bundle) { trace_mode(bundle); }
void trace_bundle_lanes(const BundleView<double>& bundle) { trace_mode(bundle); }

}  // namespace ghostlight::GHOSTLIGHT_JOIN(kernels_, GHOSTLIGHT_ISA)
