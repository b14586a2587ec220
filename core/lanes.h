#pragma once

#include <cmath>
#include <cstdint>
#include <experimental/simd>
#include <type_traits>

// One source serves double, ceres::Jet and SIMD lanes. Code that is compiled once per instruction
// set lives in an inline namespace of that set's name, so that the linker can never hand a
// function built for a newer processor to an older one.
#ifndef GHOSTLIGHT_ISA
#define GHOSTLIGHT_ISA portable
#endif

// Kernels are made of these small functions; the compiler's own limits stop inlining half-way.
#define GHOSTLIGHT_INLINE [[gnu::always_inline]] inline

namespace ghostlight {
inline namespace GHOSTLIGHT_ISA {

namespace stdx = std::experimental;

template <class V>
inline constexpr bool is_lanes = stdx::is_simd_v<V>;

/// The type of one lane.
template <class V, bool = is_lanes<V>>
struct LaneOf {
    using type = V;
};
template <class V>
struct LaneOf<V, true> {
    using type = typename V::value_type;
};
template <class V>
using Lane = typename LaneOf<V>::type;

template <class V>
inline constexpr bool is_single_precision = std::is_same_v<Lane<V>, float>;

template <class V>
GHOSTLIGHT_INLINE V select(bool condition, const V& yes, const V& no) {
    return condition ? yes : no;
}
template <class T, class A>
GHOSTLIGHT_INLINE stdx::simd<T, A> select(const stdx::simd_mask<T, A>& condition,
                                          const stdx::simd<T, A>& yes, const stdx::simd<T, A>& no) {
    stdx::simd<T, A> result = no;
    stdx::where(condition, result) = yes;
    return result;
}

GHOSTLIGHT_INLINE bool any(bool condition) { return condition; }
template <class T, class A>
GHOSTLIGHT_INLINE bool any(const stdx::simd_mask<T, A>& condition) {
    return stdx::any_of(condition);
}

/// Lanes as the compiler's own vectors, whose conditional expressions become single instructions
/// where lanes' masks take three.
template <class V>
struct RawLanes {
    using type [[gnu::vector_size(sizeof(V))]] = Lane<V>;
    using bits [[gnu::vector_size(sizeof(V))]] =
        std::conditional_t<sizeof(Lane<V>) == 4, std::int32_t, std::int64_t>;
};

/// `a` where either is no number.
template <class V>
GHOSTLIGHT_INLINE V smaller(const V& a, const V& b) {
    if constexpr (is_lanes<V>) {
        using Raw = typename RawLanes<V>::type;
        const Raw x = __builtin_bit_cast(Raw, a), y = __builtin_bit_cast(Raw, b);
        return __builtin_bit_cast(V, y < x ? y : x);
    } else {
        return select(b < a, b, a);
    }
}
template <class V>
GHOSTLIGHT_INLINE V larger(const V& a, const V& b) {
    if constexpr (is_lanes<V>) {
        using Raw = typename RawLanes<V>::type;
        const Raw x = __builtin_bit_cast(Raw, a), y = __builtin_bit_cast(Raw, b);
        return __builtin_bit_cast(V, x < y ? y : x);
    } else {
        return select(a < b, b, a);
    }
}

/// |x|, for Jets too.
template <class V>
GHOSTLIGHT_INLINE V magnitude(const V& x) {
    if constexpr (is_lanes<V>)
        return stdx::abs(x);
    else
        return select(x < V(Lane<V>(0)), V(-x), x);
}

/// Square root that is 0 for negative arguments.
template <class V>
GHOSTLIGHT_INLINE V sqrt_or_zero(const V& x) {
    using std::sqrt;
    return sqrt(larger(x, V(Lane<V>(0))));
}

}  // namespace GHOSTLIGHT_ISA
}  // namespace ghostlight
