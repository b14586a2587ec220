#include "tests/bench/fma_peak.h"

#include "core/instruction_set.h"

namespace ghostlight::bench {
namespace {

constexpr int rounds = 4096;

/// Enough chains side by side that the adder's latency does not show.
constexpr int chains = 12;

// The same loop for each instruction set, in vectors of the compiler's own kind.
#define GHOSTLIGHT_FMA_LOOP(name, attributes, bytes)                              \
    template <class T>                                                            \
    attributes double name() {                                                    \
        using Vector [[gnu::vector_size(bytes)]] = T;                             \
        constexpr int lanes = bytes / static_cast<int>(sizeof(T));                \
        Vector sum[chains];                                                       \
        for (int c = 0; c < chains; ++c)                                          \
            for (int i = 0; i < lanes; ++i) sum[c][i] = T(c + i);                 \
        Vector scale = sum[0] * T(0) + T(0.999), shift = sum[0] * T(0) + T(1e-3); \
        for (int r = 0; r < rounds; ++r) {                                        \
            /* The compiler must not work it out beforehand. */                   \
            asm volatile("" : "+x"(scale), "+x"(shift));                          \
            for (int c = 0; c < chains; ++c) sum[c] = sum[c] * scale + shift;     \
        }                                                                         \
        Vector all = sum[0];                                                      \
        for (int c = 1; c < chains; ++c) all += sum[c];                           \
        /* Bounded sums: never taken, but the compiler cannot know. */            \
        return 2.0 * lanes * chains * rounds + (all[0] > T(1e30) ? 1.0 : 0.0);    \
    }

#ifdef GHOSTLIGHT_HAVE_X86_ISA
GHOSTLIGHT_FMA_LOOP(loop_v3, [[gnu::target("avx2,fma")]], 32)
GHOSTLIGHT_FMA_LOOP(loop_v2, , 16)
#else
GHOSTLIGHT_FMA_LOOP(loop_v2, , 16)
#endif

}  // namespace

template <class T>
double fma_operations() {
#ifdef GHOSTLIGHT_HAVE_X86_ISA
    if (instruction_set() == InstructionSet::v3) return loop_v3<T>();
#endif
    return loop_v2<T>();
}
template double fma_operations<float>();
template double fma_operations<double>();

}  // namespace ghostlight::bench
