// Compiled once per instruction set; see core/CMakeLists.txt. Nothing here may call an inline
// function that is shared with the rest of the program.
#include "core/flare/veil_kernel.h"

#include <experimental/simd>

#define GHOSTLIGHT_JOIN_(a, b) a##b
#define GHOSTLIGHT_JOIN(a, b) GHOSTLIGHT_JOIN_(a, b)

namespace ghostlight::GHOSTLIGHT_JOIN(kernels_, GHOSTLIGHT_ISA) {
    namespace stdx = std::experimental;
    using V = stdx::native_simd<float>;
    /// Of every instruction set, so that sums do not depend on how wide its vectors are.
    using Eight = stdx::fixed_size_simd<float, 8>;

    void veil_orders(const VeilOrdersView& v) {
        const float* from = v.coefficients;
        for (std::size_t n = 0; n < v.orders; ++n) {
            // Two sums, so that one need not wait for the other.
            Eight even(0.0F), odd(0.0F);
            for (std::size_t m = 0; m < v.orders; ++m, from += 16) {
                even += v.cosine[m] * Eight(from, stdx::element_aligned);
                odd += v.sine[m] * Eight(from + 8, stdx::element_aligned);
            }
            (even + odd).copy_to(v.sums + 8 * n, stdx::element_aligned);
        }
    }

    void veil_row(const VeilRowView& v) {
        constexpr std::size_t lanes = V::size();
        static_assert(veil_padding % lanes == 0);
        float sums[4][lanes];
        for (std::size_t i = 0; i < v.columns; i += lanes) {
            V cosines[4] = {V(0.0F), V(0.0F), V(0.0F), V(0.0F)};
            V sines[4] = {V(0.0F), V(0.0F), V(0.0F), V(0.0F)};
            for (std::size_t n = 0; n < v.orders; ++n) {
                const V c(v.cosine + n * v.columns + i, stdx::element_aligned);
                const V s(v.sine + n * v.columns + i, stdx::element_aligned);
                const float* own = v.sums + 8 * n;
                for (std::size_t k = 0; k < 4; ++k) {
                    cosines[k] += own[k] * c;
                    sines[k] += own[4 + k] * s;
                }
            }
            for (std::size_t k = 0; k < 4; ++k)
                (cosines[k] + sines[k]).copy_to(sums[k], stdx::element_aligned);
            for (std::size_t lane = 0; lane < lanes; ++lane)
                for (std::size_t k = 0; k < 4; ++k) v.values[4 * (i + lane) + k] = sums[k][lane];
        }
    }

    namespace {

    using Quad = float __attribute__((vector_size(16)));

    Quad load(const float* from) {
        Quad value;
        __builtin_memcpy(&value, from, sizeof value);
        return value;
    }
    void store(const Quad& value, float* to) { __builtin_memcpy(to, &value, sizeof value); }

    }  // namespace

    void veil_spread(const VeilSpreadView& v) {
        using Order = int __attribute__((vector_size(16)));
        // Three pixels' colours and one more begin in every first, second and third of vectors.
        constexpr Order rgbr{0, 1, 2, 0}, gbrg{1, 2, 0, 1}, brgb{2, 0, 1, 2}, all_i{3, 3, 3, 3};
        constexpr Quad pixel[6] = {{0, 0, 0, 1}, {1, 1, 2, 2}, {2, 3, 3, 3},
                                   {4, 4, 4, 5}, {5, 5, 6, 6}, {6, 7, 7, 7}};
        constexpr Quad low{0, 1, 2, 3}, high{4, 5, 6, 7};
        float* rgb = v.rgb;
        float* irradiance = v.irradiance;
        int block = v.first_block;
        const float* point = v.points;
        for (std::size_t b = 0; b < v.blocks; ++b) {
            const Quad here = load(point), change = load(point + 4) - here;
            const float share = v.first_share + static_cast<float>(8 * block) * v.step;
            const Quad first = here + share * change, by = v.step * change;
            const Quad first_a = __builtin_shuffle(first, rgbr), by_a = __builtin_shuffle(by, rgbr);
            const Quad first_b = __builtin_shuffle(first, gbrg), by_b = __builtin_shuffle(by, gbrg);
            const Quad first_c = __builtin_shuffle(first, brgb), by_c = __builtin_shuffle(by, brgb);
            store(first_a + pixel[0] * by_a, rgb);
            store(first_b + pixel[1] * by_b, rgb + 4);
            store(first_c + pixel[2] * by_c, rgb + 8);
            store(first_a + pixel[3] * by_a, rgb + 12);
            store(first_b + pixel[4] * by_b, rgb + 16);
            store(first_c + pixel[5] * by_c, rgb + 20);
            const Quad first_i = __builtin_shuffle(first, all_i),
                       by_i = __builtin_shuffle(by, all_i);
            const Quad one = first_i + low * by_i, two = first_i + high * by_i;
            store(one > 0.0F ? one : Quad{}, irradiance);
            store(two > 0.0F ? two : Quad{}, irradiance + 4);
            rgb += 24;
            irradiance += 8;
            if (++block == v.blocks_per_point) {
                block = 0;
                point += 4;
            }
        }
    }

}  // namespace ghostlight::GHOSTLIGHT_JOIN(kernels_,GHOSTLIGHT_ISA)
