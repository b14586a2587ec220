// Compiled once per instruction set; see core/CMakeLists.txt. Nothing here may call an inline
// function that is shared with the rest of the program.
#include "core/flare/starburst_kernel.h"

#include <experimental/simd>

#define GHOSTLIGHT_JOIN_(a, b) a##b
#define GHOSTLIGHT_JOIN(a, b) GHOSTLIGHT_JOIN_(a, b)

namespace ghostlight::GHOSTLIGHT_JOIN(kernels_, GHOSTLIGHT_ISA) {
    namespace stdx = std::experimental;
    using V = stdx::native_simd<float>;

    void mix_rings(const RingMixView& m) {
        // Two vectors of sectors at once, so that eight sums are under way.
        constexpr std::size_t lanes = V::size(), block = 2 * lanes;
        static_assert(block <= 2 * sector_padding);
        for (std::size_t s = 0; s < m.sectors; s += block) {
            V low[4] = {V(0.0F), V(0.0F), V(0.0F), V(0.0F)};
            V high[4] = {V(0.0F), V(0.0F), V(0.0F), V(0.0F)};
            for (std::size_t tap = 0; tap < m.taps; ++tap) {
                const float* from = m.rings[tap] + s;
                const float* weight = m.weights + 4 * tap;
                const V a(from, stdx::element_aligned), b(from + lanes, stdx::element_aligned);
                for (std::size_t c = 0; c < 4; ++c) {
                    low[c] += weight[c] * a;
                    high[c] += weight[c] * b;
                }
            }
            for (std::size_t c = 0; c < 4; ++c) {
                low[c].copy_to(m.sums + c * m.sectors + s, stdx::element_aligned);
                high[c].copy_to(m.sums + c * m.sectors + s + lanes, stdx::element_aligned);
            }
        }
    }

    void polar_row(const PolarRowView& p) {
        constexpr float pi = 3.14159265F, half_pi = 1.57079633F;
        float* __restrict squares = p.square;
        float* __restrict rings = p.ring;
        float* __restrict sectors = p.sector;
        // A plain loop, for the compiler to vectorise.
        for (std::size_t k = 0; k < p.count; ++k) {
            const float at = static_cast<float>(static_cast<int>(k));
            const float x = p.x + at * p.x_step, y = p.y + at * p.y_step;
            const float square = x * x + y * y;
            // log2 of r²: the exponent, and the logarithm of a mantissa from √½ to √2 by its
            // series in (m − 1)/(m + 1), to 1e-7.
            const int bits = __builtin_bit_cast(int, square);
            const int exponent = (bits - 0x3F3504F3) >> 23;
            const float m = __builtin_bit_cast(float, bits - exponent * (1 << 23));
            const float t = (m - 1.0F) / (m + 1.0F), t2 = t * t;
            const float series =
                2.88539008F + t2 * (0.96179669F + t2 * (0.57707802F + t2 * 0.41219858F));
            const float log2 = static_cast<float>(exponent) + t * series;
            // Direction: Hastings' polynomial of the arctangent, to 1e-5 rad.
            const float ax = __builtin_fabsf(x), ay = __builtin_fabsf(y);
            const float large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
            const float q = small / (large + 1e-30F), q2 = q * q;
            const float tail =
                -0.3302995F + q2 * (0.1801410F + q2 * (-0.0851330F + q2 * 0.0208351F));
            float angle = q * (0.9998660F + q2 * tail);
            angle = ay > ax ? half_pi - angle : angle;
            angle = x < 0.0F ? pi - angle : angle;
            angle = (y < 0.0F ? -angle : angle) - p.turned_rad;
            angle = angle < 0.0F ? angle + p.span_rad : angle;
            angle = angle < 0.0F ? angle + p.span_rad : angle;
            angle = angle >= p.span_rad ? angle - p.span_rad : angle;
            squares[k] = square;
            rings[k] = 0.5F * p.rings_per_octave * log2 - p.first_ring;
            sectors[k] = angle * p.sectors_per_rad;
        }
    }

}  // namespace ghostlight::GHOSTLIGHT_JOIN(kernels_,GHOSTLIGHT_ISA)
