#pragma once

#include "core/optics/thin_film.h"

// Interfaces whose reflectance and transmittance are given at some angles, instead of following
// from layers.

namespace ghostlight {
inline namespace GHOSTLIGHT_ISA {

/// One angle of such an interface as the trace needs it.
template <class T>
struct AngleAt {
    T cos_thin;  ///< cosine of the angle in the medium of the lower index
    T r_s, r_p, t_s, t_p;
};

/// `angles` by falling cosine, at least one. Shares are linear in the cosine, and the first and the
/// last hold beyond. Reflected amplitudes have the bare interface's sign, and in total reflection
/// its phase and |r| = 1; transmitted ones are positive.
template <class V, class T>
Amplitudes<V> given_amplitudes(const T& n_in, const AngleAt<T>* angles, int count, const T& n_out,
                               const V& cos_incidence) {
    using L = Lane<V>;
    const V zero{L(0)};
    const V one{L(1)};
    const V q2 = n_in * n_in * (L(1) - cos_incidence * cos_incidence);
    const V w2 = n_out * n_out - q2;
    const auto total = w2 < zero;
    const V w = sqrt_or_zero(w2);
    const V cos_thin = n_in <= n_out ? cos_incidence : V(w / n_out);
    V r_s{angles[0].r_s}, r_p{angles[0].r_p}, t_s{angles[0].t_s}, t_p{angles[0].t_p};
    for (int i = 0; i + 1 < count; ++i) {
        const AngleAt<T>&a = angles[i], &b = angles[i + 1];
        const V share = (a.cos_thin - cos_thin) / (a.cos_thin - b.cos_thin);
        const V part = larger(zero, smaller(one, share));
        r_s = r_s + part * (b.r_s - a.r_s);
        r_p = r_p + part * (b.r_p - a.r_p);
        t_s = t_s + part * (b.t_s - a.t_s);
        t_p = t_p + part * (b.t_p - a.t_p);
    }
    const auto s_positive = n_in * cos_incidence > w;
    const auto p_positive = cos_incidence / n_in >= w / (n_out * n_out);
    auto signed_root = [&](const V& share, const auto& positive) {
        const V root = sqrt_or_zero(share);
        return select(positive, root, V(-root));
    };
    Amplitudes<V> given{{signed_root(r_s, s_positive), zero},
                        {signed_root(r_p, p_positive), zero},
                        {sqrt_or_zero(t_s), zero},
                        {sqrt_or_zero(t_p), zero}};
    if (any(total)) {
        const LayerAt<T>* none = nullptr;
        const Amplitudes<V> bare = film_amplitudes<false>(n_in, none, 0, n_out, cos_incidence);
        auto replace = [&](Complex<V>& mine, const Complex<V>& by) {
            mine = {select(total, by.re, mine.re), select(total, by.im, mine.im)};
        };
        replace(given.r_s, bare.r_s);
        replace(given.r_p, bare.r_p);
        replace(given.t_s, {zero, zero});
        replace(given.t_p, {zero, zero});
    }
    return given;
}

}  // namespace GHOSTLIGHT_ISA
}  // namespace ghostlight
