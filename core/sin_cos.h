#pragma once

#include <cmath>

#include "core/lanes.h"

// Sine and cosine together: the vector library computes them apart, each with a reduction of its
// own. Reduction by π/2 in three parts (W. J. Cody, W. Waite, Software Manual for the Elementary
// Functions, ch. 8), each short enough that its product with the quadrant is exact without fused
// operations; on ±π/4 minimax polynomials: for float those of S. L. Moshier's Cephes library, for
// double those of Sun's fdlibm. Good to 2 units in the last place of 1.

namespace ghostlight {
inline namespace GHOSTLIGHT_ISA {

template <class V>
struct SinCos {
    V sin, cos;
};

namespace detail {

template <class T>
struct SinCosTerms;

template <>
struct SinCosTerms<float> {
    static constexpr float half_pi[3] = {1.5703125F, 4.837512969970703125e-4F,
                                         7.54978995489188216e-8F};
    /// Quadrants that are exact times the parts above, as an angle.
    static constexpr float most = 6000.0F;
    static constexpr float to_integer = 12582912.0F;  ///< 1.5 × 2²³: adding it rounds
    static constexpr float sines[3] = {-1.6666654611e-1F, 8.3321608736e-3F, -1.9515295891e-4F};
    static constexpr float cosines[3] = {4.166664568298827e-2F, -1.388731625493765e-3F,
                                         2.443315711809948e-5F};
};

template <>
struct SinCosTerms<double> {
    static constexpr double half_pi[3] = {1.57079632673412561417e+00, 6.07710050630396597660e-11,
                                          2.02226624879595063154e-21};
    static constexpr double most = 1e6;
    static constexpr double to_integer = 6755399441055744.0;  ///< 1.5 × 2⁵²
    static constexpr double sines[6] = {-1.66666666666666324348e-01, 8.33333333332248946124e-03,
                                        -1.98412698298579493134e-04, 2.75573137070700676789e-06,
                                        -2.50507602534068634195e-08, 1.58969099521155010221e-10};
    static constexpr double cosines[6] = {4.16666666666666019037e-02, -1.38888888888741095749e-03,
                                          2.48015872894767294178e-05, -2.75573143513906633035e-07,
                                          2.08757232129817482790e-09, -1.13596475577881948265e-11};
};

template <class Raw, class T, int count>
GHOSTLIGHT_INLINE Raw polynomial(const Raw& x, const T (&terms)[count]) {
    Raw sum = x * terms[count - 1] + terms[count - 2];
    for (int k = count - 3; k >= 0; --k) sum = sum * x + terms[k];
    return sum;
}

}  // namespace detail

template <class V>
GHOSTLIGHT_INLINE SinCos<V> sin_cos(const V& x) {
    using std::cos;
    using std::sin;
    if constexpr (is_lanes<V>) {
        using T = Lane<V>;
        using Terms = detail::SinCosTerms<T>;
        using Raw = typename RawLanes<V>::type;
        using Bits = typename RawLanes<V>::bits;
        // Far angles, and what is no number.
        if (any(!(magnitude(x) <= T(Terms::most)))) return {V(sin(x)), V(cos(x))};
        const Raw a = __builtin_bit_cast(Raw, x);
        const Raw shifted = a * T(0.63661977236758134308) + Terms::to_integer;
        const Raw quadrant = shifted - Terms::to_integer;
        const Bits turns = __builtin_bit_cast(Bits, shifted);
        const Raw r = ((a - quadrant * Terms::half_pi[0]) - quadrant * Terms::half_pi[1]) -
                      quadrant * Terms::half_pi[2];
        const Raw r2 = r * r;
        const Raw s = r + r * r2 * detail::polynomial(r2, Terms::sines);
        const Raw c = (T(1) - T(0.5) * r2) + r2 * r2 * detail::polynomial(r2, Terms::cosines);
        constexpr int to_sign = 8 * sizeof(T) - 2;
        const auto odd = (turns & 1) != 0;
        const Bits own_sine = __builtin_bit_cast(Bits, odd ? c : s);
        const Bits own_cosine = __builtin_bit_cast(Bits, odd ? s : c);
        return {__builtin_bit_cast(V, own_sine ^ ((turns & 2) << to_sign)),
                __builtin_bit_cast(V, own_cosine ^ (((turns + 1) & 2) << to_sign))};
    } else {
        return {V(sin(x)), V(cos(x))};
    }
}

}  // namespace GHOSTLIGHT_ISA
}  // namespace ghostlight
