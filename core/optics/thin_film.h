#pragma once

#include "core/lanes.h"
#include "core/sin_cos.h"

// Thin films by the characteristic matrix (H. A. Macleod, Thin-Film Optical Filters, ch. 2), in
// the sine-free form of the project's conventions: everything follows from cos θ in the incident
// medium, and cos δ and sin δ/δ are taken as functions of δ², which is real for a lossless layer
// on either side of its critical angle. Nothing is singular at normal incidence, at grazing, or at
// the onset of total reflection. Fields go as exp(−iωt), media are n + ik with k ≥ 0.

namespace ghostlight {
inline namespace GHOSTLIGHT_ISA {

template <class V>
struct Complex {
    V re{}, im{};

    GHOSTLIGHT_INLINE friend Complex operator+(const Complex& a, const Complex& b) {
        return {a.re + b.re, a.im + b.im};
    }
    GHOSTLIGHT_INLINE friend Complex operator-(const Complex& a, const Complex& b) {
        return {a.re - b.re, a.im - b.im};
    }
    GHOSTLIGHT_INLINE friend Complex operator*(const Complex& a, const Complex& b) {
        return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
    GHOSTLIGHT_INLINE friend Complex operator*(const V& a, const Complex& b) {
        return {a * b.re, a * b.im};
    }
};

template <class V>
GHOSTLIGHT_INLINE V norm(const Complex<V>& a) {
    return a.re * a.re + a.im * a.im;
}
template <class V>
GHOSTLIGHT_INLINE Complex<V> times_minus_i(const Complex<V>& a) {
    return {a.im, -a.re};
}
template <class V>
GHOSTLIGHT_INLINE Complex<V> quotient(const Complex<V>& a, const Complex<V>& b) {
    const V inverse = Lane<V>(1) / norm(b);
    return {(a.re * b.re + a.im * b.im) * inverse, (a.im * b.re - a.re * b.im) * inverse};
}
/// The root with Im ≥ 0.
template <class V>
GHOSTLIGHT_INLINE Complex<V> upper_sqrt(const Complex<V>& a) {
    using std::sqrt;
    const V modulus = sqrt(norm(a));
    const V zero{Lane<V>(0)};
    const V half{Lane<V>(0.5)};
    // The larger of the two parts comes without cancellation, the other from their product.
    const V big = sqrt_or_zero(V(half * (modulus + magnitude(a.re))));
    const V small = select(big > zero, V(half * magnitude(a.im) / big), zero);
    const V re = select(a.re >= zero, big, small);
    const V im = select(a.re >= zero, small, big);
    return {select(a.im >= zero, re, V(-re)), im};
}

/// cos δ and sin δ/δ for x = δ², both times exp(−|Im δ|), and |Im δ|: thick evanescent or metal
/// layers cannot overflow.
template <class Index, class V>
struct Phase {
    Index cos, sinc;
    V decay;
};

template <class V>
GHOSTLIGHT_INLINE Phase<V, V> phase_of(const V& x) {
    using std::exp;
    using std::sqrt;
    using T = Lane<V>;
    const V zero{T(0)};
    const auto small = magnitude(x) < T(0.01);
    const V a = sqrt(select(small, V(T(1)), V(magnitude(x))));
    const SinCos<V> of_a = sin_cos(a);
    Phase<V, V> phase{of_a.cos, V(of_a.sin / a), zero};
    if (any(x < zero)) {
        const V e = exp(T(-2) * a);
        phase.cos = select(x < zero, V(T(0.5) * (T(1) + e)), phase.cos);
        phase.sinc = select(x < zero, V(T(0.5) * (T(1) - e) / a), phase.sinc);
        phase.decay = select(x < zero, a, zero);
    }
    if (any(small)) {
        const V c =
            T(1) - x * (T(1.0 / 2) -
                        x * (T(1.0 / 24) -
                             x * (T(1.0 / 720) - x * (T(1.0 / 40320) - x * T(1.0 / 3628800)))));
        const V s =
            T(1) - x * (T(1.0 / 6) -
                        x * (T(1.0 / 120) -
                             x * (T(1.0 / 5040) - x * (T(1.0 / 362880) - x * T(1.0 / 39916800)))));
        phase.cos = select(small, c, phase.cos);
        phase.sinc = select(small, s, phase.sinc);
        phase.decay = select(small, zero, phase.decay);
    }
    return phase;
}

template <class V>
GHOSTLIGHT_INLINE Phase<Complex<V>, V> phase_of(const Complex<V>& x) {
    using std::exp;
    using T = Lane<V>;
    const V zero{T(0)};
    const V one{T(1)};
    // δ = a + ib, b ≥ 0: cos δ = cos a cosh b − i sin a sinh b, sin δ = sin a cosh b + i cos a sinh
    // b.
    const auto small = norm(x) < T(1e-4);
    const Complex<V> safe{select(small, one, x.re), select(small, zero, x.im)};
    const Complex<V> delta = upper_sqrt(safe);
    const V e = exp(T(-2) * delta.im);
    const V ch = T(0.5) * (T(1) + e);
    const V sh = T(0.5) * (T(1) - e);
    const auto [sa, ca] = sin_cos(delta.re);
    Phase<Complex<V>, V> phase{
        {V(ca * ch), V(-sa * sh)}, quotient(Complex<V>{V(sa * ch), V(ca * sh)}, delta), delta.im};
    if (any(small)) {
        auto series = [&](T c1, T c2, T c3, T c4) {
            const Complex<V> unit{one, zero};
            Complex<V> sum = unit;
            sum = unit - (V(c4) * x) * sum;
            sum = unit - (V(c3) * x) * sum;
            sum = unit - (V(c2) * x) * sum;
            return unit - (V(c1) * x) * sum;
        };
        const Complex<V> c = series(T(1.0 / 2), T(1.0 / 12), T(1.0 / 30), T(1.0 / 56));
        const Complex<V> s = series(T(1.0 / 6), T(1.0 / 20), T(1.0 / 42), T(1.0 / 72));
        phase.cos = {select(small, c.re, phase.cos.re), select(small, c.im, phase.cos.im)};
        phase.sinc = {select(small, s.re, phase.sinc.re), select(small, s.im, phase.sinc.im)};
        phase.decay = select(small, zero, phase.decay);
    }
    return phase;
}

/// A layer as the trace needs it: n² and k0 d, the phase thickness per unit index.
template <class T>
struct LayerAt {
    T n2_re, n2_im;
    T k0_d;
};

/// Jones factors of an interface in the frame p̂ = k̂ × ŝ before and after the event: E-field
/// reflection r, and transmission t scaled so that |t|² is the transmittance.
template <class V>
struct Amplitudes {
    Complex<V> r_s, r_p, t_s, t_p;
};

namespace detail {

template <class V>
struct Polarised {
    Complex<V> b, c;
};

/// One layer, from its exit side to its entrance side: (B, C) of s and of p.
template <class Index, class V, class T>
GHOSTLIGHT_INLINE void pass_layer(const Index& n2, const Index& inverse_n2, const Index& w2,
                                  const T& k0_d, Polarised<V>& s, Polarised<V>& p, V& decay) {
    Index x;
    if constexpr (std::is_same_v<Index, V>)
        x = k0_d * k0_d * w2;
    else
        x = V(k0_d * k0_d) * w2;
    const auto phase = phase_of(x);
    decay = decay + phase.decay;
    const auto step = V(k0_d) * phase.sinc;
    auto advance = [&](Polarised<V>& f, const auto& up, const auto& down) {
        const Complex<V> b = phase.cos * f.b + times_minus_i(up * f.c);
        f.c = times_minus_i(down * f.b) + phase.cos * f.c;
        f.b = b;
    };
    if constexpr (std::is_same_v<Index, V>) {
        advance(s, step, w2 * step);
        advance(p, V(n2 * step), V(w2 * inverse_n2 * step));
    } else {
        advance(s, step, w2 * step);
        advance(p, n2 * step, w2 * inverse_n2 * step);
    }
}

/// What a film makes of the exit side's unit field: (B, C) at the entrance side, times
/// 1/decay_factor.
template <class V>
struct FilmFields {
    Polarised<V> s, p;
    V w_re;  ///< n cos of the exit side, 0 where nothing leaves
    V decay_factor;
};

/// `root`: of the product of the admittances of entrance and exit.
template <class V>
GHOSTLIGHT_INLINE void amplitudes_of(const Polarised<V>& f, const V& y0, const V& root,
                                     Complex<V>& r, Complex<V>& t) {
    const Complex<V> yb = y0 * f.b;
    const Complex<V> sum = yb + f.c, difference = yb - f.c;
    const V inverse = Lane<V>(1) / norm(sum);
    r = {(difference.re * sum.re + difference.im * sum.im) * inverse,
         (difference.im * sum.re - difference.re * sum.im) * inverse};
    // 2 sqrt(y0 Re y_exit)/(y0 B + C): finite at grazing, where y0 is 0.
    const V scale = Lane<V>(2) * root * inverse;
    t = {scale * sum.re, -scale * sum.im};
}

template <bool Absorbing, class V, class T>
GHOSTLIGHT_INLINE FilmFields<V> film_fields(const T& n_in, const LayerAt<T>* layers,
                                            int layer_count, const T& n_out,
                                            const V& cos_incidence) {
    using std::exp;
    using L = Lane<V>;
    const V zero{L(0)};
    const V one{L(1)};
    const V q2 = n_in * n_in * (L(1) - cos_incidence * cos_incidence);
    const V w2 = n_out * n_out - q2;
    const auto propagates = w2 >= zero;
    const V w = sqrt_or_zero(select(propagates, w2, V(-w2)));
    const T inverse_n2 = T(1) / (n_out * n_out);
    const V w_re = select(propagates, w, zero);
    const V w_im = select(propagates, zero, w);
    Polarised<V> s{{one, zero}, {w_re, w_im}};
    Polarised<V> p{{one, zero}, {V(w_re * inverse_n2), V(w_im * inverse_n2)}};
    V decay = zero;
    for (int i = layer_count - 1; i >= 0; --i) {
        const LayerAt<T>& layer = layers[i];
        if constexpr (Absorbing) {
            const Complex<V> n2{V(layer.n2_re), V(layer.n2_im)};
            const Complex<V> layer_w2{V(layer.n2_re - q2), V(layer.n2_im)};
            const Complex<V> inverse = quotient(Complex<V>{one, zero}, n2);
            pass_layer(n2, inverse, layer_w2, layer.k0_d, s, p, decay);
        } else {
            pass_layer(V(layer.n2_re), V(T(1) / layer.n2_re), V(layer.n2_re - q2), layer.k0_d, s, p,
                       decay);
        }
    }
    V decay_factor = one;
    if (any(decay > zero)) decay_factor = exp(-decay);
    return {s, p, w_re, decay_factor};
}

}  // namespace detail

/// `layers` from the incident side. `Absorbing` picks complex indices; without it the imaginary
/// parts are ignored. The exit and incident media are lossless.
template <bool Absorbing, class V, class T>
GHOSTLIGHT_INLINE Amplitudes<V> film_amplitudes(const T& n_in, const LayerAt<T>* layers,
                                                int layer_count, const T& n_out,
                                                const V& cos_incidence) {
    using L = Lane<V>;
    const auto fields =
        detail::film_fields<Absorbing>(n_in, layers, layer_count, n_out, cos_incidence);
    const V y_s = n_in * cos_incidence;
    const T inverse = L(1) / (n_in * n_out);
    const V root = sqrt_or_zero(V(y_s * fields.w_re)) * fields.decay_factor;
    Amplitudes<V> result;
    detail::amplitudes_of(fields.s, y_s, root, result.r_s, result.t_s);
    detail::amplitudes_of(fields.p, V((L(1) / n_in) * cos_incidence), V(root * inverse), result.r_p,
                          result.t_p);
    return result;
}

/// Means of s and p of what is reflected and of what passes.
template <class V>
struct MeanShares {
    V reflected, passed;
};

/// Of film_amplitudes' squares, at half the cost.
template <bool Absorbing, class V, class T>
GHOSTLIGHT_INLINE MeanShares<V> film_shares(const T& n_in, const LayerAt<T>* layers,
                                            int layer_count, const T& n_out,
                                            const V& cos_incidence) {
    using L = Lane<V>;
    const auto fields =
        detail::film_fields<Absorbing>(n_in, layers, layer_count, n_out, cos_incidence);
    const V y_s = n_in * cos_incidence;
    const Complex<V> s = y_s * fields.s.b;
    const Complex<V> p = V((L(1) / n_in) * cos_incidence) * fields.p.b;
    const V sum_s = norm(s + fields.s.c), sum_p = norm(p + fields.p.c);
    // Both over one denominator.
    const V half_inverse = L(0.5) / (sum_s * sum_p);
    const T inverse = L(1) / (n_in * n_out);
    const V admittances = L(4) * y_s * fields.w_re * fields.decay_factor * fields.decay_factor;
    return {(norm(s - fields.s.c) * sum_p + norm(p - fields.p.c) * sum_s) * half_inverse,
            admittances * (sum_p + inverse * inverse * sum_s) * half_inverse};
}

}  // namespace GHOSTLIGHT_ISA
}  // namespace ghostlight
