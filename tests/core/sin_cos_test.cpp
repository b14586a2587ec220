// Sine and cosine in lanes, against the C library in extended precision.
#include "core/sin_cos.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace ghostlight {
namespace {

/// Thin films' phases and far more, on both sides of the multiples of π/4 and close to those of
/// π/2, where the reduction cancels most.
template <class T>
std::vector<T> angles() {
    std::vector<T> all;
    for (int k = 0; k < 4000; ++k) all.push_back(static_cast<T>(0.0117 * k - 11.3));
    const long double quarter = std::acos(-1.0L) / 4.0L;
    for (int k = -6000; k <= 6000; k += k > -40 && k < 40 ? 1 : 37) {
        const T near = static_cast<T>(quarter * k);
        all.insert(all.end(), {near, std::nextafter(near, T(1e9)), std::nextafter(near, T(-1e9))});
    }
    // Beyond what the reduction takes.
    for (const double far : {5999.0, 6001.0, 9.9e5, 1.1e6, 3e7}) all.push_back(static_cast<T>(far));
    return all;
}

template <class T>
void expect_close(T most) {
    using V = stdx::native_simd<T>;
    const std::vector<T> all = angles<T>();
    for (const T angle : all) {
        // Other lanes must not matter.
        V x;
        for (std::size_t k = 0; k < V::size(); ++k) x[k] = k == 0 ? angle : T(0.5) * angle;
        const SinCos<V> both = sin_cos(x);
        const auto exact = static_cast<long double>(angle);
        EXPECT_NEAR(static_cast<double>(both.sin[0]), static_cast<double>(std::sin(exact)), most)
            << static_cast<double>(angle);
        EXPECT_NEAR(static_cast<double>(both.cos[0]), static_cast<double>(std::cos(exact)), most)
            << static_cast<double>(angle);
    }
}

// Two units in the last place of 1: what the polynomials' sources state, and one rounding.
TEST(SinCos, FloatsAreGoodToTwoUnits) { expect_close<float>(2.4e-7F); }
TEST(SinCos, DoublesAreGoodToTwoUnits) { expect_close<double>(4.5e-16); }

TEST(SinCos, SmallAnglesKeepTheirDigits) {
    using V = stdx::native_simd<float>;
    for (const float angle : {1e-30F, 3e-12F, 1e-6F, 1e-3F, 0.1F})
        EXPECT_NEAR(sin_cos(V(angle)).sin[0] / std::sin(angle), 1.0, 2.4e-7) << angle;
}

TEST(SinCos, WhatIsNoNumberStaysNone) {
    using V = stdx::native_simd<float>;
    for (const float angle :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        EXPECT_TRUE(std::isnan(sin_cos(V(angle)).sin[0]));
        EXPECT_TRUE(std::isnan(sin_cos(V(angle)).cos[0]));
    }
}

TEST(SinCos, ScalarsComeFromTheLibrary) {
    EXPECT_EQ(sin_cos(1.25).sin, std::sin(1.25));
    EXPECT_EQ(sin_cos(1.25).cos, std::cos(1.25));
}

}  // namespace
}  // namespace ghostlight
