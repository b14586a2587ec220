#pragma once

#include <glm/vec3.hpp>

#include "core/lanes.h"
#include "core/optics/thin_film.h"
#include "core/optics/trace_path.h"

// The trace: one template on the scalar, for double, ceres::Jet and SIMD lanes. Conics in the
// vertex form (W. T. Welford, Aberrations of Optical Systems, ch. 4), which neither cancels for
// flat surfaces nor needs a special case for planes. A ray that misses or is totally reflected is
// carried on with its root clamped to zero and marked by a margin that turns negative, so that
// quantities stay continuous across the edge of a bundle and can be interpolated there.

namespace ghostlight {
inline namespace GHOSTLIGHT_ISA {

template <class V>
using Vec3 = glm::vec<3, V>;

template <class V>
GHOSTLIGHT_INLINE V dot(const Vec3<V>& a, const Vec3<V>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
GHOSTLIGHT_INLINE Vec3<V> cross(const Vec3<V>& a, const Vec3<V>& b) {
    return Vec3<V>(V(a.y * b.z - a.z * b.y), V(a.z * b.x - a.x * b.z), V(a.x * b.y - a.y * b.x));
}
template <class V>
GHOSTLIGHT_INLINE Vec3<V> along(const Vec3<V>& p, const Vec3<V>& d, const V& t) {
    return Vec3<V>(V(p.x + t * d.x), V(p.y + t * d.y), V(p.z + t * d.z));
}
template <class V>
GHOSTLIGHT_INLINE Vec3<V> mix(const V& a, const Vec3<V>& p, const V& b, const Vec3<V>& q) {
    return Vec3<V>(V(a * p.x + b * q.x), V(a * p.y + b * q.y), V(a * p.z + b * q.z));
}

/// A ray relative to the current vertex, unit direction.
template <class V>
struct RayAt {
    Vec3<V> position, direction;
};

/// What a ray met. The margins are positive while the ray is valid.
template <class V>
struct Meeting {
    Vec3<V> normal;  ///< unit, turned so that d·N̂ ≥ 0
    V cos_incidence;
    V turned_margin;      ///< component along the nominal direction of travel
    V miss_margin;        ///< root argument of the intersection
    V hemisphere_margin;  ///< 1 − (1+k) c z: the vertex's side of the surface
};

namespace detail {

/// Sag and dsag/d(r²) of an even asphere; `domain` is 1 − (1+k)c²r².
template <class V, class T>
GHOSTLIGHT_INLINE void sag_of(const TraceStep<T>& step, const T* a, const V& r2, V& sag, V& slope,
                              V& domain) {
    using L = Lane<V>;
    const T c = step.curvature;
    domain = L(1) - (L(1) + step.conic) * c * c * r2;
    const V root = sqrt_or_zero(domain);
    sag = c * r2 / (L(1) + root);
    slope = c / (L(2) * larger(root, V(L(1e-6))));
    V power = r2;
    for (int i = 0; i < step.aspheric_count; ++i) {
        slope = slope + L(i + 2) * a[i] * power;
        power = power * r2;
        sag = sag + a[i] * power;
    }
}

/// Newton from the conic's hit, then bisection for what has not converged; what still fails gets
/// a negative miss margin. Rays that failed before (`margin` < 0) are not worth the trouble.
template <class V, class T>
void refine_asphere(const TraceStep<T>& step, const T* a, const V& margin, RayAt<V>& ray,
                    Meeting<V>& meeting) {
    using L = Lane<V>;
    const V zero{L(0)};
    const T clear = T(1) / step.inverse_clear;
    const T tolerance = clear * (is_single_precision<V> ? T(6e-7) : T(4e-15));
    V sag, slope, domain;
    auto miss = [&](const Vec3<V>& p) {
        const V r2 = p.x * p.x + p.y * p.y;
        sag_of(step, a, r2, sag, slope, domain);
        return V(p.z - sag);
    };
    auto rate = [&](const Vec3<V>& p) {
        const Vec3<V>& d = ray.direction;
        return V(d.z - L(2) * slope * (p.x * d.x + p.y * d.y));
    };
    const Vec3<V> start = ray.position;
    V f = miss(ray.position);
    constexpr int rounds = is_single_precision<V> ? 5 : 10;
    for (int i = 0; i < rounds; ++i) {
        const V derivative = rate(ray.position);
        const V steep = select(magnitude(derivative) < L(1e-6), V(L(1)), derivative);
        const V move = smaller(V(clear), larger(V(-clear), V(-f / steep)));
        ray.position = along(ray.position, ray.direction, move);
        f = miss(ray.position);
        if (!any(margin >= zero && magnitude(f) > tolerance)) break;
    }
    const auto far = !(magnitude(f) <= L(16) * tolerance);
    if (any(far && margin >= zero)) {
        // A sign change about the conic's hit, within a clear radius either way.
        V low = V(-clear), high = V(clear);
        const V f_low = miss(along(start, ray.direction, low));
        const V f_high = miss(along(start, ray.direction, high));
        const auto bracketed = (f_low < zero) != (f_high < zero);
        constexpr int halvings = is_single_precision<V> ? 26 : 56;
        for (int i = 0; i < halvings; ++i) {
            const V middle = L(0.5) * (low + high);
            const auto below = (miss(along(start, ray.direction, middle)) < zero) == (f_low < zero);
            low = select(below, middle, low);
            high = select(below, high, middle);
        }
        const Vec3<V> found = along(start, ray.direction, low);
        ray.position =
            Vec3<V>(select(far, found.x, ray.position.x), select(far, found.y, ray.position.y),
                    select(far, found.z, ray.position.z));
        f = miss(ray.position);
        const auto lost = far && !(bracketed && magnitude(f) <= L(64) * tolerance);
        meeting.miss_margin = select(lost, V(L(-1)), domain);
    } else {
        // Beyond the conic's own edge there is no surface, whatever the series says.
        meeting.miss_margin = select(far, V(L(-1)), domain);
    }
    meeting.hemisphere_margin = domain;
    const V gx = L(-2) * slope * ray.position.x;
    const V gy = L(-2) * slope * ray.position.y;
    meeting.normal = Vec3<V>(gx, gy, V(L(1)));
}

}  // namespace detail

/// meet() for spheres and planes in bundles, from the foot `p` of the perpendicular: with p·d = 0 a
/// third of the work falls away.
template <class V, class T>
GHOSTLIGHT_INLINE void meet_sphere(const TraceStep<T>& step, const Vec3<V>& p, RayAt<V>& ray,
                                   Meeting<V>& meeting) {
    using L = Lane<V>;
    const Vec3<V>& d = ray.direction;
    const T c = step.curvature, signed_c = step.curvature * step.sense;
    const V f = c * dot(p, p) - L(2) * p.z;
    meeting.miss_margin = d.z * d.z - c * f;
    const V root = sqrt_or_zero(meeting.miss_margin);
    ray.position = along(p, d, V(f / (d.z + step.sense * root)));
    const Vec3<V>& q = ray.position;
    meeting.hemisphere_margin = L(1) - c * q.z;
    meeting.normal =
        Vec3<V>(V(-signed_c * q.x), V(-signed_c * q.y), V(step.sense - signed_c * q.z));
    meeting.cos_incidence = smaller(V(L(1)), root);
}

/// Moves the ray to the surface of `step`, in that surface's own coordinates. `margin` is the
/// ray's least margin so far.
template <class V, class T>
GHOSTLIGHT_INLINE Meeting<V> meet(const TraceStep<T>& step, const T* aspheric, const V& margin,
                                  RayAt<V>& ray) {
    using std::sqrt;
    using L = Lane<V>;
    Meeting<V> meeting;
    const Vec3<V>& d = ray.direction;
    meeting.turned_margin = step.sense * d.z;
    // From the foot of the perpendicular, whatever the ray's slope, float keeps its digits.
    ray.position.z = ray.position.z + step.gap_mm;
    Vec3<V> p = along(ray.position, d, V(-dot(ray.position, d)));
    const T c = step.curvature;
    if constexpr (is_lanes<V>)
        if (step.spherical) {
            meet_sphere(step, p, ray, meeting);
            return meeting;
        }
    const T k1 = L(1) + step.conic;
    const V f = c * (p.x * p.x + p.y * p.y + k1 * p.z * p.z) - L(2) * p.z;
    const V g = d.z - c * (p.x * d.x + p.y * d.y + k1 * p.z * d.z);
    meeting.miss_margin = g * g - c * (L(1) + step.conic * d.z * d.z) * f;
    const V root = sqrt_or_zero(meeting.miss_margin);
    const V sense = V(step.sense);
    ray.position = along(p, d, V(f / (g + sense * root)));
    const Vec3<V>& q = ray.position;
    meeting.hemisphere_margin = L(1) - k1 * c * q.z;
    meeting.normal = Vec3<V>(V(-c * q.x), V(-c * q.y), meeting.hemisphere_margin);
    if (step.aspheric_count > 0)
        detail::refine_asphere(step, aspheric + step.first_aspheric, margin, ray, meeting);
    if (step.spherical) {
        // The root is the cosine of incidence, and the normal already has unit length.
        meeting.cos_incidence = smaller(V(L(1)), root);
        meeting.normal = Vec3<V>(V(sense * meeting.normal.x), V(sense * meeting.normal.y),
                                 V(sense * meeting.normal.z));
        return meeting;
    }
    const V projected = dot(meeting.normal, d);
    const V length = sqrt(dot(meeting.normal, meeting.normal));
    const V inverse = select(projected < V(L(0)), V(L(-1)), V(L(1))) / length;
    meeting.normal = Vec3<V>(V(meeting.normal.x * inverse), V(meeting.normal.y * inverse),
                             V(meeting.normal.z * inverse));
    meeting.cos_incidence = smaller(V(L(1)), V(projected * inverse));
    return meeting;
}

/// One Newton step towards unit length: rounding does not add up over hundreds of surfaces.
template <class V>
GHOSTLIGHT_INLINE void keep_unit(Vec3<V>& direction) {
    using L = Lane<V>;
    const V fix = L(1.5) - L(0.5) * dot(direction, direction);
    direction = Vec3<V>(V(fix * direction.x), V(fix * direction.y), V(fix * direction.z));
}

/// Turns the ray at the surface; returns cos² of the refraction, negative in total reflection.
/// Bundles are to call keep_unit() after every other turn at least.
template <class V, class T>
GHOSTLIGHT_INLINE V turn(const TraceStep<T>& step, const Meeting<V>& meeting, RayAt<V>& ray) {
    using L = Lane<V>;
    const V& cos1 = meeting.cos_incidence;
    const T eta = step.eta;
    const V cos2_squared = L(1) - eta * eta * (L(1) - cos1 * cos1);
    if (step.reflects) {
        ray.direction = along(ray.direction, meeting.normal, V(L(-2) * cos1));
    } else if (step.n_in != step.n_out) {
        const V cos2 = sqrt_or_zero(cos2_squared);
        ray.direction = mix(V(eta), ray.direction, V(cos2 - eta * cos1), meeting.normal);
    }
    if constexpr (!is_lanes<V>) keep_unit(ray.direction);
    return cos2_squared;
}

/// The Jones matrix accumulated along the path, in the frame (s, k̂ × s): column 0 for light that
/// came in along the beam's e1, column 1 along e2.
template <class V>
struct JonesState {
    Vec3<V> s;
    Complex<V> s_of[2], p_of[2];

    V intensity(int column) const { return norm(s_of[column]) + norm(p_of[column]); }
};

template <class V, class T>
GHOSTLIGHT_INLINE JonesState<V> jones_start(const Vec3<T>& e1) {
    const V zero{Lane<V>(0)};
    const V one{Lane<V>(1)};
    return {Vec3<V>(V(e1.x), V(e1.y), V(e1.z)),
            {{one, zero}, {zero, zero}},
            {{zero, zero}, {one, zero}}};
}

/// Turns the frame into the plane of incidence and applies the interface. `before` is the ray's
/// direction before the event.
template <class V>
GHOSTLIGHT_INLINE void apply(const Amplitudes<V>& film, bool reflects, const Meeting<V>& meeting,
                             const Vec3<V>& before, JonesState<V>& state) {
    using std::sqrt;
    using L = Lane<V>;
    const Vec3<V> n = cross(before, meeting.normal);
    const V n2 = dot(n, n);
    // Near normal incidence the plane of incidence is undefined and does not matter.
    const auto normal = n2 < L(is_single_precision<V> ? 1e-6 : 1e-10);
    const V inverse = L(1) / sqrt(select(normal, V(L(1)), n2));
    const Vec3<V> s(select(normal, state.s.x, V(n.x * inverse)),
                    select(normal, state.s.y, V(n.y * inverse)),
                    select(normal, state.s.z, V(n.z * inverse)));
    const V cos_a = dot(state.s, s);
    const V sin_a = dot(cross(before, state.s), s);
    const Complex<V>& a_s = reflects ? film.r_s : film.t_s;
    const Complex<V>& a_p = reflects ? film.r_p : film.t_p;
    for (int i = 0; i < 2; ++i) {
        const Complex<V> e_s = cos_a * state.s_of[i] + sin_a * state.p_of[i];
        const Complex<V> e_p = cos_a * state.p_of[i] - sin_a * state.s_of[i];
        state.s_of[i] = a_s * e_s;
        state.p_of[i] = a_p * e_p;
    }
    state.s = s;
}

/// The square of a point's distance from the axis over the clear radius; in a rectangle the larger
/// of the squares of its coordinates over the half sides.
template <class V, class T>
GHOSTLIGHT_INLINE V r2_rel(const TraceStep<T>& step, const Vec3<V>& at) {
    if (step.rectangular) {
        const V x = at.x * step.inverse_half_width, y = at.y * step.inverse_half_height;
        return larger(V(x * x), V(y * y));
    }
    const V r2 = at.x * at.x + at.y * at.y;
    return r2 * (step.inverse_clear * step.inverse_clear);
}

template <class V, class T>
GHOSTLIGHT_INLINE Amplitudes<V> amplitudes(const TraceStep<T>& step, const LayerAt<T>* layers,
                                           const V& cos_incidence) {
    if (step.uniform) {
        // Both polarisations alike: r_p = −r_s in the frame p = k × s.
        const V zero{Lane<V>(0)};
        const V r{step.uniform_r}, t{step.uniform_t};
        return {{r, zero}, {V(-r), zero}, {t, zero}, {t, zero}};
    }
    if (step.angles != nullptr)
        return given_amplitudes(step.n_in, step.angles, step.angle_count, step.n_out,
                                cos_incidence);
    const LayerAt<T>* own = layers + step.first_layer;
    return step.absorbing
               ? film_amplitudes<true>(step.n_in, own, step.layer_count, step.n_out, cos_incidence)
               : film_amplitudes<false>(step.n_in, own, step.layer_count, step.n_out,
                                        cos_incidence);
}

/// The mean of s and p of what the interface reflects, or of what it lets pass.
template <class V, class T>
GHOSTLIGHT_INLINE V mean_share(const TraceStep<T>& step, const LayerAt<T>* layers,
                               const V& cos_incidence) {
    using L = Lane<V>;
    if (step.uniform || step.angles != nullptr) {
        const Amplitudes<V> given = amplitudes(step, layers, cos_incidence);
        return L(0.5) * (step.reflects ? norm(given.r_s) + norm(given.r_p)
                                       : norm(given.t_s) + norm(given.t_p));
    }
    const LayerAt<T>* own = layers + step.first_layer;
    const MeanShares<V> shares =
        step.absorbing
            ? film_shares<true>(step.n_in, own, step.layer_count, step.n_out, cos_incidence)
            : film_shares<false>(step.n_in, own, step.layer_count, step.n_out, cos_incidence);
    return step.reflects ? shares.reflected : shares.passed;
}

}  // namespace GHOSTLIGHT_ISA
}  // namespace ghostlight
